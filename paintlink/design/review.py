"""What a designer should know about a colour before it is formulated."""

from __future__ import annotations

from collections.abc import Iterator

from paintlink.color import out_of_gamut
from paintlink.design.weights import FACE_DEG, FLOP_DEG, MIDDLE_DEG, Rate, rate
from paintlink.model import ColorSpec, Match
from paintlink.snap import band


def rates(spec: ColorSpec) -> dict[str, Rate]:
    """Rate of travel of L, a and b."""
    lab = spec.lab(FACE_DEG, MIDDLE_DEG, FLOP_DEG)
    return {
        channel: rate(*values)
        for channel, values in zip("Lab", lab.T.tolist(), strict=True)
    }


def warnings(spec: ColorSpec, nearest: Match) -> tuple[str, ...]:
    """What may make the colour hard to show or to paint; nothing is forbidden."""
    return tuple(_warnings(spec, nearest))


def _warnings(spec: ColorSpec, nearest: Match) -> Iterator[str]:
    face, flop = spec.lab(FACE_DEG, FLOP_DEG)
    if spec.finish != "solid" and face[0] <= flop[0]:
        yield "the flop is not darker than the face, so the Flop Index is 0"
    outside = [
        f"{angle:g}"
        for angle, out in zip(spec.angles_deg, out_of_gamut(spec.lab()), strict=True)
        if out
    ]
    if outside:
        yield f"screens cannot show it at {', '.join(outside)} degrees (outside sRGB)"
    if band(nearest) == "red":
        yield (
            f"no known paint is near (mean difference {nearest.mean:.1f} to "
            f"{nearest.code}): ask a chemist whether it can be made"
        )
