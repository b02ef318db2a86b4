from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from paintlink.color import reflectance_to_lab
from paintlink.errors import ReadingError
from paintlink_simulators import Panel, panel_from_lab
from paintlink_simulators.paint import WAVELENGTHS_NM

REAL_PAINTS = Path(__file__).parents[4] / "shared/data/real_paints_5angle.csv"
ANGLES = (15, 25, 45, 75, 110)

SPECTRA = arrays(float, 31, elements=st.floats(np.log(0.02), np.log(3))).map(np.exp)


def roughness(factors: np.ndarray) -> float:
    return float((np.diff(np.log(factors)) ** 2).sum())


@pytest.mark.parametrize(
    "lab",
    [
        (100, 0, 0),
        (150, -0.5, -1.2),
        (130.5, -15.4, -10.8),
        (1, 0, 0),
        (1, 0.5, -0.5),
        (3, 10, 4),
        (80, 0, 95),
        (45, 70, 50),
        (81, 21.2, -84),
        (60, -80, 40),
    ],
)
def test_panel_has_exactly_the_given_lab(lab: tuple[float, float, float]) -> None:
    panel = panel_from_lab([45], [lab])

    assert reflectance_to_lab(panel.wavelengths_nm, panel.factors)[0] == pytest.approx(
        lab, abs=1e-6
    )


@given(spectrum=SPECTRA)
def test_color_of_any_spectrum_can_be_rebuilt(spectrum: np.ndarray) -> None:
    lab = reflectance_to_lab(WAVELENGTHS_NM, spectrum)

    rebuilt = panel_from_lab([45], [lab]).factors[0]

    assert reflectance_to_lab(WAVELENGTHS_NM, rebuilt) == pytest.approx(lab, abs=1e-6)
    assert roughness(rebuilt) <= roughness(spectrum) + 1e-9


def test_grey_is_rebuilt_as_a_flat_spectrum() -> None:
    lab = reflectance_to_lab(WAVELENGTHS_NM, np.full(31, 0.18))

    assert panel_from_lab([45], [lab]).factors == pytest.approx(0.18, rel=1e-9)


def test_measured_paints_can_all_be_rebuilt() -> None:
    if not REAL_PAINTS.exists():
        pytest.skip("../shared/data is absent")
    with REAL_PAINTS.open() as file:
        paints = list(csv.DictReader(file))

    for paint in paints:
        lab = [[float(paint[f"{axis}{angle}"]) for axis in "Lab"] for angle in ANGLES]
        panel = panel_from_lab(ANGLES, lab, paint["material"])

        rebuilt = reflectance_to_lab(panel.wavelengths_nm, panel.factors)
        assert rebuilt == pytest.approx(np.array(lab), abs=1e-6)


@pytest.mark.parametrize("lab", [(1, 0, 40), (30, 40, -90), (0, 0, 0)])
def test_impossible_color_is_refused(lab: tuple[float, float, float]) -> None:
    values = ", ".join(map(str, lab))

    with pytest.raises(ReadingError, match=f"no surface has Lab {values} .*chroma"):
        panel_from_lab([45], [lab])


def two_angles() -> Panel:
    return Panel(np.array([15.0, 45.0]), np.array([[1.2] * 31, [0.6] * 31]), "two")


@pytest.mark.parametrize(
    ("angle", "factor"), [(15, 1.2), (30, 0.9), (45, 0.6), (-15, 1.2), (110, 0.6)]
)
def test_factors_are_interpolated_and_held(angle: float, factor: float) -> None:
    factors = two_angles().factors_at(angle)

    assert factors.shape == (31,)
    assert factors == pytest.approx(factor)


def test_several_angles_give_several_rows() -> None:
    factors = two_angles().factors_at((25, 45, 75))

    assert factors.shape == (3, 31)
    assert factors[:, 7] == pytest.approx([1.0, 0.6, 0.6])


def test_every_angle_is_interpolated_as_numpy_does() -> None:
    rng = np.random.default_rng(3)
    for count in range(1, 8):
        panel = Panel(
            np.sort(rng.uniform(-45.0, 110.0, count)), rng.uniform(0, 1, (count, 31))
        )
        asked = np.append(rng.uniform(-60.0, 130.0, 20), panel.aspecular_deg)
        bands = [np.interp(asked, panel.aspecular_deg, one) for one in panel.factors.T]

        factors = panel.factors_at(asked.reshape(-1, 1))

        assert factors[:, 0] == pytest.approx(np.array(bands).T, rel=1e-12)
        assert (panel.factors_at(panel.aspecular_deg) == panel.factors).all()


def test_panel_cannot_be_repainted() -> None:
    panel = two_angles()

    with pytest.raises(ValueError, match="read-only"):
        panel.factors[0, 0] = 0.5
    with pytest.raises(AttributeError, match="factors"):
        panel.factors = panel.factors  # type: ignore[misc]


@pytest.mark.parametrize(
    ("angles", "factors", "message"),
    [
        ([45, 15], np.ones((2, 31)), "angles of panel 'bad' must ascend"),
        ([], np.ones((0, 31)), "angles of panel 'bad' must ascend"),
        ([15, 45], np.ones((2, 16)), r"needs 31 .* 2 angles, got shape \(2, 16\)"),
        ([15], np.full((1, 31), -0.1), "between 0 and 15, got -0.1 to -0.1"),
        ([15], np.full((1, 31), 60.0), "between 0 and 15, got 60 to 60"),
        ([15], np.full((1, 31), np.nan), "must lie between 0 and 15"),
    ],
)
def test_impossible_panel_is_refused(
    angles: list[float], factors: np.ndarray, message: str
) -> None:
    with pytest.raises(ReadingError, match=message):
        Panel(np.array(angles, dtype=float), factors, "bad")
