from __future__ import annotations

from dataclasses import replace

import numpy as np

from paintlink.design import rates, warnings
from paintlink.model import ColorSpec, Match
from paintlink.snap import nearest
from tests.design.conftest import RED, make_spec
from tests.snap.conftest import make_table

GREY = ((80.0, 0.0, 0.0), (50.0, 0.0, 0.0), (30.0, 0.0, 0.0))


def nearest_to(spec: ColorSpec, paint: object) -> Match:
    return nearest(spec, make_table([paint]))[0]


def test_ordinary_color_gets_no_warning() -> None:
    spec = make_spec(GREY)

    assert warnings(spec, nearest_to(spec, GREY)) == ()


def test_flop_as_light_as_the_face_is_told() -> None:
    spec = make_spec(GREY[::-1])

    told = warnings(spec, nearest_to(spec, GREY[::-1]))

    assert told == ("the flop is not darker than the face, so the Flop Index is 0",)


def test_solid_needs_no_travel() -> None:
    spec = replace(make_spec([GREY[1]] * 3), finish="solid")

    assert warnings(spec, nearest_to(spec, [GREY[1]] * 3)) == ()


def test_angles_outside_the_screen_are_named() -> None:
    spec = make_spec([GREY[0], (60.0, -80.0, 20.0), GREY[2]])

    (told,) = warnings(spec, nearest_to(spec, spec.lab()))

    assert told == "screens cannot show it at 45 degrees (outside sRGB)"


def test_color_far_from_every_paint_is_told() -> None:
    spec = make_spec(GREY)

    (told,) = warnings(spec, nearest_to(spec, np.add(GREY, (3.1, 0.0, 0.0))))

    assert "no known paint is near (mean difference 3.1 to C0)" in told


def test_rate_of_travel_is_told_for_each_channel() -> None:
    told = {name: str(rate) for name, rate in rates(make_spec(RED)).items()}

    assert told == {
        "L": "levels off at 103.6°",
        "a": "levels off beyond 110°",
        "b": "levels off beyond 110°",
    }
