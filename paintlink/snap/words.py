"""Colour differences the way a painter says them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from paintlink.model import AngleDifference, FloatArray

MID_DEG = 45.0

VISIBLE = 0.5
"""Lab units along one axis; what is less goes unsaid."""

CHROMATIC_FROM_C = 8.0
"""From this chroma on, a colour is judged by chroma and hue; below, by a and b."""

PURE_HUES_DEG = {"redder": 25.0, "yellower": 90.0, "greener": 165.0, "bluer": 265.0}
"""Hue angles at which lacquers look purely red, yellow, green and blue."""

PURE_WITHIN_DEG = 20.0
"""A red this close to the pure one is never said to get redder, but bluer."""


LIGHTNESS = "lighter", "darker"
GREY = LIGHTNESS, ("redder", "greener"), ("yellower", "bluer")
CHROMATIC = LIGHTNESS, ("more chromatic", "less chromatic"), None
"""Words for more and less of what painters look at; a hue turns towards a pure one."""


def words(differences: Sequence[AngleDifference], paint: FloatArray) -> str:
    """What the target looks like beside the paint.

    "target: face 1.2 lighter, flop 0.8 bluer" means that the target is lighter than
    the paint at the face, and bluer at the flop. The face is the smallest aspecular
    angle between 0 and 45 degrees, mid is 45, the flop is the largest angle above it;
    of each only the largest difference is told, in Lab units. Other angles are told
    only when there is nothing to see at these.

    Parameters
    ----------
    differences
        Target minus paint.
    paint
        Lab of the paint at the same angles, shape (angles, 3).
    """
    sides = zip(differences, paint.tolist(), strict=True)
    phrases = {d.aspecular_deg: _phrase(d, lab) for d, lab in sides}
    first, *others = phrases.values()
    if first and set(others) == {first}:
        return f"target: {first} throughout"
    named = {name: phrases[angle] for angle, name in _names(list(phrases)).items()}
    unnamed = {f"at {angle:g}": phrase for angle, phrase in phrases.items()}
    said = named if any(named.values()) else unnamed
    parts = [f"{place} {phrase}" for place, phrase in said.items() if phrase]
    return f"target: {', '.join(parts) or 'no visible difference'}"


def _names(angles_deg: Sequence[float]) -> dict[float, str]:
    """What an angle is called; those between the named ones have no name."""
    face = min((angle for angle in angles_deg if 0.0 < angle < MID_DEG), default=None)
    flop = max((angle for angle in angles_deg if angle > MID_DEG), default=None)
    names = {face: "face", MID_DEG: "mid", flop: "flop"}
    return {angle: names[angle] for angle in angles_deg if angle in names}


def _phrase(difference: AngleDifference, paint: Sequence[float]) -> str:
    """The largest amount among what painters look at in such a colour, in words."""
    _, a, b = paint
    grey = math.hypot(a, b) < CHROMATIC_FROM_C
    _, _, lightness, da, db, dC, dH = difference
    amounts = (lightness, da, db) if grey else (lightness, dC, dH)
    amount = max(amounts, key=abs)
    if abs(amount) < VISIBLE:
        return ""
    both = (GREY if grey else CHROMATIC)[amounts.index(amount)]
    if both is None:
        hue_deg = math.degrees(math.atan2(b, a))
        return f"{abs(amount):.1f} {_towards(hue_deg, math.copysign(1.0, amount))}"
    return f"{abs(amount):.1f} {both[amount < 0.0]}"


def _towards(hue_deg: float, turn: float) -> str:
    """What a hue becomes that turns counter-clockwise (1.0) or clockwise (-1.0)."""
    ahead = {
        word: turn * (pure - hue_deg) % 360.0 for word, pure in PURE_HUES_DEG.items()
    }
    return min(
        (word for word in ahead if ahead[word] > PURE_WITHIN_DEG), key=ahead.__getitem__
    )
