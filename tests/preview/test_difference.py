from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import ciede2000
from paintlink.preview import difference_map
from paintlink.preview.difference import COLOURS, STOPS, false_colours
from tests.preview.truth import GREY, RED, SILVER, paint

pytestmark = pytest.mark.usefixtures("coarse_bake")


def test_same_paint_differs_nowhere() -> None:
    _, difference = difference_map(RED, RED, object="sphere", size=48)

    assert difference.max() == 0


def test_solids_differ_about_as_their_lab_does_where_the_light_is_full() -> None:
    other = paint(*[(63, 0, 0)] * 3)

    _, difference = difference_map(GREY, other, object="sphere", size=64)

    expected = ciede2000(GREY.lab()[0], other.lab()[0])
    assert difference.max() == pytest.approx(expected, rel=0.25)
    assert difference[0].max() == 0


def test_picture_names_both_paints_and_the_scale() -> None:
    picture, _ = difference_map(RED, SILVER, size=64)

    assert picture.specs == (RED, SILVER)
    assert any("scale 0 1 2 4 8 dE00" in note for note in picture.notes)
    np.testing.assert_array_equal(picture.rgb[-1, 0], COLOURS[0])
    np.testing.assert_array_equal(picture.rgb[-1, -1], COLOURS[-1])


def test_colours_of_the_stops_are_those_of_the_scale() -> None:
    np.testing.assert_array_equal(false_colours(np.array(STOPS)), COLOURS)
    np.testing.assert_array_equal(false_colours(np.array([99.0])), COLOURS[-1:])
