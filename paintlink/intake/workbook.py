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
MAX_MEMBERS = 2000
MAX_INFLATED = 96 << 20
MAX_COLUMNS = 512
MAX_ROWS = 100_000
MAX_CELLS = 4_000_000

_NEEDED = re.compile(
    r"\[Content_Types\]\.xml|_rels/\.rels|xl/(?:workbook|styles|sharedStrings)\.xml"
    r"|xl/_rels/workbook\.xml\.rels|xl/worksheets/[^/]+\.xml"
)
_REFERENCE = re.compile(rb"""\br\s*=\s*["']([A-Za-z]*)(\d+)["']""")
_CELL = re.compile(rb"<(?:\w+:)?c[\s/>]")


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
    """Names of what an archive holds; empty when it is none."""
    try:
        with zipfile.ZipFile(io.BytesIO(source.data)) as archive:
            return archive.namelist()[:MAX_MEMBERS]
    except (zipfile.BadZipFile, ValueError, OSError, NotImplementedError, EOFError):
        return []


def _members(source: Source) -> Iterator[tuple[str, bytes]]:
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
    infos = archive.infolist()
    if len(infos) > MAX_MEMBERS:
        raise source.fault("", f"more than {MAX_MEMBERS} files in the workbook")
    left = MAX_INFLATED
    for info in infos:
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
    cells = len(_CELL.findall(data))
    columns = rows = 0
    references = {match.groups() for match in _REFERENCE.finditer(data)}
    for letters, digits in references:
        columns = max(columns, _column(letters))
        rows = max(rows, int(digits[:9]))
    if (
        cells > MAX_CELLS
        or columns > MAX_COLUMNS
        or rows > MAX_ROWS
        or columns * rows > MAX_CELLS
    ):
        msg = (
            f"the sheet reaches to row {rows}, column {columns}: export the readings "
            "without empty cells around them"
        )
        raise source.fault(name, msg)


def _column(letters: bytes) -> int:
    number = 0
    for letter in letters[:4].upper():
        number = 26 * number + letter - 64
    return number


def _packed(members: dict[str, bytes]) -> bytes:
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_STORED) as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return target.getvalue()
