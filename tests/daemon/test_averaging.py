from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.daemon.averaging import average, outlier, without_farthest
from paintlink.errors import ReadingError
from paintlink.model import Geometry, LabValues, Measurement, Spectra


def flat(level: float, raw: bytes = b"") -> Measurement:
    factors = np.full((1, 31), level)
    return Measurement(
        (Geometry(45.0),),
        Spectra(np.arange(400.0, 701.0, 10.0), factors),
        LabValues([[level, 0.0, 0.0]], "D65", "10"),
        raw=raw,
    )


def test_mean_of_spectra_and_lab_is_taken() -> None:
    mean = average([flat(0.2, b"a"), flat(0.4, b"b"), flat(0.6, b"c")])

    assert mean.spectra is not None
    assert mean.lab is not None
    np.testing.assert_allclose(mean.spectra.factors, 0.4)
    np.testing.assert_allclose(mean.lab.lab, [[0.4, 0.0, 0.0]])
    assert (mean.averaged, mean.raw) == (3, b"abc")


def test_single_measurement_stays_as_it_is() -> None:
    one = flat(0.3)

    assert average([one]) is one


def test_other_geometries_are_never_averaged() -> None:
    other = replace(flat(0.2), geometries=(Geometry(15.0),))

    with pytest.raises(ReadingError, match="different geometries: take it again"):
        average([flat(0.2), other])


def at(angle_deg: float, lightness: float) -> Measurement:
    return Measurement(
        (Geometry(angle_deg),), lab=LabValues([[lightness, 0.0, 0.0]], "D65", "10")
    )


def test_spread_is_the_largest_difference_to_the_mean() -> None:
    mean = average([at(45.0, 50.0), at(45.0, 50.6), at(45.0, 51.0)])

    assert mean.spread == pytest.approx((0.533,), abs=1e-3)
    assert average([at(45.0, 50.0)]).spread == ()


def test_spread_of_spectra_is_taken_in_lab() -> None:
    spectra = Spectra(np.arange(400.0, 701.0, 10.0), np.full((1, 31), 0.2))
    darker = replace(spectra, factors=np.full((1, 31), 0.18))
    pair = [Measurement((Geometry(45.0),), one) for one in (spectra, darker)]

    assert average(pair).spread == pytest.approx((1.17,), abs=0.01)


@pytest.mark.parametrize(
    ("angle_deg", "difference", "agrees"),
    [(45.0, 1.9, True), (45.0, 2.1, False), (15.0, 3.9, True), (15.0, 4.2, False)],
)
def test_readings_that_differ_ask_for_one_more(
    angle_deg: float, difference: float, agrees: bool
) -> None:
    why = outlier([at(angle_deg, 50.0), at(angle_deg, 50.0 + difference)])

    assert (why == "") is agrees
    assert agrees or f"differ by dE {difference / 2:.1f} at {angle_deg:g}" in why


def test_single_reading_has_no_outlier() -> None:
    assert outlier([at(45.0, 50.0)]) == ""


def test_farthest_from_the_median_is_left_out() -> None:
    kept = without_farthest([at(45.0, 50.0), at(45.0, 58.0), at(45.0, 50.4)])

    assert [one.lab.lab[0, 0] for one in kept if one.lab] == [50.0, 50.4]
