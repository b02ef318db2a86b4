"""The colour-difference formulas a user can choose from, by their id."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from numpy.typing import ArrayLike

from paintlink.color.ciede2000 import ciede2000
from paintlink.color.difference import cie76, cie94, cmc, din99
from paintlink.color.din6175 import din6175
from paintlink.model import FloatArray


@dataclass(frozen=True, slots=True)
class Formula:
    """One difference formula and what a caller has to know about it.

    Parameters
    ----------
    symmetric
        Whether standard and sample may change places.
    needs_angle
        Whether the aspecular angle enters the difference.
    experimental
        Whether the label and every result must say so.
    """

    id: str
    label: str
    function: Callable[..., FloatArray]
    symmetric: bool = True
    needs_angle: bool = False
    experimental: bool = False

    def __call__(
        self, standard: ArrayLike, sample: ArrayLike, aspecular_deg: ArrayLike
    ) -> FloatArray:
        """Difference of Lab arrays (..., 3), shape (...).

        ``aspecular_deg`` broadcasts against (...); formulas that do not need it
        ignore it.
        """
        if self.needs_angle:
            return self.function(standard, sample, aspecular_deg)
        return self.function(standard, sample)


FORMULAS: Mapping[str, Formula] = MappingProxyType({
    formula.id: formula
    for formula in (
        Formula("cie76", "CIE76", cie76),
        Formula("cie94", "CIE94 (graphic arts)", cie94, symmetric=False),
        Formula("ciede2000", "CIEDE2000", ciede2000),
        Formula("cmc", "CMC(2:1)", cmc, symmetric=False),
        Formula("din99", "DIN99", din99),
        Formula(
            "din6175",
            "DIN 6175-2 style (experimental)",
            din6175,
            needs_angle=True,
            experimental=True,
        ),
    )
})
