"""Why an answer is poor: what the nearest paint cannot follow, in numbers and words."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from paintlink.color import TRAVEL_ANGLES_DEG, flop_index
from paintlink.model import ColorSpec, FloatArray, Match, PaintTable
from paintlink.snap.hull import outside

Kind = Literal[
    "outside", "sparse", "too-chromatic", "off-radial", "face-and-flop", "finish"
]

CHROMATIC_FROM_C = 8.0
HUE_HELD = 0.6
"""Up to this share of the missing chroma the hue may miss and still be called right."""

STEADY_FROM_L45 = 5.0
"""The Flop Index of darker paints says little: L45 stands below the fraction line."""

DENSITY_PAINTS = 10


@dataclass(frozen=True, slots=True)
class Limits:
    """Values above which a finding is told; all in Lab units but the Flop Index.

    Parameters
    ----------
    outside
        Distance beyond the convex hull of the library, at the worst angle.
    sparse
        Mean difference per angle of the ten nearest paints.
    too_chromatic
        Chroma that the nearest paint lacks, mean over the angles.
    off_radial
        Distance of the target's ab-travel from the nearest paint's, across the line
        from neutral through the face.
    face_and_flop
        Lightness travel that the nearest paint lacks or has too much.
    flop_index
        Difference in Flop Index from the nearest paint.
    """

    outside: float = 2.0
    sparse: float = 12.0
    too_chromatic: float = 3.0
    off_radial: float = 4.0
    face_and_flop: float = 4.0
    flop_index: float = 3.0


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that was looked at: its number, its limit, and the sentence for it."""

    kind: Kind
    value: float
    limit: float
    sentence: str

    @property
    def told(self) -> bool:
        """Whether the limit is exceeded, so that people should read the sentence."""
        return self.value > self.limit


def diagnose(
    spec: ColorSpec,
    matches: Sequence[Match],
    table: PaintTable,
    limits: Limits | None = None,
) -> tuple[Finding, ...]:
    """Everything that was looked at, whether it is worth telling or not.

    Parameters
    ----------
    matches
        As `paintlink.snap.nearest` gave them for the specification; the first one is
        judged, and the first ten say how crowded the library is around the target.
    table
        The library of the first match.
    """
    limits = limits or Limits()
    best = matches[0]
    pair = _Pair(spec.lab(*best.angles_deg), best)
    checks: tuple[Callable[[], Iterator[Finding]], ...] = (
        lambda: _outside(spec, table, limits),
        lambda: _sparse(matches, limits),
        lambda: _too_chromatic(pair, limits),
        lambda: _off_radial(pair, limits),
        lambda: _face_and_flop(pair, limits),
        lambda: _finish(pair, limits),
    )
    return tuple(finding for check in checks for finding in check())


def sentences(findings: Sequence[Finding]) -> tuple[str, ...]:
    """What people should read, the farthest beyond its limit first."""
    told = [finding for finding in findings if finding.told]
    told.sort(key=lambda one: one.value / one.limit if one.limit else 0.0, reverse=True)
    return tuple(finding.sentence for finding in told)


class _Pair:
    """Target and nearest paint at the compared angles."""

    def __init__(self, target: FloatArray, match: Match) -> None:
        steps = np.array([(d.dL, d.da, d.db) for d in match.differences])
        self.code = match.code
        self.angles_deg = match.angles_deg
        self.differences = match.differences
        self.target: FloatArray = target
        self.paint: FloatArray = target - steps

    @property
    def face(self) -> int:
        """Position of the smallest angle on the near side of the mirror direction."""
        return next((i for i, a in enumerate(self.angles_deg) if a > 0.0), 0)

    @property
    def flop(self) -> int:
        """Position of the largest angle."""
        return len(self.angles_deg) - 1


def _outside(spec: ColorSpec, table: PaintTable, limits: Limits) -> Iterator[Finding]:
    angles = [angle for angle in spec.angles_deg if angle in table.angles_deg]
    beyond = {
        angle: outside(table, angle, lab)
        for angle, lab in zip(angles, spec.lab(*angles), strict=True)
    }
    if not beyond:
        return
    worst = max(beyond, key=lambda angle: beyond[angle])
    sentence = (
        f"at {worst:g} degrees the colour lies {beyond[worst]:.1f} Lab units outside "
        f"all colours of {table.library}"
    )
    yield Finding("outside", beyond[worst], limits.outside, sentence)


def _sparse(matches: Sequence[Match], limits: Limits) -> Iterator[Finding]:
    if len(matches) < DENSITY_PAINTS:
        return
    around = float(np.mean([match.mean for match in matches[:DENSITY_PAINTS]]))
    sentence = (
        f"few known paints are like it: the {DENSITY_PAINTS} nearest differ by "
        f"{around:.1f} per angle in the mean"
    )
    yield Finding("sparse", around, limits.sparse, sentence)


def _too_chromatic(pair: _Pair, limits: Limits) -> Iterator[Finding]:
    """Figure 12: the hue is right, the chroma is not reached."""
    lacking = float(np.mean([d.dC for d in pair.differences]))
    hue = float(np.mean([abs(d.dH) for d in pair.differences]))
    everywhere = min(d.dC for d in pair.differences) > 0.0
    if not everywhere or hue > HUE_HELD * lacking:
        lacking = 0.0
    sentence = (
        f"the colour is too chromatic: {pair.code} has the hue, but lacks "
        f"{lacking:.1f} in chroma"
    )
    yield Finding("too-chromatic", lacking, limits.too_chromatic, sentence)


def _off_radial(pair: _Pair, limits: Limits) -> Iterator[Finding]:
    """Figure 13: from face to flop the colour leaves the line through neutral."""
    ab_target, ab_paint = pair.target[:, 1:], pair.paint[:, 1:]
    across_target = _across(ab_target, pair.face)
    across_paint = _across(ab_paint, pair.face)
    if across_target is None or across_paint is None:
        return
    apart = np.abs(across_target - across_paint)
    at = int(np.argmax(apart))
    shifting = abs(across_target[at]) > abs(across_paint[at])
    sentence = (
        f"the hue shifts off the radial line: {across_target[at]:+.1f} at "
        f"{pair.angles_deg[at]:g} degrees, where {pair.code} shifts "
        f"{across_paint[at]:+.1f} and cannot follow"
    )
    value = float(apart[at]) if shifting else 0.0
    yield Finding("off-radial", value, limits.off_radial, sentence)


def _across(ab: FloatArray, face: int) -> FloatArray | None:
    """Signed distance of each angle from the line through neutral and the face.

    Positive towards larger hue angles; None where the face has no hue.

    References
    ----------
    The paper's Hue Shift Index, with its sign, at every angle.
    """
    radius = float(np.hypot(*ab[face]))
    if radius < CHROMATIC_FROM_C:
        return None
    a, b = ab[face] / radius
    across: FloatArray = a * ab[:, 1] - b * ab[:, 0]
    return across


def _face_and_flop(pair: _Pair, limits: Limits) -> Iterator[Finding]:
    """Figure 14: brighter face and darker flop than the paint, or the other way."""
    face, flop = pair.differences[pair.face].dL, pair.differences[pair.flop].dL
    opposed = face * flop < 0.0
    value = abs(face - flop) if opposed and pair.face != pair.flop else 0.0
    sides = ("brighter", "darker") if face > 0.0 else ("darker", "brighter")
    sentence = (
        f"the face is {abs(face):.1f} {sides[0]} and the flop {abs(flop):.1f} "
        f"{sides[1]} than {pair.code}"
    )
    yield Finding("face-and-flop", value, limits.face_and_flop, sentence)


def _finish(pair: _Pair, limits: Limits) -> Iterator[Finding]:
    """A paint that travels otherwise looks like another finish at any total."""
    if not set(TRAVEL_ANGLES_DEG) <= set(pair.angles_deg):
        return
    at = [pair.angles_deg.index(angle) for angle in TRAVEL_ANGLES_DEG]
    if min(pair.target[at[1], 0], pair.paint[at[1], 0]) < STEADY_FROM_L45:
        return
    target, paint = flop_index(pair.target[at]), flop_index(pair.paint[at])
    if target is None or paint is None:
        return
    more = "more" if target > paint else "less"
    sentence = (
        f"it flops {more} than {pair.code} (Flop Index {target:.1f} against "
        f"{paint:.1f}), so the finish looks different even where the colour fits"
    )
    yield Finding("finish", abs(target - paint), limits.flop_index, sentence)
