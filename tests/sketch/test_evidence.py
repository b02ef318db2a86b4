from __future__ import annotations

import numpy as np
import pytest

from paintlink.sketch.cells import Cells
from paintlink.sketch.evidence import evidence

ANGLES = (15.0, 25.0, 45.0, 75.0, 110.0)
ALL = np.linspace(12.0, 150.0, 40_000)


def words(used: np.ndarray, painted: np.ndarray = ALL) -> list[str]:
    return [item.word for item in found(used, painted)]


def found(used: np.ndarray, painted: np.ndarray = ALL):
    theta = np.unique(np.floor(used)) + 0.5
    cells = Cells(
        theta, np.ones(theta.size), np.zeros((theta.size, 3)), theta.astype(int)
    )
    return evidence(ANGLES, cells, used, painted)


def test_full_coverage_is_measured_everywhere():
    assert words(ALL) == ["measured"] * 5
    assert {item.reason for item in found(ALL)} == {""}


@pytest.mark.parametrize(
    ("low", "high", "missing"),
    [(12, 105, 110.0), (12, 80, 110.0), (20, 180, 15.0)],
)
def test_one_missing_end_is_extrapolated(low, high, missing):
    used = np.linspace(low, high, 30_000)

    result = dict(zip(ANGLES, words(used, used), strict=True))

    assert result.pop(missing) == "extrapolated"
    assert set(result.values()) == {"measured"}


def test_two_missing_angles_are_refused():
    used = ALL[ALL <= 60.0]

    assert words(used, used) == [*["measured"] * 3, "refused", "refused"]


def test_clipped_face_is_not_a_measurement():
    used = ALL[(ALL >= 24.0) | (np.arange(ALL.size) % 4 == 0)]

    face = found(used)[0]

    assert face.word == "extrapolated"
    assert face.reason == "75 % near 15 degrees is clipped or stray strokes"
    assert face.share == pytest.approx(0.25, abs=0.01)


def test_few_pixels_are_no_evidence():
    used = ALL[(ALL < 80.0) | (np.arange(ALL.size) % 100 == 0)]

    assert (
        found(used, used)[4].reason
        == "only 127 of 127 painted pixels near 110 can be used"
    )


def test_unpainted_regions_are_named():
    used = ALL[ALL < 80.0]

    assert found(used, used)[4].reason == "nothing is painted near 110 degrees"
