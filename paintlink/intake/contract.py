"""What an importer is: one module with `INFO`, `sniff` and `read`."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import UTC, datetime, tzinfo
from enum import IntEnum
from typing import Protocol

from paintlink.intake.conditions import Scale
from paintlink.intake.profile import Profile
from paintlink.intake.source import Source
from paintlink.model import ColorSpec, Finish, Reading

NO_TIME = "no time of measurement in the file: the file's own time was taken"


def _now() -> datetime:
    return datetime.now(UTC)


class Certainty(IntEnum):
    """How sure an importer is that a file is its own; the surest one reads it."""

    NO = 0
    MAYBE = 1
    SURE = 2


@dataclass(frozen=True, slots=True)
class ImporterInfo:
    """Who an importer is; ``id`` is the name of its module."""

    id: str
    label: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """What a person may know better than a file.

    Parameters
    ----------
    finish
        Taken for colours whose file names none.
    scale
        Overrides the scale of the reflectance factors the format is defined with.
    geometry
        Code taken for values whose file does not say at which geometry they are.
    data_mode
        The mode to take from a file that holds several.
    zone
        Time zone of the times in files that name none; the machine's when None.
    received_at
        Taken for values whose file does not say when they were measured.
    profiles
        Mappings of tables, the first that fits the header counts.
    """

    finish: Finish = "unknown"
    scale: Scale | None = None
    geometry: str = ""
    data_mode: str = ""
    zone: tzinfo | None = None
    received_at: datetime = field(default_factory=_now)
    profiles: tuple[Profile, ...] = ()


@dataclass(frozen=True, slots=True)
class Colour:
    """A reading, and what its file says about the paint under the instrument."""

    reading: Reading
    finish: Finish = "unknown"
    code: str = ""


@dataclass(frozen=True, slots=True)
class Contents:
    """What a file holds, unconverted, and what its reader wants a person to know."""

    colours: tuple[Colour, ...] = ()
    specs: tuple[ColorSpec, ...] = ()
    notes: tuple[str, ...] = ()


class Importer(Protocol):
    """The module of one file format."""

    INFO: ImporterInfo

    def sniff(self, source: Source) -> Certainty:
        """How sure it is that the file is of this format, judged by its content."""
        ...

    def read(self, source: Source, options: Options) -> Contents:
        """Everything the file holds.

        Raises
        ------
        InputError
            When the file is damaged or not of this format, with the place.
        """
        ...
