"""A site that mixes and sprays virtual paint."""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray, Texture
from paintlink_simulators.paint.model import reflect
from paintlink_simulators.paint.panel import Panel
from paintlink_simulators.paint.texture import TEXTURE, texture
from paintlink_simulators.paint.toners import TONERS, Formula, amounts
from paintlink_simulators.paint.variation import CAREFUL_SITE, Variation

PANEL_ANGLES_DEG: FloatArray = np.array([-15.0, *np.arange(15.0, 111.0, 5.0)])
"""Where a panel is computed: the angles of every instrument, and some between."""
PANEL_ANGLES_DEG.setflags(write=False)

GLOSS_GU, GLOSS_SPREAD_GU = 92.0, 2.0
"""At 60 degrees, of a clearcoat."""


class SprayBooth:
    """Turns formulas into panels, never twice the same.

    The strengths of its toner cans are drawn once: whoever formulates does not know
    them and can only learn them from panels.

    Parameters
    ----------
    seed
        Of everything random in this booth.
    """

    def __init__(self, variation: Variation = CAREFUL_SITE, *, seed: int) -> None:
        self.variation = variation
        self._rng = np.random.default_rng(seed)
        self._strengths = self._factors(variation.batch, len(TONERS))

    def spray(self, formula: Formula, name: str = "") -> Panel:
        """A new panel of this formula, mixed, sprayed to hiding and clear-coated.

        Raises
        ------
        InputError
            When the formula names no toner of the system, or negative amounts.
        """
        parts = amounts([formula])
        mixed = parts * self._strengths * self._weighed(parts.shape)
        sprayed = self.variation.application
        factors = reflect(
            mixed,
            PANEL_ANGLES_DEG,
            spread=self._factors(sprayed.spread, 1),
            area=self._factors(sprayed.area, 1),
        )
        return Panel(
            PANEL_ANGLES_DEG,
            factors[0],
            name,
            gloss_gu=float(self._rng.normal(GLOSS_GU, GLOSS_SPREAD_GU)),
            texture=_textures(mixed),
        )

    def _weighed(self, shape: tuple[int, ...]) -> FloatArray:
        return np.maximum(
            1.0 + self._rng.normal(0.0, self.variation.weighing, shape), 0
        )

    def _factors(self, deviation: float, count: int) -> FloatArray:
        return np.exp(self._rng.normal(0.0, deviation, count))


def _textures(mixed: FloatArray) -> tuple[Texture, ...]:
    values = texture(mixed)[0].tolist()
    return tuple(
        Texture(name, value, angle)
        for (name, angle), value in zip(TEXTURE, values, strict=True)
    )
