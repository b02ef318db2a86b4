"""Edges of pictures, and where one set of edges lies in another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from paintlink.model import FloatArray
from paintlink.sketch.geometry import coverage
from paintlink.sketch.pose import Pose
from paintlink.sketch.strip import paint_strip, strip_fits
from paintlink.sketch.values import PixelArray

WORKING_SIZE = 512
STRONGEST = 0.15
"""An edge counts no more than this, so that a stroke does not outweigh the outline."""

REACH = 56 / 512
NEAR = 12 / 512


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """Edges that lie together.

    ``reach`` is how far they move, in steps, when the picture grows to twice its size.
    """

    strength: FloatArray
    reach: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """Edges every painting of a pose has, on a grid of ``step`` pixels.

    Parameters
    ----------
    whole
        Of the object.
    sides
        The same by the side they lie on: left, right, top, bottom.
    strip
        Between the patches of the control strip.
    """

    whole: FloatArray
    sides: Mapping[str, Part]
    strip: FloatArray
    step: int


@dataclass(frozen=True, slots=True)
class Match:
    """Where edges were found, in steps of the grid, and how well.

    Parameters
    ----------
    share
        How much of the strength of the edges is there; low for faint edges.
    likeness
        Correlation of the two sets of edges; low where there are many others.
    """

    right: float
    down: float
    share: float
    likeness: float


def outline(pose: Pose, shift_px: tuple[float, float] = (0.0, 0.0)) -> Outline:
    """Edges of the object and of the control strip of a pose that was moved."""
    step = max(1, pose.size // WORKING_SIZE)
    slopes = _slopes(_averaged(coverage(pose, shift_px), step))
    sides = {
        "left": _side(slopes, 0, 1.0),
        "right": _side(slopes, 0, -1.0),
        "top": _side(slopes, 1, 1.0),
        "bottom": _side(slopes, 1, -1.0),
    }
    right, down = shift_px
    seams = _seams(len(slopes[0]), (right / step, down / step))
    return Outline(_strength(slopes), sides, seams, step)


def _seams(size: int, shift: tuple[float, float]) -> FloatArray:
    """Edges between the patches of the strip; its long sides look like any line."""
    picture = np.full((size, size, 3), 0.5, dtype=np.float32)
    if strip_fits(size, shift):
        paint_strip(picture, shift)
    channels = [_slopes(picture[..., one].astype(np.float64))[0] for one in range(3)]
    seams: FloatArray = np.minimum(np.abs(channels).max(axis=0), STRONGEST)
    return seams


def thinned(encoded: PixelArray, step: int) -> FloatArray:
    """Strength of the edges of a picture averaged over squares of ``step`` pixels."""
    channels = [_averaged(encoded[..., channel], step) for channel in range(3)]
    strength: FloatArray = np.max([_strength(_slopes(one)) for one in channels], axis=0)
    return strength


def strongest(
    edges: FloatArray, known: FloatArray, reach: float = REACH
) -> Match | None:
    """The move that brings known edges onto those of a picture, to a part of a step.

    Searched within ``reach`` times the size at either side of no move; None when the
    best place is the end of the search, or when there are no edges.
    """
    steps = max(4, round(len(edges) * reach))
    edges, known = edges - edges.mean(), known - known.mean()
    own, other = float((known * known).sum()), float((edges * edges).sum())
    places = _correlation(edges, known, steps)
    row, column = (int(one) for one in np.unravel_index(places.argmax(), places.shape))
    if {row, column} & {0, 2 * steps} or own * other <= 0.0:
        return None
    down = row - steps + _vertex(places[row - 1 : row + 2, column])
    right = column - steps + _vertex(places[row, column - 1 : column + 2])
    peak = float(places[row, column])
    return Match(right, down, peak / own, peak / np.sqrt(own * other))


def _correlation(edges: FloatArray, known: FloatArray, steps: int) -> FloatArray:
    """Agreement for each move down and right, shape (2·steps + 1, 2·steps + 1)."""
    spectrum = np.fft.rfft2(edges) * np.conj(np.fft.rfft2(known))
    everywhere = np.fft.irfft2(spectrum, edges.shape)
    moves = np.arange(-steps, steps + 1)
    found: FloatArray = everywhere[np.ix_(moves, moves)]
    return found


def _vertex(three: FloatArray) -> float:
    """Where the parabola through three neighbours is highest, from the middle one."""
    before, middle, after = (float(one) for one in three)
    bend = before - 2.0 * middle + after
    return 0.0 if bend >= 0.0 else 0.5 * (before - after) / bend


def _side(slopes: tuple[FloatArray, FloatArray], axis: int, sign: float) -> Part:
    """Edges that face one way, by how much they tell of a move that way.

    Coverage falls outwards, so the sign of its slope tells the side.
    """
    strength = _strength(slopes)
    steepness = np.maximum(np.hypot(*slopes), 1e-9)
    inwards = [slope / steepness for slope in slopes]
    facing = np.maximum(sign * inwards[axis], 0.0)
    row, column = np.indices(strength.shape) - (len(strength) - 1) / 2.0
    from_middle = inwards[0] * column + inwards[1] * row
    weight = strength * facing
    grown, told = float((weight * from_middle).sum()), float((weight * facing).sum())
    return Part(weight * facing, sign * grown / told if told else 0.0)


def _strength(slopes: tuple[FloatArray, FloatArray]) -> FloatArray:
    strength: FloatArray = np.minimum(np.hypot(*slopes), STRONGEST)
    return strength


def _slopes(plane: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Central differences along the columns and along the rows."""
    beside, below = np.zeros_like(plane), np.zeros_like(plane)
    beside[:, 1:-1] = 0.5 * (plane[:, 2:] - plane[:, :-2])
    below[1:-1] = 0.5 * (plane[2:] - plane[:-2])
    return beside, below


def _averaged(plane: PixelArray, step: int) -> FloatArray:
    """Means of squares of ``step`` pixels; what is left over at the end is left out."""
    size = len(plane) // step
    cut = plane[: size * step, : size * step].astype(np.float64)
    mean: FloatArray = cut.reshape(size, step, size, step).mean(axis=(1, 3))
    return mean
