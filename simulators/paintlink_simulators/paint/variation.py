"""What differs from one panel to the next: three switches, and presets for them.

All levels are assumptions; docs/paint-model.md gives the colour differences they lead
to.
"""

from __future__ import annotations

from dataclasses import dataclass

from paintlink_simulators.paint.noise import (
    EXACT,
    TYPICAL,
    WORKSHOP,
    Repeatability,
)


@dataclass(frozen=True, slots=True)
class Application:
    """How evenly somebody sprays.

    Standard deviations of the logarithm, one draw a panel: ``spread`` of the tilt of
    the flakes, ``area`` of how much of them faces outwards.
    """

    spread: float
    area: float


STILL = Application(spread=0.0, area=0.0)
ROBOT = Application(spread=0.01, area=0.01)
PAINTER = Application(spread=0.025, area=0.02)
BODY_SHOP = Application(spread=0.05, area=0.04)
CARELESS = Application(spread=0.08, area=0.06)


@dataclass(frozen=True, slots=True)
class Variation:
    """The three switches, and the scales.

    Parameters
    ----------
    reading
        Between two readings of one panel; instruments apply it.
    application
        Between two panels of one formula.
    batch
        Between the toner cans of two sites: relative deviation of each strength, drawn
        once a site.
    weighing
        Relative deviation of each weighed amount.
    """

    reading: Repeatability = TYPICAL
    application: Application = PAINTER
    batch: float = 0.03
    weighing: float = 0.004


CAREFUL_SITE = Variation()
BODY_SHOP_SITE = Variation(reading=WORKSHOP, application=BODY_SHOP, batch=0.05)
EXACT_SITE = Variation(EXACT, STILL, batch=0.0, weighing=0.0)
