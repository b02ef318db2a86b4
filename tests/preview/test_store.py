from __future__ import annotations

import logging
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from paintlink.preview import coat, environment, store

ROUGHNESS = 0.2
pytestmark = pytest.mark.usefixtures("coarse_bake")


@pytest.fixture(autouse=True)
def forget_tables() -> Iterator[None]:
    store.coat_table.cache_clear()
    yield
    store.coat_table.cache_clear()


def baked(folder: Path) -> np.ndarray:
    """A table as a process of its own would come by it."""
    store.coat_table.cache_clear()
    return store.coat_table(environment.load("studio"), ROUGHNESS, folder)


def test_second_process_reads_instead_of_baking(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = baked(tmp_path)
    monkeypatch.setattr(coat, "coat_table", None)

    second = baked(tmp_path)

    np.testing.assert_array_equal(first, second)


def test_table_is_the_same_without_a_folder(tmp_path: Path) -> None:
    kept = baked(tmp_path)

    store.coat_table.cache_clear()
    np.testing.assert_array_equal(
        kept, store.coat_table(environment.load("studio"), ROUGHNESS, None)
    )


def test_folder_holds_one_named_file_each(tmp_path: Path) -> None:
    baked(tmp_path / "made" / "on demand")

    (file,) = (tmp_path / "made" / "on demand").iterdir()

    assert file.name.startswith("coat-")
    assert file.suffix == ".plbasis"


@pytest.mark.parametrize("damage", ["cut short", "one bit", "emptied", "longer"])
def test_damaged_file_is_baked_again(
    tmp_path: Path, damage: str, caplog: pytest.LogCaptureFixture
) -> None:
    good = baked(tmp_path)
    (file,) = tmp_path.iterdir()
    content = file.read_bytes()
    file.write_bytes(damaged(content, damage))

    with caplog.at_level(logging.WARNING):
        again = baked(tmp_path)

    np.testing.assert_array_equal(good, again)
    assert file.read_bytes() == content
    assert "is damaged, baking again" in caplog.text


def damaged(content: bytes, how: str) -> bytes:
    middle = len(content) // 2
    flipped = bytes([content[middle] ^ 1])
    return {
        "cut short": content[:middle],
        "one bit": content[:middle] + flipped + content[middle + 1 :],
        "emptied": b"",
        "longer": content + b"\0",
    }[how]


def test_folder_that_cannot_be_written_is_no_error(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("in the way")

    with caplog.at_level(logging.WARNING):
        table = baked(blocked / "cache")

    assert table.max() > 0.0
    assert "cannot write" in caplog.text


def test_leftover_of_a_crash_is_never_read(tmp_path: Path) -> None:
    good = baked(tmp_path)
    (file,) = tmp_path.iterdir()
    file.rename(tmp_path / "tmpabcdef")

    np.testing.assert_array_equal(good, baked(tmp_path))


def test_changed_recipe_is_another_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    baked(tmp_path)
    monkeypatch.setattr(store, "RECIPE", store.RECIPE + 1)

    baked(tmp_path)

    assert len(list(tmp_path.iterdir())) == 2
