"""Paintings that hold no paint, each refused with its reason and the way out."""

from __future__ import annotations

import numpy as np

from paintlink.errors import InputError
from paintlink.sketch.selection import CODE, Reason, Selection, counts
from paintlink.sketch.transfer import decode_srgb, linear_srgb_to_lab

LEAST_PIXELS = 2000
FLAT_CODES = 2.0
MIDDLE = (5.0, 95.0)
"""Percentiles a flat colour is judged between, so that a few strokes do not hide it."""

ADVICE: dict[Reason, str] = {
    "edge": "the object is too small: set up a larger picture",
    "gloss": "they lie where the gloss is: paint the sides of the object as well",
    "grazing": "they lie in the shade: paint the parts the light falls on",
    "unchanged": "they look as in the start picture: paint over them",
    "clipped": "they are too bright: set up with less exposure, or paint darker",
    "near-white": "they are nearly white: set up with less exposure, or paint darker",
    "transparent": "they are transparent: flatten the picture before export",
}


def require_paint(selection: Selection) -> None:
    """Refuse a painting of too few usable pixels, or of one flat colour.

    Raises
    ------
    InputError
        With what is wrong and what to do about it.
    """
    _require_pixels(selection)
    low, high = np.percentile(selection.encoded, MIDDLE, axis=0)
    if np.max(high - low) < FLAT_CODES * CODE:
        colour = np.median(selection.encoded, axis=0)
        lab = linear_srgb_to_lab(decode_srgb(colour)).round(1) + 0.0
        values = ", ".join(f"{value:.1f}" for value in lab.tolist())
        msg = (
            "the object is filled with one flat colour, and even a solid paint shades "
            "with the form: keep the shading, or use Lab "
            f"{values} as a solid colour"
        )
        raise InputError(msg)


def _require_pixels(selection: Selection) -> None:
    number = counts(selection.reasons)
    kept = number["kept"]
    if kept >= LEAST_PIXELS:
        return
    worst = max(ADVICE, key=lambda reason: number[reason])
    if not number[worst]:
        msg = "the mask shows no object: run the set-up again"
    elif worst == "unchanged" and not kept:
        msg = "nothing was painted: the picture is the start picture"
    else:
        msg = (
            f"only {kept} painted pixels can be used, {LEAST_PIXELS} are needed; of "
            f"the others on the object {number[worst]} are left out: {ADVICE[worst]}"
        )
    raise InputError(msg)
