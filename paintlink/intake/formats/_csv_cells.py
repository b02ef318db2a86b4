"""From the cells of a row to what they mean."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field

from paintlink.errors import InputError
from paintlink.intake.assembly import Row
from paintlink.intake.geometries import read_geometry
from paintlink.intake.profile import Kind, Meaning, Profile, heading_key
from paintlink.intake.source import Source
from paintlink.intake.table import TableRow
from paintlink.intake.text import parse_number, plain
from paintlink.model import Geometry, Texture

AXES = ("L", "a", "b")
# paintlink's own tables put an apostrophe before text a spreadsheet would calculate.
_GUARDED = ("'=", "'+", "'-", "'@", "'\t", "'\r")


@dataclass
class ReadRow:
    """One row of the table by meaning."""

    line: int
    raw: str
    texts: dict[Kind, str]
    rows: list[Row] = field(default_factory=list)
    angle: Geometry | None = None
    wavelengths_nm: tuple[float, ...] = ()
    percent_signs: set[bool] = field(default_factory=set)
    texture: list[Texture] = field(default_factory=list)
    gloss: tuple[float, float | None] | None = None

    def text(self, kind: Kind) -> str:
        """The text of a column, empty where the table has none."""
        return self.texts.get(kind, "")

    @property
    def key(self) -> tuple[str, ...]:
        """What the rows of one reading share."""
        kinds: tuple[Kind, ...] = ("name", "time", "date", "clock", "code", "data_mode")
        return tuple(self.text(kind) for kind in kinds)


class Cells:
    """The columns of a table under its heading row."""

    def __init__(self, source: Source, profile: Profile, heading: TableRow) -> None:
        self.notes: list[str] = []
        self._source = source
        self._profile = profile
        self._delimiter = profile.delimiter
        self._columns: dict[int, Meaning] = {}
        self._headings = [" ".join(cell.split()) for cell in heading.cells]
        unknown = []
        seen: set[str] = set()
        for index, cell in enumerate(heading.cells):
            key = heading_key(cell)
            meaning = profile.columns.get(key)
            if meaning is None:
                unknown += [cell.strip()] if cell.strip() else []
                continue
            if meaning.kind != "ignore" and key in seen:
                msg = (
                    f"heading {cell.strip()!r} stands twice: rename one of the columns"
                )
                raise source.fault(f"line {heading.line}", msg)
            seen.add(key)
            self._columns[index] = meaning
        if unknown:
            names = ", ".join(plain(one, 30) for one in unknown[:6])
            self.notes.append(
                f"columns the profile {profile.name!r} does not know: {names}"
                + (" ..." if len(unknown) > 6 else "")
            )
        self._values = self._value_columns()

    def _value_columns(self) -> dict[str, list[tuple[int, Meaning]]]:
        """Columns of Lab and reflectance by geometry code, bands ascending."""
        groups: dict[str, list[tuple[int, Meaning]]] = defaultdict(list)
        for index, meaning in self._columns.items():
            if meaning.kind in {"lab", "factor"}:
                groups[meaning.geometry].append((index, meaning))
        for columns in groups.values():
            columns.sort(key=lambda one: (one[1].kind, _band(one[1])))
        return groups

    def read(self, row: TableRow) -> ReadRow:
        """A row by meaning."""
        if len(row.cells) > len(self._headings):
            extra = [cell for cell in row.cells[len(self._headings) :] if cell.strip()]
            if extra:
                msg = (
                    f"{len(row.cells)} cells under {len(self._headings)} headings: is "
                    "a decimal comma in a table cut by commas? export it again"
                )
                raise self._source.fault(f"line {row.line}", msg)
        texts: dict[Kind, str] = {}
        for index, meaning in self._columns.items():
            if meaning.kind not in {"lab", "factor", "texture", "ignore"}:
                texts.setdefault(meaning.kind, self._cell(row, index))
        read = ReadRow(row.line, self._delimiter.join(row.cells), texts)
        if self._profile.is_long:
            read.angle = self._geometry(row, texts)
        for code, columns in self._values.items():
            geometry = read.angle or read_geometry(code)
            values = self._row(row, read, geometry, columns)
            if values is not None:
                read.rows.append(values)
        self._read_others(row, read)
        return read

    def _cell(self, row: TableRow, index: int) -> str:
        text = row.cells[index].strip() if index < len(row.cells) else ""
        return text[1:] if text.startswith(_GUARDED) else text

    def _geometry(self, row: TableRow, texts: dict[Kind, str]) -> Geometry:
        code = texts.get("geometry", "")
        lamp = texts.get("illumination", "")
        if lamp and "as" not in code:
            code = f"{lamp}as{code}"
        try:
            return read_geometry(code)
        except InputError as error:
            raise self._source.fault(f"line {row.line}", str(error)) from error

    def _row(
        self,
        row: TableRow,
        read: ReadRow,
        geometry: Geometry,
        columns: list[tuple[int, Meaning]],
    ) -> Row | None:
        """Values of one geometry; None where all its cells are empty."""
        if not any(self._cell(row, index) for index, _ in columns):
            return None
        lab, factors, bands = {}, [], []
        for index, meaning in columns:
            if meaning.kind == "lab":
                lab[meaning.value] = self._number(row, index)
            else:
                factors.append(self._number(row, index, read.percent_signs.add))
                bands.append(float(meaning.value))
        if lab and len(lab) < len(AXES):
            missing = ", ".join(axis for axis in AXES if axis not in lab)
            msg = f"no column for {missing} of {geometry.code}: complete the profile"
            raise self._source.fault(f"line {row.line}", msg)
        read.wavelengths_nm = tuple(bands) or read.wavelengths_nm
        return Row(
            f"line {row.line}",
            geometry,
            [lab[axis] for axis in AXES] if lab else None,
            factors or None,
        )

    def _number(
        self,
        row: TableRow,
        index: int,
        note_sign: Callable[[bool], None] | None = None,
    ) -> float:
        text = self._cell(row, index)
        try:
            number = parse_number(text, decimal=self._profile.decimal)
        except InputError as error:
            where = f"line {row.line}, column {self._headings[index]!r}"
            raise self._source.fault(where, str(error), text) from error
        if note_sign is not None:
            note_sign(number.is_percent)
        return number.value

    def _read_others(self, row: TableRow, read: ReadRow) -> None:
        for index, meaning in self._columns.items():
            if meaning.kind not in {"texture", "gloss"} or not self._cell(row, index):
                continue
            value = self._number(row, index)
            if meaning.kind == "texture":
                read.texture.append(Texture(plain(meaning.value, 60), value))
            elif read.gloss is None:
                read.gloss = value, self._gloss_angle(row, meaning, read)

    def _gloss_angle(
        self, row: TableRow, meaning: Meaning, read: ReadRow
    ) -> float | None:
        text = meaning.value or read.text("gloss_angle")
        if not text:
            return None
        try:
            return parse_number(text, decimal=self._profile.decimal).value
        except InputError as error:
            where = f"line {row.line}, gloss angle"
            raise self._source.fault(where, str(error), text) from error


def _band(meaning: Meaning) -> float:
    return float(meaning.value) if meaning.kind == "factor" else 0.0
