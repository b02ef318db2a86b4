from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import lab_to_linear_srgb
from paintlink.color.display import encode_srgb
from paintlink.sketch.transfer import (
    decode_srgb,
    linear_srgb_to_lab,
    reflected_lab,
    shown,
)

LAB = np.array([(95.0, -3.0, -8.0), (45.0, 30.0, 10.0), (3.0, 0.5, -0.5)])


def test_decoding_undoes_the_encoding_exactly():
    linear = np.linspace(0.0, 1.0, 10_001)

    assert decode_srgb(encode_srgb(linear)) == pytest.approx(linear, abs=1e-15)


def test_lab_survives_the_way_through_linear_srgb():
    assert linear_srgb_to_lab(lab_to_linear_srgb(LAB)) == pytest.approx(LAB, abs=1e-11)


def test_shown_paint_reads_back_at_any_light():
    phi = np.array([1.0, 0.5, 0.13])

    encoded = shown(LAB, phi, exposure=0.45)

    assert reflected_lab(encoded, phi, 0.45) == pytest.approx(LAB, abs=1e-10)


def test_shown_pixels_clip_at_the_display():
    assert shown(np.array([130.0, 0.0, 0.0]), np.array(1.0), 1.0) == pytest.approx(1.0)
