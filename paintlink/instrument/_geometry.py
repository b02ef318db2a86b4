"""Geometry codes as instruments and files spell them."""

from __future__ import annotations

import re

from paintlink.errors import InputError
from paintlink.instrument._text import quoted
from paintlink.model import ASPECULAR_RANGE_DEG, Geometry

_NUMBER = r"(?:-|\+|minus)?\d{1,3}(?:\.\d+)?"
_CODE = re.compile(
    rf"r?(?P<illumination>\d{{1,2}}(?:\.\d+)?)as(?P<aspecular>{_NUMBER})"
    rf"(?:az(?P<azimuth>{_NUMBER}))?",
    re.IGNORECASE | re.ASCII,
)
_CLASSIC = "45_0"


def parse_geometry(code: str) -> Geometry:
    """Return the geometry a code such as ``45as-15`` or ``r45as25az90`` stands for.

    A leading ``r`` swaps lamp and detector, which leaves colour values unchanged: it
    shows in ``Geometry.code`` only. ``45_0`` is 45 degree light seen along the normal,
    aspecular 45.

    Raises
    ------
    InputError
        When the code is not of this kind, or its angles are impossible.
    """
    if code == _CLASSIC:
        return Geometry(aspecular_deg=45.0, code=code)
    match = _CODE.fullmatch(code)
    if match is None:
        msg = (
            f"geometry {quoted(code)} is not of the form 45as15, 45as-15 or 45as25az90"
        )
        raise InputError(msg)
    illumination, aspecular, azimuth = (
        _degrees(match[name]) for name in ("illumination", "aspecular", "azimuth")
    )
    lowest, highest = ASPECULAR_RANGE_DEG
    if illumination >= 90.0 or not lowest <= aspecular <= highest:
        msg = (
            f"geometry {quoted(code)}: the illumination must be below 90 degrees and "
            f"the aspecular angle between {lowest:g} and {highest:g}"
        )
        raise InputError(msg)
    return Geometry(aspecular, illumination, azimuth, code)


def _degrees(text: str | None) -> float:
    return float((text or "0").lower().replace("minus", "-"))
