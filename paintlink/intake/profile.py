"""How the columns of a foreign table map to a reading."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, cast, get_args

from paintlink.errors import InputError
from paintlink.instrument import did_you_mean, quoted
from paintlink.intake.conditions import Scale
from paintlink.intake.geometries import read_geometry

Word = Literal[
    "name", "code", "finish", "time", "date", "clock", "maker", "model", "serial",
    "data_mode", "origin", "averaged", "geometry", "illumination", "conditions",
    "illuminant", "observer", "gloss", "gloss_angle", "ignore",
]  # fmt: skip
Kind = Literal[Word, "lab", "factor", "texture"]

WORDS: tuple[Word, ...] = get_args(Word)
MEANINGS = (
    f"{', '.join(WORDS)}; L, a, b or R400 for a value, after a geometry where each has "
    "its own column (45as15 L, 45as-15 R400); gloss 60; texture NAME"
)

_VALUE = re.compile(r"(?:(?P<geometry>\S.*?)\s+)?(?P<value>[Lab]|R\d{3}(?:\.\d)?)")


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a column holds.

    Parameters
    ----------
    geometry
        Its code when the column belongs to one angle.
    value
        ``L``, ``a`` or ``b``; the wavelength in nm; a gloss angle; a texture's name.
    """

    kind: Kind
    geometry: str = ""
    value: str = ""


def read_meaning(text: str) -> Meaning:
    """The meaning that a profile writes as text.

    Raises
    ------
    InputError
        When it is none, with those there are.
    """
    first, _, rest = text.partition(" ")
    if text in WORDS:
        return Meaning(cast("Kind", text))
    if first == "gloss" and rest in {"20", "45", "60", "75", "85"}:
        return Meaning("gloss", value=rest)
    if first == "texture" and rest.strip():
        return Meaning("texture", value=rest.strip())
    found = _VALUE.fullmatch(text)
    if found is None:
        hint = did_you_mean(text, WORDS) or ";"
        msg = f"{quoted(text)} is no meaning of a column{hint} write {MEANINGS}"
        raise InputError(msg)
    code = found["geometry"] or ""
    if code:
        read_geometry(code)
    value = found["value"]
    if value in {"L", "a", "b"}:
        return Meaning("lab", code, value)
    return Meaning("factor", code, value[1:])


def heading_key(heading: str) -> str:
    """A heading as it is compared: without case and extra blanks."""
    return " ".join(heading.split()).casefold()


@dataclass(frozen=True, slots=True, kw_only=True)
class Profile:
    """A mapping of tables.

    Parameters
    ----------
    columns
        Meaning of each heading, which is spelled as `heading_key` gives it.
    scale
        Scale of reflectance in the table.
    conditions
        Of Lab, where no column tells them.
    time_format
        A ``strptime`` pattern; ISO 8601 when empty.
    """

    name: str
    columns: Mapping[str, Meaning]
    delimiter: str = ","
    decimal: str = "."
    scale: Scale = "fraction"
    conditions: str = "D65/10"
    maker: str = "unknown"
    model: str = "unknown"
    data_mode: str = ""
    time_format: str = ""

    def fits(self, headings: Iterable[str]) -> bool:
        """Whether a row of headings has every column the profile uses."""
        return self.needed <= {heading_key(one) for one in headings}

    @property
    def needed(self) -> set[str]:
        """Headings a table must have."""
        used = self.columns.items()
        return {heading for heading, meaning in used if meaning.kind != "ignore"}

    @property
    def is_long(self) -> bool:
        """Whether each row is one angle, named in a column."""
        return any(one.kind == "geometry" for one in self.columns.values())


def profile_fault(profile: Profile) -> str:
    """Why a profile cannot give readings; empty when it can."""
    kinds = {one.kind for one in profile.columns.values()}
    values = [one for one in profile.columns.values() if one.kind in {"lab", "factor"}]
    if not values:
        return "no column holds Lab or reflectance: map L, a, b or R400 to R700"
    if profile.is_long and any(one.geometry for one in values):
        return (
            "a geometry column and values with a geometry of their own: keep one kind"
        )
    if not profile.is_long and not all(one.geometry for one in values):
        return "values without geometry: map a geometry column, or write 45as15 L"
    if "name" not in kinds:
        return "no column is the name: map one"
    return ""
