from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from paintlink.color import (
    Travel,
    chroma_index,
    chroma_index_array,
    flop_index,
    flop_index_array,
    hue_shift_index,
    hue_shift_index_array,
    hue_travel,
    hue_travel_array,
    travel,
)
from paintlink.model import ColorSpec, Lab, Sample

ab = st.floats(-100.0, 100.0)
paints = arrays(np.float64, (5, 3, 3), elements=st.floats(-100.0, 150.0))


def lightness(*values: float) -> np.ndarray:
    return np.array([[value, 0.0, 0.0] for value in values])


def travelling(face: tuple[float, float], flop: tuple[float, float]) -> np.ndarray:
    return np.array([[90, *face], [50, 0, 0], [20, *flop]], dtype=np.float64)


def spec(samples: dict[float, tuple[float, float, float]]) -> ColorSpec:
    values = tuple(Sample(angle, Lab(*lab)) for angle, lab in samples.items())
    return ColorSpec("paint", values)


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        pytest.param((130, 61, 33), 12.5801, id="vector-24"),
        pytest.param((89.12, 31.61, 10.15), 17.6233, id="vector-25"),
        pytest.param((50, 40, 10), 6.7650, id="vector-26-effect"),
        pytest.param((60, 60, 60), 0.0, id="vector-26-solid"),
        pytest.param((12, 3, 1), 14.9752, id="vector-27-dark"),
        pytest.param((12, 1, 1), 38.5211, id="vector-27-darker"),
        pytest.param((8, 0.5, 0.4), 46.3811, id="vector-27-darkest"),
        pytest.param((50, 52, 54), 0.0, id="vector-28-lighter-flop"),
    ],
)
def test_flop_index_gives_known_value(values, expected):
    assert flop_index(lightness(*values)) == pytest.approx(expected, abs=5.1e-5)


@pytest.mark.parametrize(
    "values",
    [
        pytest.param((np.nan, 60, 30), id="vector-28-missing-face"),
        pytest.param((90, np.nan, 30), id="vector-28-missing-middle"),
        pytest.param((90, 60, np.nan), id="vector-28-missing-flop"),
        pytest.param((90, 60, -0.1), id="negative-flop"),
        pytest.param((90, -0.1, 30), id="negative-middle"),
        pytest.param((90, 0, 30), id="black-middle"),
    ],
)
def test_flop_index_can_be_undefined(values):
    assert flop_index(lightness(*values)) is None


@given(st.tuples(st.floats(0, 150), ab, ab))
def test_solid_never_flops_or_travels(lab):
    paint = np.array([lab, lab, lab])

    assert flop_index(paint) == 0.0
    assert chroma_index(paint) == 0.0
    assert hue_travel(paint) in {0.0, None}


@pytest.mark.parametrize(
    ("face", "flop", "chroma_value", "hue_value", "turn_deg"),
    [
        pytest.param((40, 0), (0, 20), 20, 20, 90, id="vector-30"),
        pytest.param((40, 0), (-20, 0), 20, 0, 180, id="vector-31-trap"),
        pytest.param((40, -0.0), (-20, -0.0), 20, 0, 180, id="half-turn-is-positive"),
        pytest.param((30, 40), (3, 4), 45, 0, 0, id="vector-32"),
        pytest.param((0.01, 0), (0, 20), 19.99, None, None, id="vector-33-achromatic"),
        pytest.param((20, 0), (0, 0.5), 19.5, 0.5, None, id="achromatic-flop"),
        pytest.param((10, 0), (0, -10), 0, 10, -90, id="same-chroma-hue-flip"),
    ],
)
def test_chroma_and_hue_travel_are_known(face, flop, chroma_value, hue_value, turn_deg):
    paint = travelling(face, flop)

    assert chroma_index(paint) == pytest.approx(chroma_value)
    assert hue_shift_index(paint) == pytest.approx(hue_value)
    assert hue_travel(paint) == pytest.approx(turn_deg)


@given(ab, ab, ab, ab)
def test_hue_shift_stays_below_flop_chroma(a15, b15, a110, b110):  # vector 34
    shift = hue_shift_index(travelling((a15, b15), (a110, b110)))

    assert shift is None or shift <= np.hypot(a110, b110) * (1 + 1e-12)


@given(ab, ab, ab, ab, st.floats(0.0, 2.0 * np.pi))
def test_turning_the_hue_circle_changes_nothing(a15, b15, a110, b110, turn):
    rotation = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    paint = travelling((a15, b15), (a110, b110))
    turned = paint.copy()
    turned[:, 1:] = paint[:, 1:] @ rotation

    assert chroma_index(turned) == pytest.approx(chroma_index(paint), abs=1e-9)
    shifts = hue_shift_index(turned), hue_shift_index(paint)
    assert None in shifts or shifts[0] == pytest.approx(shifts[1], abs=1e-9)


@given(paints)
def test_chroma_index_ignores_the_direction(lab):
    backwards = lab[:, ::-1]

    assert chroma_index_array(lab).tolist() == chroma_index_array(backwards).tolist()


def test_hue_shift_depends_on_direction():
    forth = hue_shift_index(travelling((40, 0), (0, 20)))
    back = hue_shift_index(travelling((0, 20), (40, 0)))

    assert (forth, back) == (20.0, 40.0)


@given(paints)
def test_table_form_equals_single_form(lab):
    pairs = [
        (flop_index_array, flop_index),
        (chroma_index_array, chroma_index),
        (hue_shift_index_array, hue_shift_index),
        (hue_travel_array, hue_travel),
    ]

    for table, single in pairs:
        alone = [single(paint) for paint in lab]
        expected = [np.nan if value is None else value for value in alone]
        assert table(lab) == pytest.approx(expected, rel=1e-12, nan_ok=True)


def test_index_keeps_leading_axes():
    assert flop_index_array(np.full((4, 5, 3, 3), 20.0)).shape == (4, 5)


def test_travel_reads_the_three_angles():
    lab = {15: (130, 40, 0), 25: (99, 9, 9), 45: (61, 9, 9), 75: (40, 9, 9)}
    result = travel(spec({**lab, 110: (33, 0, 20)}))

    assert result == Travel(
        flop_index=pytest.approx(12.5801, abs=5e-5),
        chroma_index=pytest.approx(20.0),
        hue_shift_index=pytest.approx(20.0),
        hue_travel_deg=pytest.approx(90.0),
        unstable=False,
    )


def test_other_angles_give_no_indices():  # vector 28
    result = travel(spec({25: (90, 5, 5), 45: (60, 5, 5), 75: (30, 5, 5)}))

    assert result == Travel(None, None, None, None, unstable=False)


@pytest.mark.parametrize(("middle", "unstable"), [(0.99, True), (1.0, False)])
def test_very_dark_paint_is_marked_unstable(middle, unstable):
    result = travel(spec({15: (8, 0, 0), 45: (middle, 0, 0), 110: (0.4, 0, 0)}))

    assert result.unstable is unstable
    assert result.flop_index > 20.0
