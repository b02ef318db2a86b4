"""Colour specifications of every kind the format can carry."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta, timezone

import numpy as np
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from paintlink.model import (
    AB_RANGE,
    ASPECULAR_RANGE_DEG,
    FINISHES,
    GLOSS_ANGLES_DEG,
    GLOSS_RANGE_GU,
    L_RANGE,
    OBSERVERS,
    SAMPLE_COUNTS,
    AngleDifference,
    ColorSpec,
    Gloss,
    Instrument,
    Lab,
    Provenance,
    Sample,
    Spectrum,
    StartingPaint,
    Texture,
)

LARGEST = float(np.finfo(np.float64).max)
ANY_NUMBER = (-LARGEST, LARGEST)
NOT_NEGATIVE = (0.0, LARGEST)
FACTOR_RANGE = (-1.0, 20.0)
START_RANGE_NM = (100.0, 10_000.0)
STEP_RANGE_NM = (5e-324, 1000.0)

ORIGINS = ("real", "simulated")
CALIBRATIONS = ("valid", "needed", "unknown")

# A year short of what Python can hold at both ends: zones move the time by a day.
_EARLIEST = datetime(2, 1, 1, tzinfo=UTC)
_LATEST = datetime(9998, 12, 31, tzinfo=UTC)


def is_carried(character: str) -> bool:
    """True for what XML can hold, without control characters."""
    code = ord(character)
    if character in "\t\n\r":
        return True
    return (
        code >= 0x20
        and not 0x7F <= code < 0xA0
        and not 0xD800 <= code < 0xE000
        and code not in {0xFFFE, 0xFFFF}
    )


def texts() -> SearchStrategy[str]:
    return st.text(st.characters().filter(is_carried), max_size=40)


def numbers(bounds: tuple[float, float]) -> SearchStrategy[float]:
    return st.floats(*bounds).map(lambda value: value + 0.0)


def angles(count: int) -> SearchStrategy[list[float]]:
    """Different aspecular angles."""
    angle = numbers(ASPECULAR_RANGE_DEG)
    return st.lists(angle, min_size=count, max_size=count, unique=True)


def labs() -> SearchStrategy[Lab]:
    return st.builds(Lab, numbers(L_RANGE), numbers(AB_RANGE), numbers(AB_RANGE))


@st.composite
def samples(draw: st.DrawFn) -> tuple[Sample, ...]:
    chosen = draw(st.sampled_from(SAMPLE_COUNTS).flatmap(angles))
    return tuple(Sample(angle, draw(labs())) for angle in chosen)


@st.composite
def spectra(draw: st.DrawFn) -> tuple[Spectrum, ...]:
    factors = st.lists(numbers(FACTOR_RANGE), min_size=2, max_size=8).map(tuple)
    start, step = numbers(START_RANGE_NM), numbers(STEP_RANGE_NM)
    chosen = draw(st.integers(0, 4).flatmap(angles))
    return tuple(
        Spectrum(angle, draw(start), draw(step), draw(factors)) for angle in chosen
    )


def textures() -> SearchStrategy[tuple[Texture, ...]]:
    texture = st.builds(
        Texture,
        name=texts(),
        value=numbers(ANY_NUMBER),
        angle_deg=st.none() | numbers(ASPECULAR_RANGE_DEG),
    )
    return st.lists(texture, max_size=3).map(tuple)


def times() -> SearchStrategy[datetime]:
    """Times to the microsecond, each in some zone."""
    minutes = st.integers(-14 * 60, 14 * 60)
    zones = minutes.map(lambda offset: timezone(timedelta(minutes=offset)))
    since = st.timedeltas(timedelta(0), _LATEST - _EARLIEST)
    return st.builds(lambda zone, age: (_EARLIEST + age).astimezone(zone), zones, since)


def provenances() -> SearchStrategy[Provenance]:
    return st.builds(
        Provenance,
        instrument=st.builds(Instrument, texts(), texts(), texts(), texts()),
        taken_at=times(),
        origin=st.sampled_from(ORIGINS),
        averaged=st.integers(1, 2**31 - 1),
        calibration=st.sampled_from(CALIBRATIONS),
        data_mode=texts(),
    )


@st.composite
def starting_paints(draw: st.DrawFn) -> StartingPaint:
    parts = st.tuples(numbers(NOT_NEGATIVE), *[numbers(ANY_NUMBER)] * 5)
    chosen = draw(st.integers(0, 4).flatmap(angles))
    return StartingPaint(
        *draw(st.tuples(*[texts()] * 4)),
        total=draw(numbers(NOT_NEGATIVE)),
        differences=tuple(AngleDifference(angle, *draw(parts)) for angle in chosen),
    )


def glosses() -> SearchStrategy[Gloss]:
    angle = st.none() | st.sampled_from(GLOSS_ANGLES_DEG)
    return st.builds(Gloss, numbers(GLOSS_RANGE_GU), angle)


def color_specs() -> SearchStrategy[ColorSpec]:
    """Every specification that can be written."""
    return st.builds(
        ColorSpec,
        name=texts(),
        samples=samples(),
        finish=st.sampled_from(FINISHES),
        code=texts(),
        observer=st.sampled_from(OBSERVERS),
        gloss=st.none() | glosses(),
        spectra=spectra(),
        texture=textures(),
        provenance=st.none() | provenances(),
        starting_paint=st.none() | starting_paints(),
    )
