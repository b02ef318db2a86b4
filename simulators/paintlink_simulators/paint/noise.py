"""How much two readings of one panel differ."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from paintlink_simulators.paint.panel import MAX_FACTOR, Panel


@dataclass(frozen=True, slots=True)
class Repeatability:
    """Standard deviations of one reading.

    ``gain`` is relative and shared by all wavelengths of an angle; ``floor`` is a
    reflectance factor, drawn for each wavelength.
    """

    gain: float
    floor: float


EXACT = Repeatability(gain=0.0, floor=0.0)
LABORATORY = Repeatability(gain=0.001, floor=0.0001)
TYPICAL = Repeatability(gain=0.003, floor=0.0002)
WORKSHOP = Repeatability(gain=0.005, floor=0.0003)


def noisy(
    panel: Panel, rng: np.random.Generator, repeatability: Repeatability = TYPICAL
) -> Panel:
    """The panel as one reading shows it: R (1 + gain) + floor, within a panel's limits.

    The three levels are assumptions, chosen so that a white tile repeats within a mean
    ΔE76 of 0.03 (laboratory), 0.09 (typical) and 0.15 (workshop).

    Notes
    -----
    A gain and a floor, because the coefficient of variation of real instruments is
    nearly constant over wavelength and grows below about 5 % reflectance
    (mycolordoc.com, article 2154, six pairs of instrument and sample).
    """
    angles, bands = panel.factors.shape
    gains = 1.0 + rng.normal(0.0, repeatability.gain, (angles, 1))
    floor = rng.normal(0.0, repeatability.floor, (angles, bands))
    factors = np.clip(panel.factors * gains + floor, 0.0, MAX_FACTOR)
    return replace(panel, factors=factors)
