"""The chance that a colour can be made with the virtual paint system."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.color import TRAVEL_ANGLES_DEG
from paintlink.errors import LibraryError
from paintlink.model import ColorSpec, FloatArray
from paintlink.snap.makeable.data import Knowledge, knowledge
from paintlink.snap.makeable.features import features, nearest, place, unplace

ANGLES_DEG = TRAVEL_ANGLES_DEG
LIKELY = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Forecast:
    """Whether a colour can be made with the virtual paint system.

    Parameters
    ----------
    chance
        0 to 1: of colours with this chance so many can be made, to a mean CIEDE2000
        of 1 by the formulation stand-in.
    suggestion
        Lab at 15, 45 and 110 degrees of the nearest colour known to be makeable,
        shape (3, 3).
    away
        Mean ΔE76 per angle from the colour to the suggestion.
    """

    chance: float
    suggestion: FloatArray
    away: float

    @property
    def likely(self) -> bool:
        """Whether it can rather be made than not."""
        return self.chance >= LIKELY

    @property
    def sentence(self) -> str:
        """For people."""
        can = "can" if self.likely else "can hardly"
        text = (
            f"forecast: the virtual paint system {can} make this colour "
            f"(chance {self.chance:.0%})"
        )
        if self.likely:
            return text
        return f"{text}; the nearest it can make is {self.away:.1f} away per angle"


def forecast(spec: ColorSpec) -> Forecast:
    """The forecast for a colour, about a millisecond after the first one.

    Raises
    ------
    LibraryError
        When it has no Lab at 15, 45 and 110 degrees for the 10 degree observer.
    """
    if not set(ANGLES_DEG) <= set(spec.angles_deg) or spec.observer != "10":
        msg = (
            "a forecast needs Lab at 15, 45 and 110 degrees for the 10 degree "
            "observer: measure or design the colour there"
        )
        raise LibraryError(msg)
    lab = spec.lab(*ANGLES_DEG)
    known = knowledge()
    spot = place(lab)
    rows = nearest(known.cloud, known.squares, spot)
    suggestion = unplace(known.cloud[rows[0]].astype(np.float64))
    away = float(np.sqrt(((suggestion - lab) ** 2).sum(axis=1)).mean())
    return Forecast(_chance(known, rows, spot), suggestion, away)


def chances(lab: FloatArray) -> FloatArray:
    """The chance of many colours, Lab (n, 3, 3) at `ANGLES_DEG`, shape (n,)."""
    known = knowledge()
    return np.array([
        _chance(known, nearest(known.cloud, known.squares, spot), spot)
        for spot in place(lab)
    ])


def _chance(known: Knowledge, rows: NDArray[np.int64], spot: FloatArray) -> float:
    x = features(known.cloud[rows].astype(np.float64), spot)
    return float(1.0 / (1.0 + np.exp(-known.log_odds(x))))
