from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.daemon.averaging import average
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
