"""Pictures of known paints on a sphere, so that a fit has a truth to be held against.

Its own geometry, written from the formulas: what is checked here is the fit alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image, ImageDraw

from paintlink.color import Curve, drawing_curve, lab_to_linear_srgb
from paintlink.color.display import encode_srgb
from paintlink.model import ColorSpec, FloatArray
from paintlink.sketch.pictures import read_picture
from paintlink.sketch.profiles import read_profile
from paintlink.sketch.values import Painting, PixelGeometry

HEADROOM = 0.92
BACKGROUND = 0.18
REFLECTANCE = Callable[[FloatArray], FloatArray]
"""Linear sRGB of aspecular degrees, shape (..., 3)."""


def sphere(size: int, polar_deg: float = 25.0, azimuth_deg: float = 135.0):
    """Geometry of a sphere under parallel light, seen from far away."""
    polar, azimuth = np.radians([polar_deg, azimuth_deg])
    light = np.array([
        np.sin(polar) * np.cos(azimuth),
        np.sin(polar) * np.sin(azimuth),
        np.cos(polar),
    ])
    across = 2.1 * (np.arange(size) + 0.5) / size - 1.05
    x, y = across[np.newaxis, :], -across[:, np.newaxis]
    z = np.sqrt(np.maximum(1.0 - x * x - y * y, 0.0))
    normal = np.stack([x + 0.0 * y, y + 0.0 * x, z], axis=-1)
    mirrored = 2.0 * normal[..., 2:] * normal - [0.0, 0.0, 1.0]
    half_chord = 0.5 * np.linalg.norm(mirrored - light, axis=-1)
    phi = normal @ light
    mask = (z > 0.0) & (phi > 0.0)
    theta = np.degrees(2.0 * np.arcsin(np.minimum(half_chord, 1.0)))
    return PixelGeometry(theta, np.where(mask, phi, 0.0), mask)


@dataclass(frozen=True)
class Setup:
    """A geometry and the grey start picture that stands on it."""

    geometry: PixelGeometry
    start: FloatArray

    @classmethod
    def of(cls, geometry: PixelGeometry) -> Setup:
        grey = np.full((*geometry.mask.shape, 3), BACKGROUND)
        grey[geometry.mask] = 0.07 * geometry.phi[geometry.mask, np.newaxis]
        return cls(geometry, encode_srgb(grey))


@dataclass(frozen=True)
class Paint:
    """A known paint: what it reflects, and its Lab."""

    name: str
    curve: Curve
    held_from_deg: float = 110.0

    def reflectance(self, theta_deg: FloatArray) -> FloatArray:
        return lab_to_linear_srgb(self.curve(np.minimum(theta_deg, self.held_from_deg)))

    def in_gamut(self) -> bool:
        linear = self.reflectance(np.arange(12.0, 111.0))
        return bool(linear.min() >= 0.0)


def clamped_paint(name: str, lab: FloatArray) -> Paint:
    """Paint from Lab at 15, 45 and 110 degrees along the clamped quadratic."""
    return Paint(name, drawing_curve((15.0, 45.0, 110.0), lab))


def spec_paint(spec: ColorSpec) -> Paint:
    return clamped_paint(spec.name, spec.lab(15.0, 45.0, 110.0))


def exposure_for(geometry: PixelGeometry, reflectance: REFLECTANCE) -> float:
    """Exposure that keeps the brightest fit pixel at 0.92."""
    seen = geometry.mask & (geometry.theta_deg >= 12.0)
    linear = geometry.phi[seen, np.newaxis] * reflectance(geometry.theta_deg[seen])
    return min(1.0, HEADROOM / float(linear.max()))


def picture(
    geometry: PixelGeometry, reflectance: REFLECTANCE, exposure: float
) -> FloatArray:
    """Encoded picture exposure · φ · f(θ) before a grey background, as floats."""
    linear = np.full((*geometry.mask.shape, 3), BACKGROUND)
    light = exposure * geometry.phi[geometry.mask, np.newaxis]
    linear[geometry.mask] = light * reflectance(geometry.theta_deg[geometry.mask])
    return encode_srgb(np.clip(linear, 0.0, 1.0))


def noisy(encoded: FloatArray, sigma: float, rng: np.random.Generator) -> FloatArray:
    return np.clip(encoded + rng.normal(0.0, sigma, encoded.shape), 0.0, 1.0)


def with_strokes(
    encoded: FloatArray, mask: np.ndarray, share: float, rng: np.random.Generator
) -> FloatArray:
    """The picture under thick lines of flat colour over a share of the object."""
    size = encoded.shape[0]
    layer = Image.new("RGBA", encoded.shape[1::-1])
    pencil = ImageDraw.Draw(layer)
    covered = np.zeros(mask.shape, dtype=bool)
    while np.count_nonzero(covered & mask) < share * np.count_nonzero(mask):
        points = [tuple(point) for point in rng.uniform(0, size, (3, 2)).tolist()]
        colour = (*rng.integers(0, 256, 3).tolist(), 255)
        pencil.line(points, fill=colour, width=max(2, size // 60))
        covered = np.asarray(layer)[..., 3] > 0
    strokes = np.asarray(layer)[..., :3] / 255.0
    return np.where(covered[..., np.newaxis], strokes, encoded)


def quantised(encoded: FloatArray, bits: int) -> Painting:
    """The painting as a file of this depth would hold it."""
    top = 2.0**bits - 1.0
    return Painting(np.rint(encoded * top) / top, bits=bits)


def through_file(
    encoded: FloatArray, kind: str, profile: bytes | None = None, **options: object
) -> Painting:
    """The painting after a real file of 8 bits a channel, ``PNG`` or ``JPEG``."""
    values = encoded if profile is None else read_profile(profile).from_srgb(encoded)
    image = Image.fromarray(np.rint(255.0 * values).astype(np.uint8))
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"painting.{kind.lower()}"
        image.save(path, kind, icc_profile=profile, **options)
        return read_picture(path)
