"""Rows of the sheets of a workbook of unknown origin.

python-calamine allocates a rectangle that holds every cell of a sheet, so two cells far
apart would cost all memory. What it gets is therefore a new archive of the few members
it needs, each inflated under a limit and its cell references checked.
"""

from __future__ import annotations

import io
import re
import zipfile
import zlib
from collections.abc import Iterator
from datetime import datetime
from typing import Any

from paintlink.errors import InputError
from paintlink.intake.source import Source

Cell = str | float | bool | datetime

ZIP_MARK = b"PK\x03\x04"
_DIRECTORY_MARK = b"PK\x01\x02"
MAX_MEMBERS = 2000
MAX_INFLATED = 96 << 20
MAX_CELLS = 4_000_000

_NEEDED = re.compile(
    r"\[Content_Types\]\.xml|_rels/\.rels|xl/(?:workbook|styles|sharedStrings)\.xml"
    r"|xl/_rels/workbook\.xml\.rels|xl/worksheets/[^/]+\.xml"
)
# Cells beyond column AZ or row 76 999.
_FAR = re.compile(
    rb'<c r="(?:[B-Zb-z][A-Za-z]|[A-Za-z]{3}'
    rb"|[A-Za-z]{1,2}(?:\d{6}|7[7-9]\d{3}|[89]\d{4}))"
)
_REFERENCE = re.compile(r"([A-Za-z]{1,3})(\d{1,7})", re.ASCII)


class Workbook:
    """Sheets by name, each a list of rows; empty cells are empty texts.

    Raises
    ------
    InputError
        When the archive is damaged, or larger than a workbook of readings can be.
    """

    def __init__(self, source: Source) -> None:
        from python_calamine import CalamineError, CalamineWorkbook

        self._source = source
        self._errors = (CalamineError, ValueError, OSError)
        members = dict(_members(source))
        with self._guarded():
            self._book = CalamineWorkbook.from_filelike(io.BytesIO(_packed(members)))
        self.names: list[str] = self._book.sheet_names

    def rows(self, name: str) -> list[list[Cell]]:
        """The rows of a sheet from its first row on."""
        with self._guarded():
            sheet: Any = self._book.get_sheet_by_name(name)
            rows: list[list[Cell]] = sheet.to_python(skip_empty_area=False)
        return rows

    def _guarded(self) -> _Guard:
        return _Guard(self._source, self._errors)


class _Guard:
    """What a Rust library throws at a damaged workbook, as one named error."""

    def __init__(self, source: Source, errors: tuple[type[Exception], ...]) -> None:
        self._source = source
        self._errors = errors

    def __enter__(self) -> None:
        return None

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: object,
    ) -> None:
        # A panic of the library is no Exception, and has no importable class.
        panicked = kind is not None and kind.__name__ == "PanicException"
        if error is not None and (panicked or isinstance(error, self._errors)):
            raise damaged(self._source) from error


def damaged(source: Source) -> InputError:
    """The refusal of an archive that cannot be read."""
    return source.fault("", "a damaged or cut workbook: export it again")


def member_names(source: Source) -> list[str]:
    """Names of what an archive holds; empty when it is none.

    Raises
    ------
    InputError
        When they are thousands; counted before the directory costs memory.
    """
    if source.data.count(_DIRECTORY_MARK) > MAX_MEMBERS:
        raise source.fault("", f"more than {MAX_MEMBERS} files in the workbook")
    try:
        with zipfile.ZipFile(io.BytesIO(source.data)) as archive:
            return archive.namelist()
    except (zipfile.BadZipFile, ValueError, OSError, NotImplementedError, EOFError):
        return []


def _members(source: Source) -> Iterator[tuple[str, bytes]]:
    if not member_names(source):
        raise damaged(source)
    try:
        with zipfile.ZipFile(io.BytesIO(source.data)) as archive:
            yield from _inflated(source, archive)
    except InputError:
        raise
    except (
        zipfile.BadZipFile, zlib.error, RuntimeError, ValueError, OSError, EOFError,
        NotImplementedError, KeyError,
    ) as error:  # fmt: skip
        raise damaged(source) from error


def _inflated(source: Source, archive: zipfile.ZipFile) -> Iterator[tuple[str, bytes]]:
    left = MAX_INFLATED
    for info in archive.infolist():
        if not _NEEDED.fullmatch(info.filename):
            continue
        with archive.open(info) as member:
            data = member.read(left + 1)
        left -= len(data)
        if left < 0:
            msg = f"unpacks to more than {MAX_INFLATED >> 20} MiB: split the export"
            raise source.fault(info.filename, msg)
        if info.filename.startswith("xl/worksheets/"):
            _require_small(source, info.filename, data)
        yield info.filename, data


def _require_small(source: Source, name: str, data: bytes) -> None:
    """Refuse a sheet whose cells lie further apart than those of any export."""
    if b"\0" in data[:200] or b"<!" in data:
        raise damaged(source)
    cells = data.count(b"<c") - data.count(b"<col") + data.count(b":c")
    if cells > MAX_CELLS:
        msg = f"more than {MAX_CELLS} cells: split the export"
        raise source.fault(name, msg)
    # As all programs write it, each cell begins with its place.
    if cells == data.count(b'<c r="') and not _FAR.search(data):
        return
    rows, columns = _extent(source, data)
    if rows * columns > MAX_CELLS:
        msg = (
            f"the sheet reaches to row {rows}, column {columns}: export the readings "
            "without empty cells around them"
        )
        raise source.fault(name, msg)


def _extent(source: Source, data: bytes) -> tuple[int, int]:
    """The last row and column; cells without a place follow the one before."""
    from paintlink.errors import SpecError
    from paintlink.spec import safe_root_of_text

    try:
        root = safe_root_of_text(data.decode())
    except (SpecError, UnicodeDecodeError) as error:
        raise damaged(source) from error
    row = rows = columns = 0
    for line in root.iter("{*}row"):
        row = _row_number(source, line.get("r"), row + 1)
        column = 0
        for cell in line.iterchildren("{*}c"):
            place = cell.get("r")
            row, column = (row, column + 1) if place is None else _place(source, place)
            rows, columns = max(rows, row), max(columns, column)
    return rows, columns


def _row_number(source: Source, text: str | None, following: int) -> int:
    if text is None:
        return following
    return _place(source, f"A{text}")[0]


def _place(source: Source, text: str) -> tuple[int, int]:
    """Row and column of a place such as ``B12``."""
    place = _REFERENCE.fullmatch(text)
    if place is None:
        raise damaged(source)
    return int(place[2]), _column(place[1])


def _column(letters: str) -> int:
    number = 0
    for letter in letters.upper():
        number = 26 * number + ord(letter) - 64
    return number


def _packed(members: dict[str, bytes]) -> bytes:
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_STORED) as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return target.getvalue()
