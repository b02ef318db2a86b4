"""What a value at one aspecular angle rests on: measured, extrapolated, or refused."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from paintlink.model import FloatArray
from paintlink.sketch.cells import Cells
from paintlink.sketch.local import half_width_deg

Word = Literal["measured", "extrapolated", "refused"]

LEAST_CELLS = 8
LEAST_PIXELS = 200
LEAST_SHARE = 0.4
FLOP_BEYOND_DEG = 107.0
LEAST_SIDE = 0.02
MOST_EXTRAPOLATED = 1


@dataclass(frozen=True, slots=True)
class Evidence:
    """Support of one angle.

    Parameters
    ----------
    cells, pixels
        Inside the window of the angle, strays left out.
    share
        Of the painted pixels inside the window, how many took part, 0 to 1.
    reason
        Why the angle is not measured; empty when it is.
    """

    aspecular_deg: float
    word: Word
    cells: int
    pixels: int
    share: float
    reason: str = ""


def evidence(
    angles_deg: tuple[float, ...],
    cells: Cells,
    used_deg: FloatArray,
    painted_deg: FloatArray,
) -> tuple[Evidence, ...]:
    """Support of every wanted angle.

    One angle without support may be extrapolated from the others; where more lack it
    the face or the flop is unknown, and they are refused.

    Parameters
    ----------
    used_deg
        Aspecular angles of the pixels that took part.
    painted_deg
        Aspecular angles of all changed pixels.
    """
    found = [_alone(angle, cells, used_deg, painted_deg) for angle in angles_deg]
    missing = sum(item.word != "measured" for item in found)
    if missing <= MOST_EXTRAPOLATED:
        return tuple(found)
    return tuple(
        item if item.word == "measured" else replace(item, word="refused")
        for item in found
    )


def _alone(
    angle: float, cells: Cells, used_deg: FloatArray, painted_deg: FloatArray
) -> Evidence:
    h = half_width_deg(angle)
    used = used_deg[np.abs(used_deg - angle) < h]
    painted = int(np.count_nonzero(np.abs(painted_deg - angle) < h))
    number = int(np.count_nonzero(np.abs(cells.theta_deg - angle) < h))
    share = used.size / max(painted, 1)
    reason = (
        _too_little(angle, painted, used.size, number)
        or _covered(angle, share)
        or _one_sided(angle, used)
    )
    word: Word = "extrapolated" if reason else "measured"
    return Evidence(angle, word, number, used.size, share, reason)


def _too_little(angle: float, painted: int, pixels: int, cells: int) -> str:
    if not painted:
        return f"nothing is painted near {angle:g} degrees"
    if pixels < LEAST_PIXELS or cells < LEAST_CELLS:
        return f"only {pixels} of {painted} painted pixels near {angle:g} can be used"
    return ""


def _covered(angle: float, share: float) -> str:
    if share < LEAST_SHARE:
        percent = 100.0 * (1.0 - share)
        return f"{percent:.0f} % near {angle:g} degrees is clipped or stray strokes"
    return ""


def _one_sided(angle: float, used: FloatArray) -> str:
    """Why the pixels do not enclose the angle, empty when they do."""
    low, high = angle - 1.0, min(angle + 1.0, FLOP_BEYOND_DEG)
    least = LEAST_SIDE * used.size
    if np.count_nonzero(used < low) < least:
        return f"nothing usable lies just below {low:g} degrees"
    if np.count_nonzero(used > high) < least:
        return f"nothing usable lies just above {high:g} degrees"
    return ""
