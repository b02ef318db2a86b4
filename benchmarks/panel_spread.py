"""How far two panels, two readings, two sites lie apart in colour.

Run ``python benchmarks/panel_spread.py``. Each row switches one thing on and gives the
median CIEDE2000 to the exact panel at every angle, then median and 95th percentile of
the mean over the angles, of 500 effect paints of the bundled library.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from paintlink.color import ciede2000, reflectance_to_lab
from paintlink.library import book
from paintlink.model import FloatArray
from paintlink_simulators.paint import (
    EXACT_SITE,
    LABORATORY,
    TYPICAL,
    WAVELENGTHS_NM,
    WORKSHOP,
    Formula,
    Panel,
    SprayBooth,
    Variation,
    noisy,
)
from paintlink_simulators.paint.variation import BODY_SHOP, CARELESS, PAINTER, ROBOT

ANGLES_DEG = (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)
PAINTS = 500
ROWS = {
    "reading, laboratory": replace(EXACT_SITE, reading=LABORATORY),
    "reading, typical": replace(EXACT_SITE, reading=TYPICAL),
    "reading, workshop": replace(EXACT_SITE, reading=WORKSHOP),
    "spray, robot": replace(EXACT_SITE, application=ROBOT),
    "spray, painter": replace(EXACT_SITE, application=PAINTER),
    "spray, body shop": replace(EXACT_SITE, application=BODY_SHOP),
    "spray, careless": replace(EXACT_SITE, application=CARELESS),
    "batch, 3 %": replace(EXACT_SITE, batch=0.03),
    "batch, 5 %": replace(EXACT_SITE, batch=0.05),
    "weighing, 0.4 %": replace(EXACT_SITE, weighing=0.004),
}


def main() -> None:
    """Print the table."""
    formulas = chosen()
    exact = np.array([lab(SprayBooth(EXACT_SITE, seed=0).spray(f)) for f in formulas])
    print(f"{'':22}{''.join(f'{angle:7g}' for angle in ANGLES_DEG)}   mean    p95")
    for name, variation in ROWS.items():
        away = ciede2000(exact, sprayed(formulas, variation))
        numbers = [
            *np.median(away, axis=0),
            *np.percentile(away.mean(axis=1), [50, 95]),
        ]
        print(f"{name:22}{''.join(f'{number:7.2f}' for number in numbers)}")


def chosen() -> list[Formula]:
    """Formulas of some effect paints."""
    known = book()
    effects = [r for r, one in enumerate(known.table.finishes) if one != "solid"]
    rows = np.random.default_rng(1).choice(effects, PAINTS, replace=False).tolist()
    return [{one.code: one.parts for one in known.formula(row)} for row in rows]


def sprayed(formulas: list[Formula], variation: Variation) -> FloatArray:
    """Lab of one panel each, every one from another site, shape (n, angles, 3)."""
    rng = np.random.default_rng(2)
    panels = (
        SprayBooth(variation, seed=seed).spray(formula)
        for seed, formula in enumerate(formulas)
    )
    return np.array([lab(noisy(panel, rng, variation.reading)) for panel in panels])


def lab(panel: Panel) -> FloatArray:
    """Lab D65/10 of a panel at the angles, shape (angles, 3)."""
    return reflectance_to_lab(WAVELENGTHS_NM, panel.factors_at(ANGLES_DEG))


if __name__ == "__main__":
    main()
