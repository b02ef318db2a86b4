from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from paintlink.color import (
    TEXTILES,
    cie76,
    cie94,
    ciede2000,
    cmc,
    components,
    din99,
)

P, Q = (60, 30, -20), (61, 31, -20)
BRIGHT, DULLER = (130, 0, 0), (128, 0.5, -0.5)

lab = st.tuples(st.floats(0, 150), st.floats(-120, 120), st.floats(-120, 120))


@pytest.mark.parametrize(
    ("difference", "expected"),
    [
        pytest.param(cie76(P, Q), 1.4142, id="vector-11-cie76"),
        pytest.param(cie94(P, Q), 1.1083, id="vector-12-cie94"),
        pytest.param(cie94(Q, P), 1.1061, id="vector-12-swapped"),
        pytest.param(ciede2000(P, Q), 0.9863, id="vector-13-ciede2000"),
        pytest.param(cmc(P, Q), 0.6683, id="vector-14-cmc-2-1"),
        pytest.param(cmc(Q, P), 0.6612, id="vector-14-swapped"),
        pytest.param(cmc(P, Q, 1.5, 1.0), 0.7635, id="vector-14-cmc-1.5-1"),
        pytest.param(cmc(P, Q, 1.0, 1.0), 0.9862, id="vector-14-cmc-1-1"),
        pytest.param(din99(P, Q), 0.9704, id="vector-15-din99"),
        pytest.param(cie76(BRIGHT, DULLER), 2.1213, id="vector-16-cie76"),
        pytest.param(ciede2000(BRIGHT, DULLER), 1.2727, id="vector-16-ciede2000"),
        pytest.param(cmc(BRIGHT, DULLER), 1.2692, id="vector-16-cmc"),
        pytest.param(cie94(BRIGHT, DULLER), 2.1213, id="vector-16-cie94"),
    ],
)
def test_formula_gives_published_value(difference, expected):
    assert difference == pytest.approx(expected, abs=5.1e-5)


def pairs() -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(4)
    standard = rng.uniform([0, -120, -120], [150, 120, 120], (3000, 3))
    near = np.clip(standard + rng.normal(0, 5, standard.shape), [0, -150, -150], None)
    return np.r_[standard, standard[::-1]], np.r_[near, standard]


@pytest.mark.parametrize(
    ("ours", "theirs", "options"),
    [
        (cie76, "delta_E_CIE1976", {}),
        (cie94, "delta_E_CIE1994", {"textiles": False}),
        (lambda p, q: cie94(p, q, TEXTILES), "delta_E_CIE1994", {"textiles": True}),
        (ciede2000, "delta_E_CIE2000", {}),
        (cmc, "delta_E_CMC", {}),
        (lambda p, q: cmc(p, q, 1.5, 1.0), "delta_E_CMC", {"l": 1.5, "c": 1.0}),
        (din99, "delta_E_DIN99", {}),
    ],
)
def test_formula_agrees_with_colour_science(ours, theirs, options):
    colour = pytest.importorskip("colour")
    standard, sample = pairs()

    expected = getattr(colour.difference, theirs)(standard, sample, **options)

    assert ours(standard, sample) == pytest.approx(expected, abs=1e-10)


@given(lab, lab)
def test_cie76_is_reproducible_to_the_bit(p, q):
    x, y, z = (after - before for before, after in zip(p, q, strict=True))

    expected = math.sqrt((x * x + y * y) + z * z)

    assert float(cie76(p, q)) == expected
    assert cie76(np.array([p] * 9), np.array([q] * 9)).tolist() == [expected] * 9


@given(lab, lab)
def test_components_restore_the_difference(p, q):
    parts = components(p, q)

    in_plane = parts.da**2 + parts.db**2
    assert parts.dC**2 + parts.dH**2 == pytest.approx(in_plane, rel=1e-6, abs=1e-9)
    assert parts.dL == q[0] - p[0]


@pytest.mark.parametrize(
    ("sample", "chroma_change", "hue_change"),
    [
        ((50, 0, 20), 0.0, math.sqrt(800)),  # a quarter turn towards yellow
        ((50, 0, -20), 0.0, -math.sqrt(800)),
        ((50, 30, 0), 10.0, 0.0),
        ((50, -20, 0), 0.0, 40.0),
    ],
)
def test_hue_difference_carries_its_direction(sample, chroma_change, hue_change):
    parts = components((50, 20, 0), sample)

    assert parts.dC == pytest.approx(chroma_change, abs=1e-12)
    assert parts.dH == pytest.approx(hue_change, abs=1e-12)


@pytest.mark.parametrize("formula", [cie76, cie94, ciede2000, cmc, din99])
@given(p=lab)
def test_equal_colours_differ_by_zero(formula, p):
    assert formula(p, p) == 0.0


def test_neutral_colour_has_its_own_din99():
    colour = pytest.importorskip("colour")

    expected = colour.difference.delta_E_DIN99((50, 0, 0), (60, 0, 1))

    assert din99((50, 0, 0), (60, 0, 1)) == pytest.approx(expected)


def test_one_standard_broadcasts_over_samples():
    samples = np.arange(60.0).reshape(4, 5, 3)

    assert ciede2000((50, 10, 10), samples).shape == (4, 5)
