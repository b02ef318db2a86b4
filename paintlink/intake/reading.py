"""One function for every file paintlink can import."""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from paintlink.color import normalise
from paintlink.errors import ConfigError, InputError, PaintlinkError
from paintlink.instrument import did_you_mean, quoted
from paintlink.intake.contract import Certainty, Colour, Importer, Options
from paintlink.intake.registry import importers
from paintlink.intake.source import Source, open_source
from paintlink.model import ColorSpec, Reading

log = logging.getLogger(__name__)

SINGLE_HINT = " (solid: --finish solid, or finish in [inbox])"
FAULT = "a fault of the program met in this file"


@dataclass(frozen=True, slots=True)
class Item:
    """One colour of a file: its specification, or why there is none.

    ``reading`` is None for a file that holds specifications already.
    """

    name: str
    reading: Reading | None = None
    spec: ColorSpec | None = None
    refused: str = ""


@dataclass(frozen=True, slots=True)
class Import:
    """Everything one file held.

    Parameters
    ----------
    source
        What messages call the file.
    sha256
        Hash of its content in hex.
    format_id, label
        The importer that read it.
    """

    source: str
    sha256: str
    format_id: str
    label: str
    items: tuple[Item, ...]
    notes: tuple[str, ...] = ()

    @property
    def specs(self) -> tuple[ColorSpec, ...]:
        """The specifications that can be used."""
        return tuple(item.spec for item in self.items if item.spec is not None)


def read_colours(path: Path, options: Options | None = None) -> tuple[ColorSpec, ...]:
    """The specifications in a file that can be used, at least one.

    Raises
    ------
    InputError
        When there is none; otherwise the errors of `read_any`.
    """
    found = read_any(path, options=options)
    if not found.specs:
        reasons = "; ".join(item.refused for item in found.items)
        msg = f"{found.source}: no colour can be used: {reasons}"
        raise InputError(msg)
    return found.specs


def read_any(
    file: Path | bytes,
    *,
    name: str = "",
    format_id: str = "",
    options: Options | None = None,
) -> Import:
    """Everything a file holds, its format told by its content.

    Safe for files of unknown origin. A colour that cannot become a specification, such
    as one with too few angles, is refused by itself; a damaged file as a whole.

    Parameters
    ----------
    file
        A path, or the content.
    name
        What messages call the content.
    format_id
        The importer to use in place of the one the content asks for.

    Raises
    ------
    InputError
        When no importer knows the file, or the one that does refuses it.
    ConfigError
        When there is no importer of this id.
    """
    options = options or Options()
    source = (
        Source(name or "file", file) if isinstance(file, bytes) else open_source(file)
    )
    with _named_faults(source):
        importer = _chosen(source, format_id)
        contents = importer.read(source, options)
    items = [_spec_item(spec, options) for spec in contents.specs]
    items += [_colour_item(colour, options) for colour in contents.colours]
    if not items:
        raise source.fault("", "holds no readings: export it again")
    return Import(
        source=source.name,
        sha256=hashlib.sha256(source.data).hexdigest(),
        format_id=importer.INFO.id,
        label=importer.INFO.label,
        items=tuple(items),
        notes=tuple(dict.fromkeys(contents.notes)),
    )


@contextmanager
def _named_faults(source: Source) -> Iterator[None]:
    """A fault of an importer, which may be anybody's, refuses only this file."""
    try:
        yield
    except PaintlinkError:
        raise
    except Exception as error:
        log.exception("%s: fault of an importer", source.name)
        msg = (
            f"{FAULT} ({type(error).__name__}: {quoted(str(error))}): report it with "
            "this file"
        )
        raise source.fault("", msg) from error


def _chosen(source: Source, format_id: str) -> Importer:
    known = importers()
    if format_id:
        if format_id in known:
            return known[format_id]
        hint = did_you_mean(format_id, known) or ";"
        msg = f"no import format {format_id!r}{hint} there are {', '.join(known)}"
        raise ConfigError(msg)
    certainty, importer = max(
        ((one.sniff(source), one) for one in known.values()), key=lambda pair: pair[0]
    )
    if certainty is Certainty.NO:
        formats = "; ".join(one.INFO.label for one in known.values())
        msg = f"no file paintlink can import; it knows: {formats}"
        raise source.fault("", msg, source.data[:16].decode("latin-1"))
    return importer


def _spec_item(spec: ColorSpec, options: Options) -> Item:
    if spec.finish == "unknown":
        spec = replace(spec, finish=options.finish)
    return Item(spec.name, spec=spec)


def _colour_item(colour: Colour, options: Options) -> Item:
    reading = colour.reading
    finish = options.finish if colour.finish == "unknown" else colour.finish
    try:
        spec = normalise(reading, finish=finish)
    except InputError as error:
        single = len(reading.measurement.geometries) == 1 and finish != "solid"
        hint = SINGLE_HINT if single else ""
        return Item(reading.sample, reading, refused=f"{error}{hint}")
    return Item(reading.sample, reading, replace(spec, code=colour.code))
