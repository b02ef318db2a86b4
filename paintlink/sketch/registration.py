"""Where the object of a painting lies: moved, scaled, turned, or in its place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from paintlink.errors import InputError
from paintlink.model import FloatArray
from paintlink.sketch.edges import (
    NEAR,
    REACH,
    Match,
    Outline,
    outline,
    strongest,
    thinned,
)
from paintlink.sketch.pose import Pose
from paintlink.sketch.strip import PATCHES, read_strip
from paintlink.sketch.values import PixelArray

IN_PLACE_STEPS = 0.3
"""A smaller move is taken as none: most pictures were never moved."""

REFINEMENTS = 2
MOST_STRETCH = 0.004
LEAST_CLARITY = 0.4
LEAST_SHARE_OF_SIDE = 0.4
LEAST_SHARE_OF_STRIP = 0.25

STRIP_FOUND = 0.1
STRIP_MISSED = 0.2

WAY_OUT = "save the picture the way the start picture was, without resizing or cropping"

LOST = (
    "the outline of the object is not where the start picture has it: this is another "
    f"picture, or it was cropped, resized or painted over; {WAY_OUT}"
)

ACROSS, UPWARDS = ("left", "right"), ("top", "bottom")

_TURNS: Mapping[str, tuple[int, bool]] = MappingProxyType({
    "mirrored left to right": (0, True),
    "turned by 90 degrees": (1, False),
    "turned by 180 degrees": (2, False),
    "turned by 270 degrees": (3, False),
    "mirrored top to bottom": (2, True),
    "mirrored and turned": (1, True),
    "mirrored and turned back": (3, True),
})


@dataclass(frozen=True, slots=True)
class Shift:
    """How far a picture was moved, in its own pixels."""

    right_px: float
    down_px: float

    @property
    def is_none(self) -> bool:
        """Whether the picture is in its place."""
        return self.right_px == 0.0 and self.down_px == 0.0

    def and_then(self, match: Match, step: int) -> Shift:
        """The sum of this move and another, found on a grid of ``step`` pixels."""
        right, down = match.right * step, match.down * step
        return Shift(self.right_px + right, self.down_px + down)


NO_SHIFT = Shift(0.0, 0.0)


def require_upright(encoded: PixelArray) -> None:
    """Return unless the control strip lies where a mirror or a turn would put it.

    Raises
    ------
    InputError
        Naming the mirror or turn.
    """
    if _strip_error(encoded) < STRIP_MISSED:
        return
    for name, (quarters, mirrored) in _TURNS.items():
        undone = np.rot90(encoded[:, ::-1] if mirrored else encoded, -quarters)
        if _strip_error(undone) < STRIP_FOUND:
            msg = f"the picture was {name}: {WAY_OUT}"
            raise InputError(msg)


def registered(encoded: PixelArray, pose: Pose) -> Shift:
    """How far the object was moved in a painting of a pose.

    The edges of the painting are correlated with the outline of the object, once more
    with the outline moved to where it was found, then with its sides and with the
    control strip apart, which a mere move leaves where they are.

    Raises
    ------
    InputError
        When the outline is not there, or was scaled, turned or distorted.
    """
    known = outline(pose)
    edges = thinned(encoded, known.step)
    found = _require_found(edges, known, REACH)
    if np.hypot(found.right, found.down) < IN_PLACE_STEPS:
        shift = NO_SHIFT
    else:
        shift = NO_SHIFT.and_then(found, known.step)
        for _ in range(REFINEMENTS):
            known = outline(pose, (shift.right_px, shift.down_px))
            found = _require_found(edges, known, NEAR)
            shift = shift.and_then(found, known.step)
    _require_scale(edges, known, found.share)
    _require_straight(edges, known)
    return shift


def _require_found(edges: FloatArray, known: Outline, reach: float) -> Match:
    """Where the outline lies, or the reason why it cannot be told."""
    match = strongest(edges, known.whole, reach)
    if match is not None and max(match.share, match.likeness) >= LEAST_CLARITY:
        return match
    _require_scale(edges, known, LEAST_CLARITY)
    raise InputError(LOST)


def _require_scale(edges: FloatArray, known: Outline, share: float) -> None:
    """Refuse when opposite sides moved apart, or neither of them is there."""
    moves = {}
    for name, side in known.sides.items():
        match = strongest(edges, side.strength, NEAR)
        if match is not None and match.share > LEAST_SHARE_OF_SIDE * share:
            moves[name] = match.right if name in ACROSS else match.down
    across, upwards = (_stretch(known, moves, pair) for pair in (ACROSS, UPWARDS))
    if max(abs(across), abs(upwards)) > MOST_STRETCH:
        msg = (
            f"the object was scaled by about {100 * across:+.1f} % across and "
            f"{100 * upwards:+.1f} % upwards: {WAY_OUT}"
        )
        raise InputError(msg)


def _stretch(
    known: Outline, moves: Mapping[str, float], sides: tuple[str, str]
) -> float:
    """Growth of the distance between two sides; 0 when only one of them is seen."""
    first, second = sides
    if first not in moves and second not in moves:
        raise InputError(LOST)
    if first not in moves or second not in moves:
        return 0.0
    apart = known.sides[second].reach - known.sides[first].reach
    return (moves[second] - moves[first]) / apart


def _require_straight(edges: FloatArray, known: Outline) -> None:
    """Refuse when the strip moved against the object; not when it was painted over."""
    strip = strongest(edges, known.strip)
    if strip is None or strip.share < LEAST_SHARE_OF_STRIP:
        return
    apart = float(np.hypot(strip.right, strip.down))
    if apart > MOST_STRETCH * len(edges):
        msg = (
            f"the control strip moved by {apart * known.step:.1f} px against the "
            f"object: the picture was turned, distorted or put together; {WAY_OUT}"
        )
        raise InputError(msg)


def _strip_error(encoded: PixelArray) -> float:
    return float(np.abs(read_strip(encoded) - PATCHES).mean())
