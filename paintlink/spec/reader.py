"""From the XML of a colour specification to the value it describes."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from functools import wraps
from typing import TypeVar, cast

from paintlink.errors import SpecError
from paintlink.model import (
    AngleDifference,
    CalibrationState,
    ColorSpec,
    Finish,
    Gloss,
    Instrument,
    Lab,
    Observer,
    Origin,
    Provenance,
    Sample,
    Spectrum,
    StartingPaint,
    Texture,
)
from paintlink.spec.document import line_of, valid_root
from paintlink.spec.fields import Fields

T = TypeVar("T")


def read_spec(data: bytes, *, source: str | None = None) -> ColorSpec:
    """Colour specification in an XML document of format 1.

    Safe for documents of unknown origin: nothing they name is ever opened.

    Parameters
    ----------
    data
        The document, UTF-8 or UTF-16, at most 1 MiB.
    source
        Where it came from, for messages.

    Raises
    ------
    SpecError
        When the document is refused, with the line, the element and the value where
        such exist, and with what to do next.
    """
    try:
        return to_spec(Fields(valid_root(data)))
    except SpecError as error:
        raise SpecError(
            error.what,
            source=source,
            line=error.line,
            element=error.element,
            value=error.value,
        ) from error


def _located(read: Callable[[Fields], T]) -> Callable[[Fields], T]:
    """The same function, whose errors know the line of the element they are about."""

    @wraps(read)
    def read_here(fields: Fields) -> T:
        try:
            return read(fields)
        except SpecError as error:
            if error.line is None:
                error.line = line_of(fields.node)
            raise

    return read_here


@_located
def to_spec(root: Fields) -> ColorSpec:
    """Colour specification under a root that satisfies the schema."""
    (samples,) = root.children("samples")
    return ColorSpec(
        name=root.text("name"),
        samples=tuple(map(_sample, samples.children("sample"))),
        finish=cast("Finish", root.text("finish")),
        code=root.text("code"),
        observer=cast("Observer", samples.word("observer")),
        gloss=_optional(root, "gloss", _gloss),
        spectra=_optional(root, "spectra", _spectra) or (),
        texture=_optional(root, "textures", _textures) or (),
        provenance=_optional(root, "measurement", _provenance),
        starting_paint=_optional(root, "startingPaint", _starting_paint),
    )


def _optional(root: Fields, element: str, read: Callable[[Fields], T]) -> T | None:
    child = root.child(element)
    return None if child is None else read(child)


@_located
def _sample(sample: Fields) -> Sample:
    lab = Lab(sample.number("L"), sample.number("a"), sample.number("b"))
    return Sample(sample.number("aspecular"), lab)


@_located
def _gloss(gloss: Fields) -> Gloss:
    return Gloss(gloss.number("value"), gloss.optional_number("angle"))


def _spectra(spectra: Fields) -> tuple[Spectrum, ...]:
    return tuple(map(_spectrum, spectra.children("spectrum")))


@_located
def _spectrum(spectrum: Fields) -> Spectrum:
    return Spectrum(
        aspecular_deg=spectrum.number("aspecular"),
        start_nm=spectrum.number("start"),
        step_nm=spectrum.number("step"),
        factors=spectrum.numbers(),
    )


def _textures(textures: Fields) -> tuple[Texture, ...]:
    return tuple(map(_texture, textures.children("texture")))


def _texture(texture: Fields) -> Texture:
    return Texture(
        name=texture.word("name"),
        value=texture.number("value"),
        angle_deg=texture.optional_number("angle"),
    )


@_located
def _provenance(measurement: Fields) -> Provenance:
    (instrument,) = measurement.children("instrument")
    return Provenance(
        instrument=_instrument(instrument),
        taken_at=datetime.fromisoformat(measurement.text("time").strip(" \t\r\n")),
        origin=cast("Origin", measurement.text("origin")),
        averaged=int(measurement.text("averaged", "1")),
        calibration=cast(
            "CalibrationState", measurement.text("calibration", "unknown")
        ),
        data_mode=measurement.text("dataMode"),
    )


def _instrument(instrument: Fields) -> Instrument:
    return Instrument(
        maker=instrument.text("maker"),
        model=instrument.text("model"),
        serial=instrument.text("serial"),
        firmware=instrument.text("firmware"),
    )


@_located
def _starting_paint(paint: Fields) -> StartingPaint:
    (differences,) = paint.children("differences")
    return StartingPaint(
        code=paint.text("code"),
        library=paint.text("library"),
        generation=paint.text("generation"),
        formula=paint.text("formula"),
        total=differences.number("total"),
        differences=tuple(map(_difference, differences.children("difference"))),
    )


def _difference(difference: Fields) -> AngleDifference:
    names = ("aspecular", *AngleDifference._fields[1:])
    return AngleDifference(*(difference.number(name) for name in names))
