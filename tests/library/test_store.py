from __future__ import annotations

import random
import zipfile
from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import LibraryError
from paintlink.library import bundled
from paintlink.library.store import BUNDLED, COLUMNS, load


def test_bundled_library_is_read_once() -> None:
    assert bundled() is bundled()


def test_lab_is_the_decimal_number_to_the_last_bit() -> None:
    lab = bundled().lab

    assert np.array_equal(
        lab, [[[float(f"{x:.2f}") for x in r] for r in p] for p in lab]
    )


def test_table_cannot_be_written_to() -> None:
    table = bundled()

    for array in (table.lab, table.ids, table.gloss_gu):
        assert array is not None
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def test_ids_ascend_from_one() -> None:
    assert np.array_equal(bundled().ids, np.arange(1, 6001))


def test_generation_changes_with_the_data(tmp_path: Path) -> None:
    other = tmp_path / "other.npz"
    with np.load(BUNDLED) as columns:
        changed = dict(columns)
    changed["lab_hundredths"][0, 0, 0] += 1
    np.savez(other, **changed)

    table = load(other)

    assert table.generation != bundled().generation
    assert table.lab[0, 0, 0] == pytest.approx(bundled().lab[0, 0, 0] + 0.01)


def test_missing_bundled_file_asks_for_reinstallation(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    gone = tmp_path / "virtual.npz"
    monkeypatch.setattr("paintlink.library.store.BUNDLED", gone)

    with pytest.raises(LibraryError, match=r"virtual\.npz is missing: reinstall"):
        load(gone)


def test_missing_other_file_is_not_blamed_on_paintlink(tmp_path: Path) -> None:
    with pytest.raises(LibraryError, match="is missing: restore it from its source"):
        load(tmp_path / "site.npz")


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"not an archive" * 99])
def test_something_else_is_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "site.npz"
    path.write_bytes(content)

    with pytest.raises(LibraryError, match=r"cannot be read .*: restore it"):
        load(path)


def test_missing_column_is_named(tmp_path: Path) -> None:
    path = tmp_path / "site.npz"
    with np.load(BUNDLED) as columns:
        np.savez(path, **{name: columns[name] for name in columns if name != "codes"})

    with pytest.raises(LibraryError, match=r"no item named 'codes\.npy'"):
        load(path)


def test_pickled_objects_are_never_loaded(tmp_path: Path) -> None:
    path = tmp_path / "site.npz"
    with np.load(BUNDLED) as columns:
        np.savez(path, **{**columns, "names": np.array([object()], dtype=object)})

    with pytest.raises(LibraryError, match="Object arrays cannot be loaded"):
        load(path)


def test_damage_is_found_or_changes_no_paint(tmp_path: Path) -> None:
    rng = random.Random(1)
    good = BUNDLED.read_bytes()
    members = zipfile.ZipFile(BUNDLED).infolist()[: len(COLUMNS)]
    headers = [info.header_offset for info in members]
    places = [start + offset for start in headers for offset in range(0, 190, 7)]
    path = tmp_path / "damaged.npz"

    refused = 0
    for place in places + [rng.randrange(len(good)) for _ in range(100)]:
        damaged = bytearray(good)
        damaged[place] ^= 1 << rng.randrange(8)
        path.write_bytes(damaged)
        try:
            table = load(path)
        except LibraryError:
            refused += 1
        else:
            assert np.array_equal(table.lab, bundled().lab)
            assert (table.codes, table.names) == (bundled().codes, bundled().names)

    assert refused > 200


def test_short_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "short.npz"
    good = BUNDLED.read_bytes()
    for length in range(0, len(good), 10_000):
        path.write_bytes(good[:length])

        with pytest.raises(LibraryError, match="cannot be read"):
            load(path)
