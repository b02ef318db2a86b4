"""How the columns of a table are called and written: the mapping profile."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from paintlink.errors import ConfigError
from paintlink.model import ASPECULAR_RANGE_DEG, FINISHES, OBSERVERS, Finish, Observer

TEXT_FIELDS = ("code", "name", "finish", "gloss", "observer", "illuminant", "origin")
LAB_FIELD = re.compile(r"([Lab])(-?\d+(?:\.\d+)?)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Profile:
    """What paintlink cannot see by itself in a table of paints.

    Parameters
    ----------
    columns
        Heading of the table for a field: ``code``, ``name``, ``finish``, ``gloss``,
        ``observer``, ``illuminant``, ``origin``, or a letter of Lab with its aspecular
        angle, such as ``L15`` or ``b-15``.
    finishes
        Finish for a text of the finish column.
    delimiter, decimal, encoding
        How the file is written; found out when left empty, the encoding is UTF-8.
    observer
        Observer of the whole table where it has no such column.
    """

    columns: Mapping[str, str] = field(default_factory=dict)
    finishes: Mapping[str, Finish] = field(default_factory=dict)
    delimiter: str = ""
    decimal: str = ""
    encoding: str = ""
    observer: Observer = "10"

    def __post_init__(self) -> None:
        for name in self.columns:
            _check_field(name)
        for text, finish in self.finishes.items():
            _require(finish, FINISHES, f"the finish of {text!r}")
        if self.decimal:
            _require(self.decimal, (".", ","), "decimal")
        _require(self.observer, OBSERVERS, "observer")
        if self.delimiter and (len(self.delimiter) > 1 or self.delimiter in '"\r\n'):
            msg = f"the delimiter is one character (found {self.delimiter!r})"
            raise ConfigError(msg)
        _check_encoding(self.encoding)

    def with_columns(self, columns: Mapping[str, str]) -> Profile:
        """The same profile with more columns named."""
        return replace(self, columns={**self.columns, **columns})


def read_profile(path: Path) -> Profile:
    """The profile in a TOML file with the fields of `Profile` as keys.

    Raises
    ------
    ConfigError
        When it cannot be read, or says something that no profile says.
    """
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        msg = f"profile {path} cannot be read: {error.strerror}"
        raise ConfigError(msg) from error
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        msg = f"profile {path} is no TOML file: {error}"
        raise ConfigError(msg) from error
    try:
        return _profile(document)
    except ConfigError as error:
        msg = f"profile {path}: {error}"
        raise ConfigError(msg) from error


def field_of(letter: str, angle_deg: float) -> str:
    """Name of the field of a letter of Lab at an aspecular angle."""
    return f"{letter}{angle_deg:g}"


def _profile(document: dict[str, Any]) -> Profile:
    tables = ("columns", "finishes")
    known = [one.name for one in fields(Profile)]
    for key, value in document.items():
        _require(key, known, "a key")
        texts = value.values() if isinstance(value, dict) else [value]
        right = isinstance(value, dict) == (key in tables)
        if not right or not all(isinstance(text, str) for text in texts):
            kind = "a table of texts" if key in tables else "a text"
            msg = f"{key} must be {kind} (found {value!r})"
            raise ConfigError(msg)
    return Profile(**document)


def _check_field(name: str) -> None:
    found = LAB_FIELD.fullmatch(name)
    low, high = ASPECULAR_RANGE_DEG
    if name not in TEXT_FIELDS and not (found and low <= float(found[2]) <= high):
        msg = (
            f"there is no field {name!r}: take {', '.join(TEXT_FIELDS)}, or a letter "
            "of Lab with its angle, such as L15, a45 or b-15"
        )
        raise ConfigError(msg)


def _require(value: str, known: Any, what: str) -> None:
    if value not in known:
        msg = f"{what} must be one of {', '.join(known)} (found {value!r})"
        raise ConfigError(msg)


def _check_encoding(name: str) -> None:
    try:
        "".encode(name or "utf-8")
    except LookupError as error:
        msg = f"there is no encoding {name!r}: take utf-8, cp1252, latin-1 or utf-16"
        raise ConfigError(msg) from error
