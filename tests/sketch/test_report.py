from __future__ import annotations

import numpy as np
import pytest

from paintlink.sketch.fit import fit_painting
from paintlink.sketch.report import (
    PAPER,
    Panel,
    coloured,
    rendered,
    report_picture,
    residual_panel,
    side_by_side,
)
from tests.sketch.synthesis import Setup, clamped_paint, picture, quantised, sphere

SETUP = Setup.of(sphere(160))
PAINT = clamped_paint("red", np.array([(60.0, 40, 20), (38.0, 30, 16), (20.0, 18, 9)]))
PAINTING = quantised(picture(SETUP.geometry, PAINT.reflectance, 0.8), 8)
FIT = fit_painting(PAINTING, SETUP.geometry, SETUP.start, exposure=0.8)


def test_render_of_a_true_fit_looks_like_the_sketch():
    render = rendered(FIT, PAINTING, SETUP.geometry, 0.8)

    assert np.abs(render - PAINTING.encoded).max() < 0.02
    assert not np.array_equal(render, PAINTING.encoded)


def test_report_shows_three_pictures_above_words():
    sheet = report_picture(FIT, PAINTING, SETUP.geometry, 0.8)

    assert sheet.shape == (360 + 2 * 10 + 22 * (1 + len(FIT.notes)), 3 * 370 + 10, 3)
    words = sheet[-60:].reshape(-1, 3)
    assert (words.min(axis=1) < 100).sum() > 200


def test_residual_is_coloured_by_its_scale():
    low, high, beyond, none = coloured(np.array([0.0, 10.0, 50.0, np.nan]))

    assert not np.array_equal(low, high)
    assert np.array_equal(high, beyond)
    assert none == pytest.approx(np.array(PAPER) / 255.0)


def test_scale_runs_along_the_bottom_of_the_residual():
    bottom = residual_panel(FIT).encoded[-1]

    assert bottom == pytest.approx(coloured(np.linspace(0.0, 10.0, len(bottom))))


def test_panels_are_equally_high():
    wide, small = np.full((100, 200, 3), 0.5), np.zeros((50, 50, 3))

    sheet = side_by_side([Panel(wide, "wide"), Panel(small, "small")])

    assert sheet.shape[1] == 720 + 360 + 3 * 10
    assert (sheet[20, 15] == 128).all()
    assert (sheet[360, 750] == 0).all()
