from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.color import ciede2000
from paintlink.model import FloatArray
from paintlink.sketch.fit import fit_painting
from paintlink.sketch.result import SketchFit
from paintlink.sketch.selection import REASONS
from paintlink.sketch.values import Painting, PixelGeometry
from tests.sketch.synthesis import (
    Setup,
    clamped_paint,
    exposure_for,
    noisy,
    picture,
    quantised,
    sphere,
    with_strokes,
)

SETUP = Setup.of(sphere(200))
THETA = SETUP.geometry.theta_deg
SILVER = clamped_paint(
    "silver", np.array([(95.0, -3.0, -8.0), (52.0, -2.0, -12.0), (22.0, -1.0, -12.0)])
)
EXPOSURE = exposure_for(SETUP.geometry, SILVER.reflectance)
ENCODED = picture(SETUP.geometry, SILVER.reflectance, EXPOSURE)
ANGLES = (15.0, 25.0, 45.0, 75.0, 110.0)


def fitted(encoded: FloatArray, **options: object) -> SketchFit:
    painting = quantised(encoded, 8)
    return fit_painting(
        painting, SETUP.geometry, SETUP.start, exposure=EXPOSURE, **options
    )


def errors(found: SketchFit) -> FloatArray:
    angles = [item.evidence.aspecular_deg for item in found.angles]
    return ciede2000(SILVER.curve(angles), [item.lab for item in found.angles])


def words(found: SketchFit) -> list[str]:
    return [item.evidence.word for item in found.angles]


@pytest.mark.parametrize("angles", [ANGLES, (15.0, 45.0, 110.0)])
def test_painting_becomes_a_specification(angles):
    found = fitted(ENCODED, angles_deg=angles, name="my silver")

    spec = found.spec()

    assert spec.name == "my silver"
    assert spec.angles_deg == angles
    assert ciede2000(spec.lab(), SILVER.curve(angles)).max() < 0.15
    assert words(found) == ["measured"] * len(angles)


def test_strokes_are_set_aside_and_shown():
    rng = np.random.default_rng(1)
    noise = noisy(ENCODED, 0.02, rng)
    encoded = with_strokes(noise, SETUP.geometry.mask, 0.1, rng)

    found = fitted(encoded)

    strays = found.reasons == REASONS.index("stray")
    kept = found.reasons == REASONS.index("kept")
    struck = (encoded != noise).any(axis=-1)
    assert errors(found).max() < 1.0
    assert struck[strays].mean() > 0.9
    assert struck[kept].mean() < 0.02
    assert found.floor.consistent


def test_a_face_without_pixels_is_extrapolated():
    encoded = ENCODED.copy()
    encoded[THETA < 20.0] = 1.0

    found = fitted(encoded)

    assert words(found) == ["extrapolated", *["measured"] * 4]
    assert min(found.angles[0].uncertainty) >= 2.0
    assert errors(found)[0] < 2.0
    assert any(note.startswith("15 degrees is extrapolated") for note in found.notes)
    assert found.spec().angles_deg == ANGLES


def test_partial_repaint_uses_the_painted_half():
    unpainted = np.arange(200)[np.newaxis, :, np.newaxis] < 100

    found = fitted(np.where(unpainted, SETUP.start, ENCODED))

    assert found.counts["unchanged"] > 5000
    assert errors(found).max() < 0.3


def test_residual_covers_the_object_and_nothing_else():
    residual = fitted(ENCODED).residual

    assert np.array_equal(np.isfinite(residual), SETUP.geometry.mask)
    assert np.nanmean(residual) < 0.5
    with pytest.raises(ValueError, match="read-only"):
        residual[0, 0] = 0.0


def test_flat_gradient_is_warned_of():
    down = np.linspace(0.8, 0.1, 200)[:, np.newaxis, np.newaxis] * np.ones((
        200,
        200,
        3,
    ))
    encoded = np.where(SETUP.geometry.mask[..., np.newaxis], down, ENCODED)

    found = fitted(encoded)

    assert not found.floor.consistent
    assert found.notes[0].startswith("no paint looks like this: best possible is dE00")


def test_single_precision_pictures_are_accepted():
    geometry = SETUP.geometry
    single = PixelGeometry(
        THETA.astype(np.float32), geometry.phi.astype(np.float32), geometry.mask
    )
    painting = Painting(ENCODED.astype(np.float32))

    found = fit_painting(
        painting, single, SETUP.start.astype(np.float32), exposure=EXPOSURE
    )

    assert errors(found).max() < 0.05


def test_compressed_pictures_are_less_certain():
    plain = fitted(ENCODED)
    painting = replace(quantised(ENCODED, 8), lossy=True)
    lossy = fit_painting(painting, SETUP.geometry, SETUP.start, exposure=EXPOSURE)

    for one, other in zip(plain.angles, lossy.angles, strict=True):
        assert min(other.uncertainty) >= 0.15 > min(one.uncertainty)


def test_paper_fits_stand_beside_the_result():
    found = fitted(ENCODED)

    truth = SILVER.curve(ANGLES)
    assert ciede2000(truth, found.paper_lab.lab(ANGLES)).max() < 2.0
    assert ciede2000(truth, found.paper_rgb.lab(ANGLES)).max() > errors(found).max()
    assert ciede2000(truth, found.travel(ANGLES)).max() < 0.3
