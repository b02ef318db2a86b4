"""The stored chain: exact, versioned, whole or not there."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.design import (
    Design,
    from_json,
    make_step,
    read_design,
    to_json,
    write_design,
)
from paintlink.design.document import MAX_BYTES, VERSION
from paintlink.errors import DesignError, ExportError
from tests.design.conftest import RED_AT_FIVE, make_design, make_spec

Change = Callable[[dict[str, Any]], object]


@pytest.fixture
def design() -> Design:
    goal = make_spec(RED_AT_FIVE, "goal")
    return (
        make_design()
        .apply(make_step("tint-flop", {"color": (10.0, 5.0, -9.0), "amount": 0.1}))
        .apply(make_step("towards", {"paint": goal, "amount": 1 / 3}))
        .apply(make_step("mirror", {}))
        .undo()
    )


def test_document_gives_back_the_design(design: Design) -> None:
    again = from_json(to_json(design))

    assert again == design
    assert again.state.lab.tobytes() == design.state.lab.tobytes()
    assert to_json(again) == to_json(design)


@given(st.floats(-360.0, 360.0), st.floats(0.0, 10.0))
@settings(deadline=None)
def test_every_number_comes_back_as_it_was(angle_deg: float, factor: float) -> None:
    design = make_design().apply(make_step("rotate-hue", {"angle_deg": angle_deg}))
    design = design.apply(make_step("chroma", {"factor": factor}))

    assert from_json(to_json(design)) == design


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda d: d.update(version=VERSION + 1), "newer paintlink .version 2.*update"),
        (lambda d: d.update(version="1"), "not a design: version"),
        (lambda d: d.update(format="other"), "not a design: format"),
        (lambda d: d.pop("start"), "not a design: start"),
        (lambda d: d.update(extra=1), "not a design: extra"),
        (lambda d: d["start"]["color"]["samples"].pop(), "needs Lab at 3, 5 or 6"),
        (lambda d: d["start"]["color"]["samples"][0].update(L=1e6), "between -16 and"),
        (lambda d: d["start"]["color"]["samples"][2].update(b=99.0), "no surface can"),
        (lambda d: d["start"]["color"]["samples"][0].update(L=True), "L: "),
        (lambda d: d["steps"][0].update(step="tint-flip"), "did you mean tint-flop"),
        (lambda d: d["steps"][0]["parameters"].update(amount=2.0), "to 1, not 2"),
        (lambda d: d["steps"][0]["parameters"].update(color=[1.0]), "L,a,b of a"),
        (lambda d: d["steps"][0]["parameters"].pop("color"), "color is missing"),
        (lambda d: d["undone"][0]["parameters"].update(x=1.0), "no parameter 'x'"),
        (
            lambda d: d["steps"].append({
                "step": "set-sample", "parameters": {"angle_deg": 25.0, "L": 40.0},
            }),
            "one of 15, 45, 110",
        ),
        (lambda d: d["steps"].extend(d["steps"] * 600), "steps: .*at most 1000"),
    ],
)  # fmt: skip
def test_changed_document_is_refused_by_name(
    design: Design, change: Change, says: str
) -> None:
    document = json.loads(to_json(design))
    change(document)

    with pytest.raises(DesignError, match=f"^sea.json: .*{says}"):
        from_json(json.dumps(document).encode(), source="sea.json")


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{",
        b"\xff\xfe",
        b"[]",
        b"null",
        b"7",
        b"[" * 100_000,
        b'{"version": NaN}',
        b'{"version": 1' + b"0" * 5000 + b"}",
    ],
    ids=["empty", "cut", "binary", "list", "null", "number", "deep", "nan", "huge"],
)
def test_anything_else_is_refused(data: bytes) -> None:
    with pytest.raises(DesignError, match=r"^x.json: (not a|written by a newer)"):
        from_json(data, source="x.json")


def test_every_cut_of_a_document_is_refused(design: Design) -> None:
    data = to_json(design).rstrip()

    for length in range(0, len(data), 7):
        with pytest.raises(DesignError, match="not a JSON document"):
            from_json(data[:length])


def test_missing_number_is_refused(design: Design) -> None:
    data = to_json(design).replace(b"0.1", b"NaN", 1)

    with pytest.raises(DesignError, match="amount"):
        from_json(data)


def test_large_document_is_refused_unread() -> None:
    with pytest.raises(DesignError, match="no design needs as many"):
        from_json(b" " * (MAX_BYTES + 1))


def test_chain_without_end_is_not_written() -> None:
    step = make_step("mirror", {})
    design = Design("long", make_design().start, steps=(step,) * 1001)

    with pytest.raises(DesignError, match="start a new one from there"):
        to_json(design)


def test_file_gives_back_the_design(tmp_path: Path, design: Design) -> None:
    path = tmp_path / "sea.json"

    write_design(path, make_design())
    write_design(path, design)

    assert read_design(path) == design
    assert [one.name for one in tmp_path.iterdir()] == ["sea.json"]


def test_failed_write_leaves_the_old_design(
    tmp_path: Path, design: Design, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "sea.json"
    write_design(path, make_design())

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(ExportError, match="No space left on device"):
        write_design(path, design)

    assert read_design(path) == make_design()
    assert [one.name for one in tmp_path.iterdir()] == ["sea.json"]


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda path: None, "No such file.*design new"),
        (Path.mkdir, "not a regular file"),
        (os.mkfifo, "not a regular file"),
    ],
    ids=["missing", "folder", "fifo"],
)
def test_unreadable_file_is_named(
    tmp_path: Path, make: Callable[[Path], object], says: str
) -> None:
    path = tmp_path / "sea.json"
    make(path)

    with pytest.raises(DesignError, match=f"sea.json: .*{says}"):
        read_design(path)
