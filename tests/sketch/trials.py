"""Known paints through known damage: the errors of every fit, paint by paint."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from paintlink.color import ciede2000, fit
from paintlink.errors import InputError
from paintlink.library import bundled
from paintlink.model import FloatArray
from paintlink.sketch.fit import ANGLES_DEG, fit_painting
from paintlink.sketch.result import SketchFit
from paintlink.sketch.values import Painting
from tests.sketch.icc import (
    ADOBE_CURVE,
    ADOBE_PRIMARIES,
    P3_PRIMARIES,
    SRGB_CURVE,
    matrix_profile,
)
from tests.sketch.synthesis import (
    Paint,
    Setup,
    clamped_paint,
    exposure_for,
    noisy,
    picture,
    quantised,
    through_file,
    with_strokes,
)

REAL_CURVES = Path(__file__).parents[3] / "shared" / "data" / "real_paints_curves.csv"
DISPLAY_P3 = matrix_profile(P3_PRIMARIES, SRGB_CURVE, name="Display P3")
ADOBE_RGB = matrix_profile(ADOBE_PRIMARIES, ADOBE_CURVE, name="Adobe RGB (1998)")
FITS = ("local", "paper Lab", "paper RGB")


@dataclass(frozen=True)
class Damage:
    """What happens to a painting before it is read."""

    name: str
    treat: Callable[[FloatArray, np.ndarray, np.random.Generator], Painting]


def _daubed(encoded: FloatArray, mask: np.ndarray, rng: np.random.Generator):
    return with_strokes(noisy(encoded, 0.02, rng), mask, 0.1, rng)


EXACT = Damage("16 bits", lambda encoded, mask, rng: quantised(encoded, 16))
PNG = Damage("PNG, 8 bits", lambda encoded, mask, rng: through_file(encoded, "PNG"))
DAUBED = Damage(
    "PNG, 2 % noise, 10 % strokes",
    lambda encoded, mask, rng: through_file(_daubed(encoded, mask, rng), "PNG"),
)
P3 = Damage(
    "PNG in Display P3",
    lambda encoded, mask, rng: through_file(encoded, "PNG", DISPLAY_P3),
)
ADOBE = Damage(
    "PNG in Adobe RGB",
    lambda encoded, mask, rng: through_file(encoded, "PNG", ADOBE_RGB),
)
JPEG = Damage(
    "JPEG 90",
    lambda encoded, mask, rng: through_file(encoded, "JPEG", quality=90),
)


@dataclass(frozen=True)
class Errors:
    """CIEDE2000 of one fit, shape (paints, angles); NaN where nothing is measured."""

    values: FloatArray

    @property
    def median(self) -> FloatArray:
        return np.nanmedian(self.values, axis=0)

    @property
    def p90(self) -> FloatArray:
        return np.nanpercentile(self.values, 90, axis=0)

    @property
    def largest(self) -> FloatArray:
        return np.nanmax(self.values, axis=0)

    @property
    def measured(self) -> float:
        return float(np.isfinite(self.values).mean())


def trial(setup: Setup, paints: list[Paint], damage: Damage) -> Mapping[str, Errors]:
    """Errors of the three fits over all paints, the paper's at the same angles."""
    rng = np.random.default_rng(2015)
    rows = [_errors(setup, paint, damage, rng) for paint in paints]
    return {name: Errors(np.array([row[name] for row in rows])) for name in FITS}


def _errors(
    setup: Setup, paint: Paint, damage: Damage, rng: np.random.Generator
) -> dict[str, FloatArray]:
    exposure = exposure_for(setup.geometry, paint.reflectance)
    encoded = picture(setup.geometry, paint.reflectance, exposure)
    painting = damage.treat(encoded, setup.geometry.mask, rng)
    try:
        found = fit_painting(painting, setup.geometry, setup.start, exposure=exposure)
    except InputError:
        return dict.fromkeys(FITS, np.full(len(ANGLES_DEG), np.nan))
    measured = [item.evidence.word == "measured" for item in found.angles]
    return {
        name: np.where(measured, ciede2000(paint.curve(ANGLES_DEG), lab), np.nan)
        for name, lab in _labs(found).items()
    }


def _labs(found: SketchFit) -> dict[str, FloatArray]:
    return {
        "local": np.array([item.lab for item in found.angles]),
        "paper Lab": found.paper_lab.lab(ANGLES_DEG),
        "paper RGB": found.paper_rgb.lab(ANGLES_DEG),
    }


def library_paints(number: int) -> list[Paint]:
    """Paints drawn from the bundled library, all colours inside sRGB."""
    table = bundled()
    columns = [table.angles_deg.index(angle) for angle in (15.0, 45.0, 110.0)]
    rows = np.random.default_rng(200).permutation(len(table))
    paints = (clamped_paint(table.codes[row], table.lab[row, columns]) for row in rows)
    inside = (paint for paint in paints if paint.in_gamut())
    return [next(inside) for _ in range(number)]


def pearl_paints(number: int) -> list[Paint]:
    """The same, pearls only."""
    table = bundled()
    columns = [table.angles_deg.index(angle) for angle in (15.0, 45.0, 110.0)]
    rows = [row for row, finish in enumerate(table.finishes) if finish == "pearl"]
    paints = (clamped_paint(table.codes[r], table.lab[r, columns]) for r in rows)
    inside = (paint for paint in paints if paint.in_gamut())
    return [next(inside) for _ in range(number)]


def real_paints() -> list[Paint]:
    """The measured curves inside sRGB; none where the data are absent."""
    return [paint for paint in _real_curves() if paint.in_gamut()]


def _real_curves() -> Iterator[Paint]:
    if not REAL_CURVES.exists():
        return
    rows: dict[str, list[list[float]]] = {}
    with REAL_CURVES.open(newline="") as file:
        for row in csv.DictReader(file):
            if float(row["aspecular"]) > 0.0:
                values = [float(row[key]) for key in ("aspecular", "L", "a", "b")]
                rows.setdefault(row["material"], []).append(values)
    for material, values in rows.items():
        angles, lab = np.array(values)[:, 0], np.array(values)[:, 1:]
        face = lab[0] - (lab[1] - lab[0]) / (angles[1] - angles[0]) * angles[0]
        angles, lab = np.append(0.0, angles), np.vstack([face, lab])
        yield Paint(material, fit(angles.tolist(), lab, "pchip"))
