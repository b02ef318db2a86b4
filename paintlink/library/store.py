"""Reading a library file: an npz archive of plain columns, see `load`."""

from __future__ import annotations

import hashlib
import io
import zipfile
import zlib
from collections.abc import Iterable
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import LibraryError
from paintlink.model import Finish, FloatArray, Observer, PaintTable

BUNDLED = Path(__file__).parent / "data" / "virtual.npz"
COLUMNS = (
    "library",
    "synthetic",
    "observer",
    "angles_deg",
    "ids",
    "codes",
    "names",
    "finishes",
    "lab_hundredths",
    "gloss_tenths_gu",
)
GENERATION_LENGTH = 12
UNREADABLE = (
    OSError,
    EOFError,
    ValueError,
    KeyError,
    RuntimeError,
    zipfile.BadZipFile,
    zlib.error,
)


def load(path: Path) -> PaintTable:
    """The library in a file; its generation is a hash of the whole file.

    Parameters
    ----------
    path
        npz archive of ``COLUMNS``: four about the library, then one entry for each
        paint in the order of the ids; Lab has the shape (n, angles, 3).

    Raises
    ------
    LibraryError
        When the file is missing, damaged or something else.
    """
    data, read = _read(path, COLUMNS)
    return _table(read, hashlib.sha256(data).hexdigest()[:GENERATION_LENGTH])


def columns(path: Path, *names: str) -> dict[str, NDArray[Any]]:
    """Columns of a library file by name.

    Raises
    ------
    LibraryError
        When the file is missing, damaged or has no such column.
    """
    return _read(path, names)[1]


def _read(path: Path, names: Iterable[str]) -> tuple[bytes, dict[str, NDArray[Any]]]:
    try:
        data = path.read_bytes()
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return data, {name: _column(archive, name) for name in names}
    except FileNotFoundError as error:
        msg = f"paint library {path} is missing: {_remedy(path)}"
        raise LibraryError(msg) from error
    except UNREADABLE as error:
        msg = f"paint library {path} cannot be read ({error!r}): {_remedy(path)}"
        raise LibraryError(msg) from error


def _column(archive: zipfile.ZipFile, name: str) -> NDArray[Any]:
    # Reading the member whole checks its CRC, which numpy.load does not always do.
    content = io.BytesIO(archive.read(f"{name}.npy"))
    array: NDArray[Any] = np.lib.format.read_array(content, allow_pickle=False)
    return array


def _remedy(path: Path) -> str:
    ours = path.parent == BUNDLED.parent
    return "reinstall paintlink" if ours else "restore it from its source"


def _table(columns: dict[str, NDArray[Any]], generation: str) -> PaintTable:
    return PaintTable(
        library=str(columns["library"]),
        generation=generation,
        synthetic=bool(columns["synthetic"]),
        observer=cast("Observer", str(columns["observer"])),
        ids=_readonly(columns["ids"]),
        codes=_texts(columns["codes"]),
        names=_texts(columns["names"]),
        finishes=cast("tuple[Finish, ...]", _texts(columns["finishes"])),
        angles_deg=tuple(columns["angles_deg"].tolist()),
        lab=_lab(columns["lab_hundredths"]),
        gloss_gu=_readonly(columns["gloss_tenths_gu"] / 10.0),
    )


def _lab(hundredths: NDArray[np.int16]) -> FloatArray:
    """Lab of shape (n, angles, 3), laid out so that each L, a and b is one run.

    A search reads whole columns; this order makes it several times faster.
    """
    planes = np.ascontiguousarray(hundredths.transpose(1, 2, 0)) / 100.0
    return _readonly(planes).transpose(2, 0, 1)


def _texts(column: NDArray[np.bytes_]) -> tuple[str, ...]:
    return tuple(column.astype(np.str_).tolist())


def _readonly(array: NDArray[Any]) -> NDArray[Any]:
    array.setflags(write=False)
    return array
