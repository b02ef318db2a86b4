"""The preview folder at work, without its service."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from paintlink.config import (
    InboxSettings,
    PreviewSettings,
    Settings,
    SiteSettings,
    StateSettings,
)
from paintlink.daemon import drawings, render
from paintlink.daemon.drawings import Drawings
from paintlink.spec import write_spec
from tests.daemon.conftest import make_spec


@pytest.fixture
def told(tmp_path: Path) -> Settings:
    return Settings(
        site=SiteSettings(folder=tmp_path),
        state=StateSettings(folder=tmp_path / "state"),
        inbox=InboxSettings(folder=tmp_path / "inbox"),
        preview=PreviewSettings(object="sphere", size=64, backend="cpu"),
    )


def drop(folder: Path, name: str) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(write_spec(make_spec(name)))
    os.utime(folder / name, (1_000_000, 1_000_000))


def test_fault_in_drawing_refuses_one_file(
    told: Settings, monkeypatch: pytest.MonkeyPatch
) -> None:
    working = render.picture_of

    def faulty(spec, *rest):  # type: ignore[no-untyped-def]
        if spec.name == "a.xml":
            raise ZeroDivisionError
        return working(spec, *rest)

    monkeypatch.setattr(drawings, "picture_of", faulty)
    folder = told.drawings_folder
    drop(folder, "a.xml")
    drop(folder, "b.xml")
    at_work = Drawings(told)

    assert [at_work.step(), at_work.step(), at_work.step()] == [True, True, False]

    words = json.loads((folder / "a.xml.json").read_text())
    assert words["error"].startswith("a fault of the program (ZeroDivisionError")
    assert (folder / "b.xml.png").exists()


def test_folder_that_cannot_be_had_is_told_once(
    told: Settings, caplog: pytest.LogCaptureFixture
) -> None:
    told.drawings_folder.write_text("a file is in the way")
    at_work = Drawings(told)

    assert not at_work.step()
    assert not at_work.step()

    (record,) = caplog.records
    assert "previews wait" in record.getMessage()
