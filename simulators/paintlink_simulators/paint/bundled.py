"""Formulas of the bundled library, by code.

The file belongs to paintlink, which a simulator does not import; what it holds is
described in ``paintlink.library.virtual``. It is read here instead of shipped twice.
"""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import InputError, LibraryError
from paintlink_simulators.paint.toners import Formula, column

FILE = ("library", "data", "virtual.npz")
MEMBERS = (
    "codes",
    "toner_codes",
    "formula_ends",
    "formula_toners",
    "formula_hundredths",
)


@cache
def book() -> Mapping[str, Formula]:
    """Formula of every bundled paint, in the order of the library.

    Raises
    ------
    LibraryError
        When the file is missing or damaged.
    """
    codes, toners, ends, used, hundredths = _members()
    known = [code.decode("ascii") for code in toners.tolist()]
    for code in known:
        column(code)
    parts = np.split(hundredths / 100.0, ends[:-1])
    names = np.split(used, ends[:-1])
    rows = zip(codes.astype(np.str_).tolist(), names, parts, strict=True)
    return MappingProxyType({
        code: {known[t]: p for t, p in zip(*map(np.ndarray.tolist, row), strict=True)}
        for code, *row in rows
    })


def formula_of(code: str) -> Formula:
    """Formula of one bundled paint.

    Raises
    ------
    InputError
        When there is no such code; names those that come near.
    """
    if code in book():
        return book()[code]
    from difflib import get_close_matches

    near = get_close_matches(code.upper(), book(), n=3)
    advice = f"did you mean {', '.join(near)}?" if near else "codes look like BM304"
    msg = f"the bundled library has no paint {code!r}: {advice}"
    raise InputError(msg)


def _members() -> list[NDArray[Any]]:
    path = files("paintlink").joinpath(*FILE)
    try:
        with zipfile.ZipFile(io.BytesIO(path.read_bytes())) as archive:
            return [
                np.lib.format.read_array(io.BytesIO(archive.read(f"{name}.npy")))
                for name in MEMBERS
            ]
    except (OSError, ValueError, KeyError, zipfile.BadZipFile, zlib.error) as error:
        msg = f"the bundled library cannot be read ({error!r}): reinstall paintlink"
        raise LibraryError(msg) from error
