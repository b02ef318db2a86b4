"""Exact nearest-paint search and what its answer says."""

from paintlink.snap.conditions import STANDARD_ANGLES_DEG
from paintlink.snap.search import nearest, nearest_of_all
from paintlink.snap.verdict import BAND_LABELS, Band, band, starting_paint
from paintlink.snap.words import words

__all__ = [
    "BAND_LABELS",
    "STANDARD_ANGLES_DEG",
    "Band",
    "band",
    "nearest",
    "nearest_of_all",
    "starting_paint",
    "words",
]
