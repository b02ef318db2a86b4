"""Thumbnails of a library as files, drawn again only when they would change."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink import __version__
from paintlink.model import PaintTable
from paintlink.preview import store
from paintlink.preview.environment import load
from paintlink.preview.picture import WARNING
from paintlink.preview.png import encoded
from paintlink.preview.thumbnails import Sheet, thumbnails

EFFORT = 3
LOOKED_AT_BYTES = 512


class Written(NamedTuple):
    """How many thumbnails were drawn, and how many were there already."""

    drawn: int
    kept: int


def write_thumbnails(
    folder: Path,
    table: PaintTable,
    sheet: Sheet,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> Written:
    """One PNG file for each paint of the table, named after its number and code.

    Every file holds a digest of all that its picture depends on, and appears whole or
    not at all: after a break, the same call goes on where it stopped.

    Parameters
    ----------
    progress
        Told how many files there are, and how many there will be.
    """
    folder.mkdir(parents=True, exist_ok=True)
    recipes = _recipes(table, sheet)
    paths = [folder / _name(table, row) for row in range(len(table))]
    waiting = np.array(
        [row for row, path in enumerate(paths) if not _holds(path, recipes[row])],
        dtype=np.intp,
    )
    done = len(table) - len(waiting)
    progress(done, len(table))
    if not len(waiting):
        return Written(0, done)

    def save(row: int, rgb: NDArray[np.uint8]) -> None:
        _write(paths[row], encoded(rgb, _words(table, row, recipes[row]), EFFORT))

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for rows, pictures in thumbnails(table, waiting, sheet):
            list(pool.map(save, rows.tolist(), pictures))
            done += len(rows)
            progress(done, len(table))
    return Written(len(waiting), len(table) - len(waiting))


def _recipes(table: PaintTable, sheet: Sheet) -> list[str]:
    """Digest of all that each picture depends on."""
    light = load(sheet.light).digest
    scene = f"{store.RECIPE} {sheet.object} {light} {sheet.size}"
    common = f"{scene} {table.angles_deg} {table.observer}".encode()
    unknown = np.full(len(table), np.nan)
    gloss = unknown if table.gloss_gu is None else table.gloss_gu
    return [
        hashlib.sha256(common + lab.tobytes() + gu.tobytes()).hexdigest()
        for lab, gu in zip(np.ascontiguousarray(table.lab), gloss, strict=True)
    ]


def _name(table: PaintTable, row: int) -> str:
    code = re.sub(r"[^\w-]", "_", table.codes[row], flags=re.ASCII)
    return f"{int(table.ids[row]):06d}-{code}.png"


def _holds(path: Path, recipe: str) -> bool:
    try:
        with path.open("rb") as file:
            return recipe.encode() in file.read(LOOKED_AT_BYTES)
    except OSError:
        return False


def _words(table: PaintTable, row: int, recipe: str) -> list[tuple[str, str]]:
    made = " (synthetic)" if table.synthetic else ""
    return [
        ("Recipe", recipe),
        ("Software", f"paintlink {__version__}"),
        ("Paint", f"{table.codes[row]} {table.names[row]}{made}"),
        ("Comment", WARNING),
    ]


def _write(path: Path, data: bytes) -> None:
    temporary = path.with_suffix(".tmp")
    temporary.write_bytes(data)
    temporary.replace(path)
