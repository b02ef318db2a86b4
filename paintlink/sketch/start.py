"""The start picture: one paint in one light, on grey, without gloss or surroundings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from paintlink.color import drawing_curve, into_gamut, lab_to_linear_srgb
from paintlink.color.display import encode_srgb
from paintlink.model import ColorSpec, FloatArray
from paintlink.sketch.geometry import bands, coverage
from paintlink.sketch.png import Codes, to_codes
from paintlink.sketch.recipe import Recipe
from paintlink.sketch.selection import LEAST_THETA_DEG
from paintlink.sketch.strip import paint_strip
from paintlink.sketch.values import PixelGeometry

BACKGROUND = 0.18
GREY = float(encode_srgb(BACKGROUND))
BRIGHTEST = 0.85
"""Linear value of the brightest pixel a fit uses: less than what it drops as gloss."""

STEPS_A_DEGREE = 64
TABLE_DEG = np.arange(180 * STEPS_A_DEGREE + 1) / STEPS_A_DEGREE

GAMUT_TOLERANCE = 1e-6


def exposure_for(paint: ColorSpec, geometry: PixelGeometry) -> float:
    """Exposure under which no pixel a fit uses exceeds ``BRIGHTEST``, nor does white.

    The highlight below 12 degrees, which a fit leaves out as gloss, may be clipped.
    """
    used = geometry.mask & (geometry.theta_deg >= LEAST_THETA_DEG)
    theta, phi = geometry.theta_deg[used], geometry.phi[used]
    peak = np.interp(theta, TABLE_DEG, factors(paint).max(axis=1)) * phi
    return BRIGHTEST / max(1.0, float(peak.max(initial=0.0)))


def beyond_srgb(paint: ColorSpec, angles_deg: Sequence[float]) -> tuple[float, ...]:
    """Angles at which the paint is more chromatic than sRGB can show."""
    lowest = _linear(paint, np.asarray(angles_deg, dtype=np.float64)).min(axis=-1)
    pairs = zip(angles_deg, lowest, strict=True)
    return tuple(angle for angle, low in pairs if low < -GAMUT_TOLERANCE)


def start_codes(
    recipe: Recipe,
    geometry: PixelGeometry,
    shift_px: tuple[float, float] = (0.0, 0.0),
) -> Codes:
    """Samples of the start picture of a recipe, encoded sRGB.

    Linear value of a pixel: exposure · phi · factor(theta). There is no tone curve,
    because the fit has to undo it.

    Parameters
    ----------
    geometry
        Of the pose of the recipe, moved by ``shift_px``.
    """
    factor = factors(recipe.start) * recipe.exposure
    cover = coverage(recipe.pose, shift_px)
    picture = np.full((*cover.shape, 3), GREY, dtype=np.float32)
    for rows in bands(len(picture)):
        seen = cover[rows] > 0.0
        lit = np.maximum(geometry.phi[rows][seen], 0.0).astype(np.float64)
        colour = _looked_up(factor, geometry.theta_deg[rows][seen]) * lit[:, np.newaxis]
        share = cover[rows][seen][:, np.newaxis]
        mixed = BACKGROUND + share * (colour - BACKGROUND)
        picture[rows][seen] = encode_srgb(np.clip(mixed, 0.0, 1.0))
    paint_strip(picture)
    return to_codes(picture, recipe.bits)


def factors(paint: ColorSpec) -> FloatArray:
    """Reflectance factors in linear sRGB at ``TABLE_DEG``, shape (n, 3), none below 0.

    1.0 is the perfect diffuser. Colours sRGB cannot show lose chroma; bright ones are
    kept, for which they are brought below the shoulder of the gamut mapping and back.
    """
    linear = _linear(paint, TABLE_DEG)
    scale = 0.5 / max(1.0, float(linear.max()))
    factor: FloatArray = into_gamut(linear * scale) / scale
    return factor


def _linear(paint: ColorSpec, angles_deg: FloatArray) -> FloatArray:
    curve = drawing_curve(paint.angles_deg, paint.lab())
    return lab_to_linear_srgb(curve(angles_deg), paint.observer)


def _looked_up(factor: FloatArray, theta_deg: object) -> FloatArray:
    theta = np.asarray(theta_deg, dtype=np.float64)
    channels = [np.interp(theta, TABLE_DEG, channel) for channel in factor.T]
    return np.stack(channels, axis=-1)
