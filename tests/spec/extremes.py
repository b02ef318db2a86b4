"""Seeded specifications full of the numbers that decimal notation gets wrong."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import UTC, datetime, timedelta
from typing import TypeVar

import numpy as np

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
from tests.spec.strategies import (
    ANY_NUMBER,
    CALIBRATIONS,
    FACTOR_RANGE,
    NOT_NEGATIVE,
    ORIGINS,
    START_RANGE_NM,
    STEP_RANGE_NM,
    is_carried,
)

T = TypeVar("T")

_TINY = (5e-324, 2.2250738585072014e-308, 2.225073858507201e-308, 1e-300, 1.5e-7)
_POOL = 20_000
_ALPHABET = [chr(code) for code in range(0x500) if is_carried(chr(code))]
_ALPHABET += list("\t\n\r \u2028\ufffd😀\U0010ffff") * 10
_CHARACTERS = np.array(_ALPHABET)


def _pool(rng: np.random.Generator, bounds: tuple[float, float]) -> list[float]:
    """Numbers at the limits, just inside them, near zero, and everywhere between."""
    low, high = bounds
    small = rng.choice([-1.0, 1.0], _POOL) * rng.choice(_TINY, _POOL)
    wide = rng.uniform(low / 2, high / 2, _POOL) * 2
    kinds = np.array([
        np.full(_POOL, low),
        np.full(_POOL, high),
        np.full(_POOL, np.nextafter(low, high)),
        np.full(_POOL, np.nextafter(high, low)),
        small,
        wide,
        wide * 10.0 ** rng.uniform(-330, 0, _POOL),
        np.round(wide),
    ])
    chosen = kinds[rng.integers(0, len(kinds), _POOL), np.arange(_POOL)]
    return (np.clip(chosen, low, high) + 0.0).tolist()


class Extremes:
    """Values at, beside and between their limits, from one generator."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self._pools: dict[tuple[float, float], list[float]] = {}

    def numbers(self, bounds: tuple[float, float], count: int) -> list[float]:
        if len(self._pools.get(bounds, [])) < count:
            self._pools[bounds] = _pool(self.rng, bounds)
        return [self._pools[bounds].pop() for _ in range(count)]

    def number(self, bounds: tuple[float, float]) -> float:
        return self.numbers(bounds, 1)[0]

    def angles(self, count: int) -> list[float]:
        angles = list(dict.fromkeys(self.numbers(ASPECULAR_RANGE_DEG, 4 * count)))
        return angles[:count] if len(angles) >= count else self.angles(count)

    def text(self) -> str:
        size = self.rng.integers(0, 12)
        return "".join(_CHARACTERS[self.rng.integers(0, len(_CHARACTERS), size)])

    def one_of(self, choices: Sequence[T]) -> T:
        return choices[self.rng.integers(len(choices))]

    def sometimes(self, make: Callable[[], T], otherwise: T) -> T:
        return make() if self.rng.random() < 0.3 else otherwise


def random_spec(extremes: Extremes) -> ColorSpec:
    """Specification whose every number sits where notation is hardest."""
    draw = extremes
    return ColorSpec(
        name=draw.text(),
        samples=_samples(draw),
        finish=draw.one_of(FINISHES),
        code=draw.text(),
        observer=draw.one_of(OBSERVERS),
        gloss=draw.sometimes(lambda: _gloss(draw), None),
        spectra=draw.sometimes(lambda: _spectra(draw), ()),
        texture=draw.sometimes(lambda: _texture(draw), ()),
        provenance=draw.sometimes(lambda: _provenance(draw), None),
        starting_paint=draw.sometimes(lambda: _starting_paint(draw), None),
    )


def _samples(draw: Extremes) -> tuple[Sample, ...]:
    angles = draw.angles(draw.one_of(SAMPLE_COUNTS))
    lightness = draw.numbers(L_RANGE, len(angles))
    a, b = (draw.numbers(AB_RANGE, len(angles)) for _ in range(2))
    rows = zip(angles, lightness, a, b, strict=True)
    return tuple(Sample(angle, Lab(*lab)) for angle, *lab in rows)


def _gloss(draw: Extremes) -> Gloss:
    return Gloss(draw.number(GLOSS_RANGE_GU), draw.one_of((None, *GLOSS_ANGLES_DEG)))


def _spectra(draw: Extremes) -> tuple[Spectrum, ...]:
    return tuple(
        Spectrum(
            angle,
            draw.number(START_RANGE_NM),
            draw.number(STEP_RANGE_NM),
            tuple(draw.numbers(FACTOR_RANGE, draw.one_of(range(2, 32)))),
        )
        for angle in draw.angles(draw.one_of((1, 3)))
    )


def _texture(draw: Extremes) -> tuple[Texture, ...]:
    angle = draw.sometimes(lambda: draw.number(ASPECULAR_RANGE_DEG), None)
    return (Texture(draw.text(), draw.number(ANY_NUMBER), angle),)


def _provenance(draw: Extremes) -> Provenance:
    microseconds = int(draw.rng.integers(0, 10**17))
    return Provenance(
        Instrument(draw.text(), draw.text(), draw.text(), draw.text()),
        taken_at=datetime(1, 1, 1, tzinfo=UTC) + timedelta(microseconds=microseconds),
        origin=draw.one_of(ORIGINS),
        averaged=draw.one_of((1, 3, 2**31 - 1)),
        calibration=draw.one_of(CALIBRATIONS),
        data_mode=draw.text(),
    )


def _starting_paint(draw: Extremes) -> StartingPaint:
    return StartingPaint(
        *(draw.text() for _ in range(4)),
        total=draw.number(NOT_NEGATIVE),
        differences=tuple(
            AngleDifference(
                angle, draw.number(NOT_NEGATIVE), *draw.numbers(ANY_NUMBER, 5)
            )
            for angle in draw.angles(3)
        ),
    )
