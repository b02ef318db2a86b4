"""How a variant looks beside its prime, in one word."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.color import ciede2000, components, lab_to_lch
from paintlink.model import FloatArray
from paintlink.snap.words import CHROMATIC_FROM_C, PURE_HUES_DEG, PURE_WITHIN_DEG

ROLES = (
    "prime",
    "lighter",
    "darker",
    "coarser",
    "finer",
    "redder",
    "greener",
    "yellower",
    "bluer",
    "more chromatic",
    "less chromatic",
)
NO_ROLE = -1
LEAST, MOST = 0.7, 3.5
"""Mean CIEDE2000 over 15, 45 and 110 degrees between variant and prime."""
CLEARLY = 1.25
"""How much the leading difference exceeds the next one."""
MID = 1


def roles(variants: FloatArray, primes: FloatArray) -> NDArray[np.int64]:
    """Index into `ROLES` of each variant, `NO_ROLE` where no word fits, shape (n, r).

    The words are those of `paintlink.snap.words`: chroma and hue for colours, redness
    and yellowness for neutrals. "Coarser" has a brighter face and a darker flop,
    whatever made it so.

    Parameters
    ----------
    variants
        Lab at 15, 45 and 110 degrees, shape (n, r, 3, 3).
    primes
        The same of their primes, shape (n, 3, 3).
    """
    beside = np.broadcast_to(primes[:, np.newaxis], variants.shape)
    found = components(beside, variants)
    coloured = lab_to_lch(primes[:, MID])[:, 1] >= CHROMATIC_FROM_C
    fork = coloured[:, np.newaxis, np.newaxis]
    axes = np.stack(
        [
            found.dL.mean(axis=-1),
            (found.dL[..., 0] - found.dL[..., 2]) / 2.0,
            np.where(fork, found.dC, found.da).mean(axis=-1),
            np.where(fork, found.dH, found.db).mean(axis=-1),
        ],
        axis=-1,
    )
    sizes = np.sort(np.abs(axes), axis=-1)
    leading = np.abs(axes).argmax(axis=-1)
    falls = np.take_along_axis(axes, leading[..., np.newaxis], axis=-1)[..., 0] < 0.0
    words = np.array([_words(lab, c) for lab, c in zip(primes, coloured, strict=True)])
    said = np.take_along_axis(words, 2 * leading + falls, axis=1)
    distance = ciede2000(beside, variants).mean(axis=-1)
    clear = sizes[..., -1] >= CLEARLY * sizes[..., -2]
    return np.where(clear & (distance >= LEAST) & (distance <= MOST), said, NO_ROLE)


def _words(prime: FloatArray, coloured: bool) -> list[int]:
    """Roles of a rise and a fall along each axis."""
    words = ["lighter", "darker", "coarser", "finer"]
    if coloured:
        hue = float(lab_to_lch(prime[MID])[2])
        words += [
            "more chromatic",
            "less chromatic",
            _ahead(hue, 1.0),
            _ahead(hue, -1.0),
        ]
    else:
        words += ["redder", "greener", "yellower", "bluer"]
    return [ROLES.index(word) for word in words]


def _ahead(hue_deg: float, turn: float) -> str:
    """The pure hue that a hue turns to, counter-clockwise (1.0) or clockwise (-1.0)."""
    away = {word: turn * (pure - hue_deg) % 360 for word, pure in PURE_HUES_DEG.items()}
    return min(
        (word for word in away if away[word] > PURE_WITHIN_DEG), key=away.__getitem__
    )
