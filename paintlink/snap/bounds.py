"""Lower bounds of the total difference between a target and any paint in a box.

A box is a range of L, a and b at each angle. A bound that never exceeds the difference
from any point of the box lets a search leave out every paint in it at once. Each
formula has its own; all share these facts about the a-b plane of a box, with n the
nearest and f the farthest point from the neutral axis: |n| <= C <= |f|, and
ΔC² + ΔH² = Δa² + Δb² >= D², D the distance from the target to the rectangle.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.color import lab_to_din99
from paintlink.model import FloatArray
from paintlink.snap.bound2000 import ciede2000_bound
from paintlink.snap.boxes import Box, Numbers, chroma_range, gap, plane_distance2

Bound = Callable[[Numbers, Box, Numbers], Numbers]


@dataclass(frozen=True, slots=True)
class Pruning:
    """How paints are left out under one formula.

    Parameters
    ----------
    bound
        Takes the target (angles, 3, 1...), a box and the aspecular angles
        (angles, 1...); gives the bound at each angle.
    to_space
        Lab to the coordinates the boxes are in, or None for Lab itself.
    dtype
        Of the arithmetic.
    relative, absolute
        Rounding errors of the bound.
    few_leaves, most_leaves
        Leaves evaluated first, and at most at once: few where the formula is dear.
    scan_up_to
        As many paints are compared faster without a tree.
    """

    bound: Bound
    to_space: Callable[[FloatArray], FloatArray] | None = None
    dtype: type[np.floating[Any]] = np.float64
    relative: float = 1e-9
    absolute: float = 1e-12
    few_leaves: int = 6
    most_leaves: int = 32
    scan_up_to: int = 2048

    def lower(
        self, target: FloatArray, box: Box, angles_deg: tuple[float, ...]
    ) -> NDArray[Any]:
        """What no total of a paint in the boxes is below, shape of the boxes.

        Parameters
        ----------
        target
            In the coordinates of the boxes, shape (angles, 3).
        box
            Lowest and highest coordinates, shape (angles, 3, ...).
        """
        tail = (1,) * (box.low.ndim - 2)
        q = target.astype(self.dtype).reshape(*target.shape, *tail)
        angles = np.array(angles_deg, dtype=self.dtype).reshape(-1, *tail)
        summed: NDArray[Any] = self.bound(q, box, angles).sum(axis=0)
        return summed * (1.0 - self.relative) - self.absolute

    def coordinates(self, lab: FloatArray) -> FloatArray:
        """Lab (..., 3) in the coordinates of the boxes."""
        return lab if self.to_space is None else self.to_space(lab)


def cie76_bound(q: Numbers, box: Box, angles_deg: Numbers) -> Numbers:
    """Distance to the box."""
    d = gap(q, box)
    d *= d
    return _root(d[:, 0] + d[:, 1] + d[:, 2])


def cie94_bound(q: Numbers, box: Box, angles_deg: Numbers) -> Numbers:
    """CIE94 with the paint as standard, whose chroma lies in that of the box.

    SC >= SH grow with the chroma of the paint, so with SC and SH at its largest
    ΔC²/SC² + ΔH²/SH² >= (ΔC² + ΔH²)/SC² + ΔH²·(1/SH² − 1/SC²).
    """
    least, most = chroma_range(box)
    C_q = np.sqrt(q[:, 1] ** 2 + q[:, 2] ** 2)
    dC_most = np.maximum(np.maximum(most - C_q, C_q - least), 0.0)
    SC, SH = 1.0 + 0.045 * most, 1.0 + 0.015 * most
    inverse_SC2, inverse_SH2 = 1.0 / (SC * SC), 1.0 / (SH * SH)
    D2 = plane_distance2(q, box)
    dH2 = np.maximum(D2 - dC_most * dC_most, 0.0)
    dL = _lightness_gap(q, box)
    rest = dH2 * (inverse_SH2 - inverse_SC2)
    return _root(dL * dL + D2 * inverse_SC2 + rest)


def cmc_bound(q: Numbers, box: Box, angles_deg: Numbers) -> Numbers:
    """CMC(2:1) with the paint as standard.

    SL and SC grow with its lightness and chroma; SH <= SC, because T <= 0.76 < 1.
    """
    _, most = chroma_range(box)
    L = np.maximum(np.asarray(box.high[:, 0], dtype=np.float64), 16.0)
    SL = np.maximum(0.040975 * L / (1.0 + 0.01765 * L), 0.511)
    SC = 0.0638 * most / (1.0 + 0.0131 * most) + 0.638
    x = _lightness_gap(q, box) / (2.0 * SL)
    return _root(x * x + plane_distance2(q, box) / (SC * SC))


def din6175_bound(q: Numbers, box: Box, angles_deg: Numbers) -> Numbers:
    """Both branches of the formula divide ΔC and ΔH by no more than S.

    A mean of the two branches is not below the smaller one. The geometric means of
    lightness and chroma are largest, and that of lightness smallest, at a corner.
    """
    least_L = np.sqrt(np.maximum(q[:, 0], 0.0) * np.maximum(box.low[:, 0], 0.0))
    most_L = np.sqrt(np.maximum(q[:, 0], 0.0) * np.maximum(box.high[:, 0], 0.0))
    C_q = np.sqrt(q[:, 1] ** 2 + q[:, 2] ** 2)
    root_C = np.sqrt(np.sqrt(C_q * chroma_range(box)[1]))
    gamma = np.abs(angles_deg)
    SL = 0.15 * np.sqrt(most_L) + 31.5 / gamma
    SC = 0.48 * root_C - 0.35 * np.sqrt(least_L) + 42.0 / gamma
    SH = 0.14 * root_C - 0.20 * np.sqrt(least_L) + 21.0 / gamma + 0.7
    S = np.maximum(np.maximum(SC, SH), 0.7)
    x = _lightness_gap(q, box) / SL
    return _root(x * x + plane_distance2(q, box) / (S * S))


def _root(squared: Numbers) -> Numbers:
    root: Numbers = np.sqrt(squared)
    return root


def _lightness_gap(q: Numbers, box: Box) -> Numbers:
    return gap(q[:, 0], Box(box.low[:, 0], box.high[:, 0]))


_IN_FLOAT32: dict[str, Any] = {
    # 1e-3 covers coordinates to 400 at six angles in 24 bits.
    "dtype": np.float32,
    "relative": 1e-5,
    "absolute": 1e-3,
    "most_leaves": 64,
    "scan_up_to": 8192,
}

PRUNING: Mapping[str, Pruning] = MappingProxyType({
    "cie76": Pruning(cie76_bound, **_IN_FLOAT32),
    "din99": Pruning(cie76_bound, lab_to_din99, **_IN_FLOAT32),
    "cie94": Pruning(cie94_bound),
    "cmc": Pruning(cmc_bound),
    "din6175": Pruning(din6175_bound),
    "ciede2000": Pruning(ciede2000_bound, few_leaves=4),
})
"""By formula id; every formula a user can choose has a bound."""
