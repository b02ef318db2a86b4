from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from paintlink.color import reflectance_to_lab, weights, white
from paintlink.color.spectra import _tables
from paintlink.errors import ReadingError

TEN = np.arange(400.0, 701.0, 10.0)
TWENTY = np.arange(400.0, 701.0, 20.0)
RAMP = 0.1 + 0.02 * np.arange(31)
CONDITIONS = [("D65", "10"), ("D65", "2"), ("A", "10"), ("F11", "10"), ("D50", "10")]
ORACLE_ILLUMINANTS = {"D65": "D65", "A": "A", "F11": "FL11", "D50": "D50"}
ORACLE_OBSERVERS = {
    "2": "CIE 1931 2 Degree Standard Observer",
    "10": "CIE 1964 10 Degree Standard Observer",
}


def oracle_xyz(colour, factors, illuminant, observer):
    cmfs = colour.MSDS_CMFS[ORACLE_OBSERVERS[observer]]
    source = colour.SDS_ILLUMINANTS[ORACLE_ILLUMINANTS[illuminant]]
    with colour.utilities.suppress_warnings(colour_runtime_warnings=True):
        return np.array([
            colour.sd_to_XYZ(colour.SpectralDistribution(row, TEN), cmfs, source)
            for row in factors
        ])


@pytest.mark.parametrize(
    ("factors", "lab"),
    [
        pytest.param(np.ones(31), (100.0, 0.0, 0.0), id="vector-1-white"),
        pytest.param(np.full(31, 0.5), (76.06926, 0.0, 0.0), id="vector-3-grey"),
        pytest.param(RAMP, (69.6268, 7.3542, 29.7246), id="vector-4-ramp"),
    ],
)
def test_known_spectra_give_published_lab(factors, lab):
    assert reflectance_to_lab(TEN, factors) == pytest.approx(lab, abs=5e-5)


def test_ramp_gives_known_xyz():  # vector 4
    xyz = RAMP @ weights("D65", "10", 10)

    assert xyz == pytest.approx((40.45937, 40.22121, 21.98653), abs=5e-6)


def test_end_band_carries_folded_weights():  # vector 5
    first = weights("D65", "10", 10)[0]

    assert first == pytest.approx((0.143925, 0.015130, 0.643103), abs=5e-7)


@pytest.mark.parametrize(
    ("illuminant", "observer", "x", "z"),
    [
        pytest.param("D65", "10", 94.81091, 107.30476, id="vector-1"),
        pytest.param("D65", "2", 95.04686, 108.88297, id="vector-2-D65-2"),
        pytest.param("A", "10", 111.14225, 35.20616, id="vector-2-A"),
        pytest.param("D50", "10", 96.72101, 81.41509, id="vector-2-D50"),
        pytest.param("F11", "10", 103.82093, 65.55752, id="vector-2-F11"),
    ],
)
@pytest.mark.parametrize("step_nm", [10, 20])
def test_column_sums_are_the_white(illuminant, observer, x, z, step_nm):
    sums = weights(illuminant, observer, step_nm).sum(axis=0)

    assert sums == pytest.approx((x, 100.0, z), abs=1e-5)
    assert sums == pytest.approx(white(illuminant, observer), abs=1e-9)


def test_quick_weights_match_printed_table(held_out):
    name = "weights_D65_10deg_E308_10nm_400_700.csv"
    printed = [list(map(float, row.values())) for row in held_out(name)]

    assert weights("D65", "10", 10) == pytest.approx(np.array(printed), abs=5.1e-7)


def test_shipped_weights_equal_fresh_generation():
    pytest.importorskip("colour")
    path = Path(__file__).parents[2] / "tools" / "make_weights.py"
    module = importlib.util.module_from_spec(
        spec := importlib.util.spec_from_file_location("make_weights", path)
    )
    spec.loader.exec_module(module)

    fresh = {
        (illuminant, observer, float(step)): module.table(illuminant, observer, step)
        for illuminant, observer in module.CONDITIONS
        for step in module.STEPS_NM
    }

    assert fresh.keys() == _tables().keys()
    for key, table in fresh.items():
        assert _tables()[key].weights == pytest.approx(table, abs=1e-12), key


@pytest.mark.parametrize(("illuminant", "observer"), CONDITIONS)
def test_lab_agrees_with_colour_science(illuminant, observer):  # vector 9
    colour = pytest.importorskip("colour")
    factors = np.random.default_rng(9).uniform(0.0, 1.5, (8, 31))

    xyz = oracle_xyz(colour, factors, illuminant, observer)
    xy = colour.XYZ_to_xy(white(illuminant, observer))
    expected = colour.XYZ_to_Lab(xyz / 100.0, xy)

    ours = factors @ weights(illuminant, observer, 10)
    assert ours == pytest.approx(xyz, abs=1e-12)
    lab = reflectance_to_lab(TEN, factors, illuminant, observer)
    assert lab == pytest.approx(expected, abs=1e-11)


def test_coarse_spectra_come_close_to_fine():
    smooth = 0.4 + 0.3 * np.sin(TEN / 60.0)

    fine = reflectance_to_lab(TEN, smooth)
    coarse = reflectance_to_lab(TWENTY, smooth[::2])

    assert coarse == pytest.approx(fine, abs=0.15)
    assert not np.array_equal(coarse, fine)


@given(arrays(np.float64, (4, 31), elements=st.floats(0.0, 20.0)))
def test_rows_convert_as_single_spectra(factors):
    together = reflectance_to_lab(TEN, factors)
    alone = [reflectance_to_lab(TEN, row) for row in factors]

    assert together == pytest.approx(np.array(alone), abs=1e-9)
    assert together.shape == (4, 3)


def test_bright_flakes_exceed_white_unclipped():
    assert reflectance_to_lab(TEN, np.full(31, 2.0))[0] > 130.0


def test_no_spectra_give_no_lab():
    assert reflectance_to_lab(TEN, np.empty((0, 31))).shape == (0, 3)


@pytest.mark.parametrize(
    ("scale", "message"),
    [
        (np.arange(400.0, 701.0, 5.0), "400 to 700 nm in steps of 5 nm, 61 values"),
        (np.arange(360.0, 781.0, 10.0), "360 to 780 nm in steps of 10 nm, 43 values"),
        (np.arange(380.0, 731.0, 10.0), "380 to 730 nm in steps of 10 nm, 36 values"),
        (np.arange(420.0, 681.0, 10.0), "420 to 680 nm"),
        (TEN + 5.0, "405 to 705 nm"),
        (TEN[:-1], "400 to 690 nm in steps of 10 nm, 30 values"),
        (TEN[::-1], "700 to 400 nm in steps of -10 nm"),
        (np.r_[TEN[:-1], 701.0], "uneven steps"),
        (TEN * np.nan, "no wavelength scale"),
        (np.array(500.0), "no wavelength scale"),
    ],
)
def test_other_wavelength_scales_are_refused(scale, message):
    factors = np.full((6, scale.size), 0.5)

    with pytest.raises(ReadingError, match=message) as refusal:
        reflectance_to_lab(scale, factors)

    assert "steps of 10 nm (31 values) or 20 nm (16 values)" in str(refusal.value)
    assert "cut a longer range" in str(refusal.value)


def test_missing_band_is_refused():
    with pytest.raises(ReadingError, match="30 reflectance factors do not fit the 31"):
        reflectance_to_lab(TEN, np.full((6, 30), 0.5))


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (np.nan, "nan at 550 nm, spectrum 2, must lie between -0.02 and 20"),
        (np.inf, "inf at 550 nm, spectrum 2, must lie"),
        (-np.inf, "-inf at 550 nm"),
        (-0.021, "-0.021 at 550 nm, spectrum 2, must lie.*calibrate and measure"),
        (20.5, "20.5 at 550 nm, spectrum 2, looks like percent: divide by 100"),
    ],
)
def test_impossible_factors_are_refused_by_place(value, message):
    factors = np.full((3, 31), 0.5)
    factors[1, 15] = value

    with pytest.raises(ReadingError, match=message):
        reflectance_to_lab(TEN, factors)


def test_unknown_conditions_name_the_known():
    with pytest.raises(ReadingError, match=r"no weights for A/2.*D65/10, D65/2"):
        reflectance_to_lab(TEN, RAMP, "A", "2")


def test_weights_cannot_be_overwritten():
    with pytest.raises(ValueError, match="read-only"):
        weights("D65", "10", 10)[0, 0] = 1.0
