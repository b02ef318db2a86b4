from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from paintlink.errors import PreviewError
from paintlink.library import bundled, paint_spec
from paintlink.model import PaintTable
from paintlink.preview import Sheet, fused, render, write_thumbnails
from paintlink.preview.thumbnails import thumbnails

pytestmark = pytest.mark.usefixtures("coarse_bake")
SHEET = Sheet(size=24)


@pytest.fixture(params=["numpy", "numba"])
def path_taken(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    if request.param == "numba":
        pytest.importorskip("numba")
    monkeypatch.setattr(fused, "available", lambda: request.param == "numba")
    return str(request.param)


def few(count: int = 40) -> PaintTable:
    table = bundled()
    rows = np.linspace(0, len(table) - 1, count).astype(int)
    return replace(
        table,
        ids=table.ids[rows],
        codes=tuple(table.codes[row] for row in rows),
        names=tuple(table.names[row] for row in rows),
        finishes=tuple(table.finishes[row] for row in rows),
        lab=table.lab[rows],
        gloss_gu=None if table.gloss_gu is None else table.gloss_gu[rows],
        facets={},
    )


@pytest.mark.usefixtures("path_taken")
@pytest.mark.parametrize("light", ["studio", "sky"])
def test_thumbnail_is_the_picture_of_its_paint(light: str) -> None:
    table = few()
    rows = np.arange(len(table))

    drawn = list(thumbnails(table, rows, Sheet(light=light, size=24)))

    together = np.concatenate([pictures for _, pictures in drawn])
    assert np.concatenate([some for some, _ in drawn]).tolist() == rows.tolist()
    for row in range(0, len(table), 7):
        alone = render(
            [paint_spec(table, row)],
            object="sphere",
            light=light,
            size=24,
            backend="cpu",
        )
        assert np.abs(together[row].astype(int) - alone.rgb).max() <= 1


def test_files_are_named_and_drawn_once(tmp_path: Path) -> None:
    table = few()
    told: list[tuple[int, int]] = []

    first = write_thumbnails(
        tmp_path, table, SHEET, lambda done, of: told.append((done, of))
    )
    again = write_thumbnails(tmp_path, table, SHEET)

    assert first == (40, 0)
    assert again == (0, 40)
    assert told[0] == (0, 40)
    assert told[-1] == (40, 40)
    with Image.open(min(tmp_path.iterdir())) as image:
        assert image.size == (24, 24)


def test_only_what_changed_or_is_missing_is_drawn_again(tmp_path: Path) -> None:
    table = few()
    write_thumbnails(tmp_path, table, SHEET)
    files = sorted(tmp_path.iterdir())
    files[3].unlink()
    files[4].write_bytes(b"cut")
    lab = table.lab.copy()
    lab[7, 0, 0] += 1

    written = write_thumbnails(tmp_path, replace(table, lab=lab), SHEET)

    assert written == (3, 37)


def test_stopped_run_goes_on_where_it_was(tmp_path: Path) -> None:
    table = few(300)

    def stop(done: int, of: int) -> None:
        if done > 100:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_thumbnails(tmp_path, table, SHEET, stop)

    written = write_thumbnails(tmp_path, table, SHEET)
    assert written.kept >= 100
    assert written.drawn + written.kept == 300


def test_codes_are_harmless_file_names(tmp_path: Path) -> None:
    table = replace(few(2), codes=("../../etc", "a/b c"))

    write_thumbnails(tmp_path, table, SHEET)

    assert {path.parent for path in tmp_path.rglob("*.png")} == {tmp_path}


def test_invented_paints_are_marked_in_the_file(tmp_path: Path) -> None:
    write_thumbnails(tmp_path, few(1), SHEET)

    (path,) = tmp_path.iterdir()
    with Image.open(io.BytesIO(path.read_bytes())) as image:
        image.load()
    assert image.text["Paint"].endswith("(synthetic)")


@pytest.mark.parametrize("size", [15, 257])
def test_size_out_of_range_is_refused(size: int) -> None:
    with pytest.raises(PreviewError, match=f"16 to 256 pixels wide, not {size}"):
        Sheet(size=size)
