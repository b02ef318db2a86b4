"""What the heading of a column most likely means."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from paintlink.errors import InputError
from paintlink.intake.geometries import read_geometry

# Headings of multi-angle exports in English and German, compared without blanks, points
# and case. Angles are told apart by their own pattern.
_WORDS = {
    "name": ("name", "sample", "samplename", "sampleid", "id", "standard", "probe",
             "muster", "bezeichnung", "colour", "color", "paint", "farbe", "trial"),
    "code": ("code", "paintcode", "colorcode", "colourcode", "farbcode"),
    "finish": ("finish", "type", "painttype", "effekt"),
    "time": ("time", "datetime", "date/time", "timestamp", "measured", "measuredat",
             "zeitstempel", "messzeit"),
    "date": ("date", "datum"),
    "clock": ("clock", "uhrzeit", "zeit", "timeofday"),
    "serial": ("serial", "sn", "serialnumber", "serialno", "seriennummer",
               "instrumentserial"),
    "model": ("model", "instrument", "device", "gerat", "gerät"),
    "maker": ("maker", "manufacturer", "hersteller"),
    "data_mode": ("mode", "datamode", "datenmodus", "legacymode"),
    "geometry": ("geometry", "angle", "winkel", "geometrie", "aspecular",
                 "aspecularangle", "measurementgeometry"),
    "conditions": ("illuminant/observer", "illobs", "ill/obs", "lichtart/beobachter"),
    "illuminant": ("illuminant", "lichtart", "ill"),
    "observer": ("observer", "beobachter", "obs"),
    "averaged": ("readings", "averages", "avgs", "numberofreadings", "n"),
    "origin": ("origin",),
}  # fmt: skip
_KNOWN = {word: meaning for meaning, words in _WORDS.items() for word in words}

_NUMBER = r"\d{1,3}(?:\.\d)?"
_ANGLE = rf"(?:r?\d{{2}}as)?(?:-|minus|\+)?{_NUMBER}(?:az-?{_NUMBER})?"
_AXIS = r"(?:cie)?(?P<axis>[lab])\*?"
_FIRST = re.compile(rf"(?P<angle>{_ANGLE})[/:]?{_AXIS}", re.IGNORECASE)
_LAST = re.compile(rf"{_AXIS}(?P<angle>{_ANGLE})", re.IGNORECASE)
_AXIS_ONLY = re.compile(_AXIS, re.IGNORECASE)
_BAND = re.compile(r"(?:r|nm|refl)?(?P<band>[3-7]\d0)(?:nm)?(?:%)?", re.IGNORECASE)
_ANGLE_BAND = re.compile(
    rf"(?P<angle>{_ANGLE})[/:]?(?:r|nm)?(?P<band>[4-7]\d0)(?:nm)?", re.IGNORECASE
)
_GLOSS = re.compile(r"(?:gloss|glanz|gu)(?P<angle>20|45|60|75|85)?", re.IGNORECASE)
_TEXTURE = re.compile(
    r"(?:si|sa|sg|g|graininess|sparkle\w*|s_[iag]|coarseness)(?:-?\d{1,3})?",
    re.IGNORECASE,
)
# Differences against a standard are no property of the sample.
_DIFFERENCE = re.compile(r"[dδ∆Δ](?:e|l|a|b|c|h|s|g)", re.IGNORECASE)
_BRACKETS = re.compile(
    r"[(\[](?:d65|d50|a|f11|f2)\W?\s*/?\W?(?:10|2)?\W?[)\]]", re.IGNORECASE
)
_CONDITIONS = re.compile(r"\b(?:d65|d50|f11|f2)/(?:10|2)\b", re.IGNORECASE)
_NOISE = re.compile(r"[\s._°()\[\]]+|deg(?:rees?)?\b", re.IGNORECASE)
_DASHED = re.compile(r"[Ll]\*?\s*-\s*(\d{1,3})")


class Dialect(NamedTuple):
    """Whether a dash before an angle is a mere separator in these headings."""

    dash_separates: bool

    @classmethod
    def of(cls, headings: Iterable[str]) -> Dialect:
        """Told from the angles: there is -15, but hardly -45 or -110."""
        angles = {found[1] for one in headings if (found := _DASHED.search(one))}
        return cls(bool(angles & {"25", "45", "75", "110"}))


def meaning_of(heading: str, dialect: Dialect) -> str:
    """The meaning a profile would write for a heading; empty when it is not understood.

    Differences against a standard are ignored on purpose.
    """
    cleaned = _CONDITIONS.sub("", _BRACKETS.sub("", heading))
    text = _NOISE.sub("", cleaned).replace("\u2212", "-").casefold()
    if dialect.dash_separates:
        text = re.sub(r"(?<=[a-z*])-(?=\d)", "", text)
    if text in _KNOWN:
        return _KNOWN[text]
    if _DIFFERENCE.match(text):
        return "ignore"
    return _value_meaning(text) or _other_meaning(text, cleaned)


def _value_meaning(text: str) -> str:
    if _AXIS_ONLY.fullmatch(text):
        return _axis(_AXIS_ONLY.fullmatch(text)["axis"])  # type: ignore[index]
    band = _BAND.fullmatch(text)
    if band:
        return f"R{band['band']}"
    for pattern in (_FIRST, _LAST):
        found = pattern.fullmatch(text)
        if found:
            return _with_angle(found["angle"], _axis(found["axis"]))
    found = _ANGLE_BAND.fullmatch(text)
    return _with_angle(found["angle"], f"R{found['band']}") if found else ""


def _other_meaning(text: str, heading: str) -> str:
    gloss = _GLOSS.fullmatch(text)
    if gloss:
        return f"gloss {gloss['angle']}" if gloss["angle"] else "gloss"
    if _TEXTURE.fullmatch(text):
        return f"texture {' '.join(heading.split())}"
    return ""


def _axis(letter: str) -> str:
    return "L" if letter in "Ll" else letter.lower()


def _with_angle(angle: str, value: str) -> str:
    code = angle if "as" in angle else f"45as{angle}"
    try:
        read_geometry(code)
    except InputError:
        return ""
    return f"{code} {value}"
