"""The file of the book: an npz archive that is the same on every run."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from paintbook.catalogue import Entry
from paintbook.colours import Paints
from paintbook.roles import ROLES
from paintlink.library.virtual import ANGLES_DEG
from paintlink_simulators.paint import TEXTURE, TONERS, texture

LIBRARY = "Virtual 6000 (synthetic)"
GLOSS_GU, GLOSS_SPREAD_GU = 92.0, 2.0
Column = tuple[str, NDArray[np.generic]]


def columns(
    book: list[Entry], everything: Paints, rng: np.random.Generator
) -> Iterator[Column]:
    """Columns of the file: the table, then what `paintlink.library.virtual` adds.

    Solids come first and have one spectrum each.
    """
    chosen = everything.only(np.array([entry.row for entry in book]))
    solids = int(np.count_nonzero(chosen.leaf < 7))
    rows = {entry.code: row for row, entry in enumerate(book)}
    gloss = rng.normal(GLOSS_GU, GLOSS_SPREAD_GU, len(book))
    yield "library", np.array(LIBRARY)
    yield "synthetic", np.array(True)
    yield "observer", np.array("10")
    yield "angles_deg", np.array(ANGLES_DEG)
    yield "ids", np.arange(1, len(book) + 1)
    yield "codes", np.array([entry.code for entry in book], dtype=np.bytes_)
    yield "names", np.array([entry.name for entry in book], dtype=np.bytes_)
    yield "finishes", _finishes(chosen)
    yield "lab_hundredths", chosen.lab
    yield "gloss_tenths_gu", np.rint(10.0 * gloss).astype(np.int16)
    yield from _formulas(chosen)
    yield "solid_roots", chosen.root[:solids, 0]
    yield "effect_roots", chosen.root[solids:]
    yield "texture_names", np.array([name for name, _ in TEXTURE], dtype=np.bytes_)
    yield "texture_angles_deg", np.array([angle for _, angle in TEXTURE], dtype=float)
    numbers = np.rint(100.0 * texture(chosen.parts)).astype(np.uint16)
    yield "texture_hundredths", numbers
    yield "primes", np.array([rows[entry.prime] for entry in book], dtype=np.uint16)
    yield "roles", np.array([entry.role for entry in book], dtype=np.uint8)
    yield "role_names", np.array(ROLES, dtype=np.bytes_)


def _finishes(chosen: Paints) -> NDArray[np.bytes_]:
    effect = np.where(chosen.pearl, b"pearl", b"metallic")
    return np.where(chosen.leaf < 7, b"solid", effect)


def _formulas(chosen: Paints) -> Iterator[Column]:
    """Formulas one after the other, the largest amount of each first."""
    order = np.argsort(-chosen.parts, axis=1, kind="stable")
    sorted_parts = np.take_along_axis(chosen.parts, order, axis=1)
    used = sorted_parts > 0.0
    yield "toner_codes", np.array([toner.code for toner in TONERS], dtype=np.bytes_)
    yield "toner_names", np.array([toner.name for toner in TONERS], dtype=np.bytes_)
    yield "formula_ends", np.cumsum(used.sum(axis=1)).astype(np.uint16)
    yield "formula_toners", order[used].astype(np.uint8)
    hundredths = np.rint(100.0 * sorted_parts[used]).astype(np.uint16)
    yield "formula_hundredths", hundredths


def archive(arrays: Iterator[Column]) -> bytes:
    """An npz file without the time of day."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as file:
        for name, array in arrays:
            member = zipfile.ZipInfo(f"{name}.npy", (1980, 1, 1, 0, 0, 0))
            member.create_system = 3
            member.compress_type = zipfile.ZIP_DEFLATED
            content = io.BytesIO()
            np.lib.format.write_array(content, array, allow_pickle=False)
            file.writestr(member, content.getvalue(), compresslevel=9)
    return buffer.getvalue()
