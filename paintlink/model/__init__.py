"""The values that flow through paintlink: frozen, validated, read-only.

Angles are aspecular degrees: measured from the mirror direction, positive towards the
normal. Reflectance factors are fractions: 1.0 is the perfect diffuser, effect paints
exceed it. Lab is CIE 1976 L*a*b*, D65 unless the name says otherwise; the observer is
always stated.
"""

from paintlink.model._base import (
    AB_RANGE,
    ASPECULAR_RANGE_DEG,
    FINISHES,
    GLOSS_ANGLES_DEG,
    GLOSS_RANGE_GU,
    L_RANGE,
    OBSERVERS,
    SAMPLE_COUNTS,
    CalibrationState,
    Finish,
    FloatArray,
    Illuminant,
    Observer,
    Origin,
)
from paintlink.model._paint import Facet, Match, PaintTable
from paintlink.model._reading import (
    Calibration,
    Geometry,
    Gloss,
    Instrument,
    LabValues,
    Measurement,
    Reading,
    Spectra,
    Texture,
)
from paintlink.model._spec import (
    AngleDifference,
    ColorSpec,
    Lab,
    Provenance,
    Sample,
    Spectrum,
    StartingPaint,
)

__all__ = [
    "AB_RANGE",
    "ASPECULAR_RANGE_DEG",
    "FINISHES",
    "GLOSS_ANGLES_DEG",
    "GLOSS_RANGE_GU",
    "L_RANGE",
    "OBSERVERS",
    "SAMPLE_COUNTS",
    "AngleDifference",
    "Calibration",
    "CalibrationState",
    "ColorSpec",
    "Facet",
    "Finish",
    "FloatArray",
    "Geometry",
    "Gloss",
    "Illuminant",
    "Instrument",
    "Lab",
    "LabValues",
    "Match",
    "Measurement",
    "Observer",
    "Origin",
    "PaintTable",
    "Provenance",
    "Reading",
    "Sample",
    "Spectra",
    "Spectrum",
    "StartingPaint",
    "Texture",
]
