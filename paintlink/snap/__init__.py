"""Exact nearest-paint search and what its answer says."""

from paintlink.snap.answer import Answer, Options, answer, answer_of_all
from paintlink.snap.cache import INDEXES
from paintlink.snap.conditions import STANDARD_ANGLES_DEG
from paintlink.snap.confidence import Confidence, confidence
from paintlink.snap.diagnosis import Finding, Limits, diagnose, sentences
from paintlink.snap.makeable import Forecast, forecast
from paintlink.snap.search import nearest, nearest_of_all
from paintlink.snap.verdict import BAND_LABELS, Band, band, starting_paint
from paintlink.snap.words import words

__all__ = [
    "BAND_LABELS",
    "INDEXES",
    "STANDARD_ANGLES_DEG",
    "Answer",
    "Band",
    "Confidence",
    "Finding",
    "Forecast",
    "Limits",
    "Options",
    "answer",
    "answer_of_all",
    "band",
    "confidence",
    "diagnose",
    "forecast",
    "nearest",
    "nearest_of_all",
    "sentences",
    "starting_paint",
    "words",
]
