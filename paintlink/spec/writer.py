"""The canonical form of a colour specification: same value, same bytes."""

from __future__ import annotations

import hashlib
from datetime import UTC, datetime
from functools import lru_cache

from paintlink.errors import SpecError
from paintlink.model import (
    ColorSpec,
    Gloss,
    Provenance,
    Spectrum,
    StartingPaint,
    Texture,
)
from paintlink.spec.document import valid_root
from paintlink.spec.markup import Markup
from paintlink.spec.schema import NAMESPACE, ROOT


@lru_cache(maxsize=64)
def write_spec(spec: ColorSpec) -> bytes:
    """Canonical XML of a colour specification, UTF-8.

    On its way through the line a specification is written several times.

    Raises
    ------
    SpecError
        When the specification holds what the schema refuses, such as a control
        character, a text that is too long, or percentages in place of fractions.
    """
    markup = Markup()
    with markup.element(ROOT, xmlns=NAMESPACE):
        markup.leaf("name", spec.name)
        markup.optional("code", spec.code)
        markup.leaf("finish", spec.finish)
        _write_samples(markup, spec)
        _write_gloss(markup, spec.gloss)
        _write_spectra(markup, spec.spectra)
        _write_textures(markup, spec.texture)
        _write_measurement(markup, spec.provenance)
        _write_starting_paint(markup, spec.starting_paint)
    data = markup.to_bytes()
    _require_readable(data)
    return data


def spec_id(spec: ColorSpec) -> str:
    """Name that belongs to this value alone: SHA-256 of its canonical form, in hex."""
    return hashlib.sha256(write_spec(spec)).hexdigest()


def _require_readable(data: bytes) -> None:
    try:
        valid_root(data)
    except SpecError as error:
        raise SpecError(error.what, element=error.element, value=error.value) from error


def _write_samples(markup: Markup, spec: ColorSpec) -> None:
    observer = spec.observer
    with markup.element(
        "samples", illumination=45, illuminant="D65", observer=observer
    ):
        for sample in spec.samples:
            lab = sample.lab._asdict()
            markup.empty("sample", aspecular=sample.aspecular_deg, **lab)


def _write_gloss(markup: Markup, gloss: Gloss | None) -> None:
    if gloss is not None:
        markup.empty("gloss", value=gloss.value_gu, angle=gloss.angle_deg)


def _write_spectra(markup: Markup, spectra: tuple[Spectrum, ...]) -> None:
    if not spectra:
        return
    with markup.element("spectra"):
        for spectrum in spectra:
            _write_spectrum(markup, spectrum)


def _write_spectrum(markup: Markup, spectrum: Spectrum) -> None:
    with markup.element(
        "spectrum",
        aspecular=spectrum.aspecular_deg,
        start=spectrum.start_nm,
        step=spectrum.step_nm,
    ):
        markup.numbers("factor", spectrum.factors)


def _write_textures(markup: Markup, textures: tuple[Texture, ...]) -> None:
    if not textures:
        return
    with markup.element("textures"):
        for texture in textures:
            markup.empty(
                "texture",
                name=texture.name,
                value=texture.value,
                angle=texture.angle_deg,
            )


def _write_measurement(markup: Markup, provenance: Provenance | None) -> None:
    if provenance is None:
        return
    with markup.element("measurement"):
        with markup.element("instrument"):
            markup.leaf("maker", provenance.instrument.maker)
            markup.leaf("model", provenance.instrument.model)
            markup.optional("serial", provenance.instrument.serial)
            markup.optional("firmware", provenance.instrument.firmware)
        markup.leaf("time", _utc(provenance.taken_at))
        markup.leaf("origin", provenance.origin)
        markup.leaf("averaged", provenance.averaged)
        markup.leaf("calibration", provenance.calibration)
        markup.optional("dataMode", provenance.data_mode)


def _write_starting_paint(markup: Markup, paint: StartingPaint | None) -> None:
    if paint is None:
        return
    with markup.element("startingPaint"):
        markup.leaf("code", paint.code)
        markup.leaf("library", paint.library)
        markup.leaf("generation", paint.generation)
        markup.leaf("formula", paint.formula)
        with markup.element("differences", total=paint.total):
            for difference in paint.differences:
                parts = difference._asdict()
                angle = parts.pop("aspecular_deg")
                markup.empty("difference", aspecular=angle, **parts)


def _utc(time: datetime) -> str:
    try:
        utc = time.astimezone(UTC)
    except OverflowError as error:
        msg = "the time lies outside the years 1 to 9999 in UTC: correct the clock"
        raise SpecError(msg, element="time", value=str(time)) from error
    return utc.replace(tzinfo=None).isoformat() + "Z"
