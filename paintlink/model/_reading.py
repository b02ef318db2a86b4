"""What an instrument delivered, unconverted."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

import numpy as np

from paintlink.errors import ReadingError, SpecError
from paintlink.model._base import (
    GLOSS_ANGLES_DEG,
    GLOSS_RANGE_GU,
    CalibrationState,
    Finish,
    FloatArray,
    Illuminant,
    Observer,
    Origin,
    readonly,
)


@dataclass(frozen=True, slots=True)
class Geometry:
    """Illumination and viewing directions of one value.

    ``code`` keeps the spelling of the instrument: never derive the physical position
    of the lamp from it, because colour values do not change when lamp and detector
    swap places.
    """

    aspecular_deg: float
    illumination_deg: float = 45.0
    azimuth_deg: float = 0.0
    code: str = ""


@dataclass(frozen=True, slots=True)
class Gloss:
    """Specular gloss in gloss units, with the angle it was measured at if known."""

    value_gu: float
    angle_deg: float | None = None

    def __post_init__(self) -> None:
        if not GLOSS_RANGE_GU[0] <= self.value_gu <= GLOSS_RANGE_GU[1]:
            msg = "gloss must lie between 0 and 2000 gloss units"
            raise SpecError(msg, element="gloss", value=str(self.value_gu))
        if self.angle_deg is not None and self.angle_deg not in GLOSS_ANGLES_DEG:
            angles = ", ".join(f"{angle:g}" for angle in GLOSS_ANGLES_DEG)
            msg = f"the gloss angle must be one of {angles} degrees, or left out"
            raise SpecError(msg, element="gloss", value=str(self.angle_deg))


@dataclass(frozen=True, slots=True)
class Texture:
    """One texture value an instrument reported, such as sparkle intensity at 15.

    Their formulas are not public: carried by name, never computed, never compared
    across makers.
    """

    name: str
    value: float
    angle_deg: float | None = None


@dataclass(frozen=True, slots=True)
class Instrument:
    """What an instrument says it is; empty text where its protocol has no answer."""

    maker: str
    model: str
    serial: str = ""
    firmware: str = ""


@dataclass(frozen=True, slots=True)
class Calibration:
    """State of the white calibration when a reading was taken."""

    state: CalibrationState = "unknown"
    at: datetime | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Spectra:
    """Reflectance factors, one row per geometry.

    Parameters
    ----------
    wavelengths_nm
        Ascending, shape (bands,).
    factors
        Shape (geometries, bands); 1.0 = 100 %; never clipped.
    """

    wavelengths_nm: FloatArray
    factors: FloatArray

    def __post_init__(self) -> None:
        wavelengths = readonly(self.wavelengths_nm, 1)
        factors = readonly(self.factors, 2)
        if factors.shape[1] != wavelengths.size:
            msg = (
                f"{factors.shape[1]} reflectance factors per geometry do not fit "
                f"{wavelengths.size} wavelengths"
            )
            raise ReadingError(msg)
        if not np.isfinite(factors).all():
            row, band = np.argwhere(~np.isfinite(factors))[0]
            msg = (
                f"reflectance factor at {wavelengths[band]:g} nm, geometry "
                f"{row + 1}, is not a number: measure again"
            )
            raise ReadingError(msg)
        object.__setattr__(self, "wavelengths_nm", wavelengths)
        object.__setattr__(self, "factors", factors)


@dataclass(frozen=True, slots=True, eq=False)
class LabValues:
    """Lab as the instrument computed it, shape (geometries, 3), with its conditions."""

    lab: FloatArray
    illuminant: Illuminant
    observer: Observer

    def __post_init__(self) -> None:
        lab = readonly(self.lab, 2)
        if lab.shape[1] != 3:
            msg = f"Lab needs three values per geometry, got {lab.shape[1]}"
            raise ReadingError(msg)
        if not np.isfinite(lab).all():
            msg = "the instrument sent a Lab value that is not a number: measure again"
            raise ReadingError(msg)
        object.__setattr__(self, "lab", lab)


@dataclass(frozen=True, slots=True, eq=False)
class Measurement:
    """What an instrument delivered, unconverted.

    Either ``spectra`` or ``lab`` is present (or both), one row per geometry.
    ``raw`` holds the bytes the values were read from. ``record`` is the instrument's
    own number or time of this reading, by which a repeated transfer is recognised;
    empty when it has none. ``spread`` is the largest CIE76 difference of an averaged
    reading to the mean, one per geometry; empty for a single one.
    """

    geometries: tuple[Geometry, ...]
    spectra: Spectra | None = None
    lab: LabValues | None = None
    gloss: Gloss | None = None
    texture: tuple[Texture, ...] = ()
    averaged: int = 1
    data_mode: str = ""
    raw: bytes = b""
    record: str = ""
    spread: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if self.spectra is None and self.lab is None:
            msg = "the reading holds neither spectra nor Lab values"
            raise ReadingError(msg)
        for name, rows in (
            ("spectra", None if self.spectra is None else self.spectra.factors),
            ("Lab values", None if self.lab is None else self.lab.lab),
        ):
            if rows is not None and len(rows) != len(self.geometries):
                msg = f"{len(rows)} {name} for {len(self.geometries)} geometries"
                raise ReadingError(msg)


@dataclass(frozen=True, slots=True, eq=False)
class Reading:
    """A measurement with everything needed to trust it: who, when, in which state.

    ``taken_at`` is an aware time in UTC. ``sample`` is what the operator called the
    object under the instrument, ``finish`` what the operator declared it to be.
    """

    measurement: Measurement
    instrument: Instrument
    taken_at: datetime
    origin: Origin
    calibration: Calibration = Calibration()
    sample: str = ""
    finish: Finish = "unknown"

    def __post_init__(self) -> None:
        if self.taken_at.tzinfo is None:
            msg = "a reading needs the time it was taken with its time zone"
            raise ReadingError(msg)
