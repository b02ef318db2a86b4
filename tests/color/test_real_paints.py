"""Measured materials, read in place: never part of the project or the package."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import pytest

from paintlink.color import (
    chroma_index,
    cie76,
    fit,
    flop_index,
    hue_shift_index,
    reflectance_to_lab,
)

TEN = np.arange(400.0, 701.0, 10.0)
THREE = (15.0, 45.0, 110.0)
FIVE = (15.0, 25.0, 45.0, 75.0, 110.0)
EFFECTS = ("metallic", "pearl", "color-changing", "silver", "gold", "aventurnine")


def test_instrument_lab_is_reproduced(held_out):  # vector 8
    rows = held_out("mat12_sample.csv")
    lab = np.array([[float(row[axis]) for axis in "Lab"] for row in rows])
    factors = np.array([[float(row[f"{band:g}"]) for band in TEN] for row in rows])

    errors = cie76(lab, reflectance_to_lab(TEN, factors))

    assert len(errors) == 1380
    assert errors.max() <= 0.0005


def test_real_paints_have_published_indices(held_out):
    for row in held_out("real_paints_5angle.csv"):
        lab = [[float(row[f"{axis}{angle:g}"]) for axis in "Lab"] for angle in THREE]
        for name, index in (
            ("FI", flop_index),
            ("CI", chroma_index),
            ("HSI", hue_shift_index),
        ):
            value = index(lab)
            if row[name] and value is not None:
                assert value == pytest.approx(float(row[name]), abs=0.02), row


@pytest.fixture
def curves(held_out) -> tuple[list[float], np.ndarray]:
    """Aspecular angles and Lab of the effect materials, shape (n, angles, 3)."""
    table = defaultdict(dict)
    for row in held_out("real_paints_curves.csv"):
        if any(word in row["material"] for word in EFFECTS):
            lab = [float(row[axis]) for axis in "Lab"]
            table[row["material"]][float(row["aspecular"])] = lab
    angles = sorted(next(iter(table.values())))
    return angles, np.array([[m[angle] for angle in angles] for m in table.values()])


@pytest.mark.parametrize(
    ("model", "measured", "median", "p90"),
    [
        ("clamped", THREE, 3.2, 7.0),
        ("clamped", FIVE, 2.2, 5.2),
        ("pchip", THREE, 2.3, 5.4),
        ("pchip", FIVE, 0.8, 2.4),
    ],
)
def test_held_out_angles_are_met(curves, model, measured, median, p90):
    angles, lab = curves
    asked = [angle for angle in angles if angle > 0 and angle not in measured]
    known = lab[:, [angles.index(angle) for angle in measured]]
    truth = lab[:, [angles.index(angle) for angle in asked]]

    errors = cie76(truth, fit(measured, known, model)(asked))

    assert len(lab) == 19
    assert np.median(errors) <= median
    assert np.percentile(errors, 90) <= p90


def test_clamped_beats_the_paper_at_flop(curves):
    angles, lab = curves
    known = lab[:, [angles.index(angle) for angle in THREE]]

    flop = [fit(THREE, known, model)(110.0) for model in ("paper_literal", "clamped")]

    errors = [np.median(cie76(known[:, -1], values)) for values in flop]
    assert errors[0] > 10.0
    assert errors[1] < 1e-9
