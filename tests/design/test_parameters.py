"""What a step refuses before it is made."""

from __future__ import annotations

import math

import pytest

from paintlink.design import STEPS, make_step, parameters, value_from_text
from paintlink.errors import DesignError
from paintlink.model import Lab


@pytest.mark.parametrize(
    ("step", "values", "says"),
    [
        ("exposure", {"stops": math.nan}, "stops must be a number from -10 to 10"),
        ("exposure", {"stops": math.inf}, "not inf"),
        ("exposure", {"stops": True}, "not True"),
        ("exposure", {"stops": "much"}, "not 'much'"),
        ("exposure", {"stops": 10**400}, "not 1000"),
        ("chroma", {"factor": -0.1}, "from 0 to 10, not -0.1"),
        ("travel", {"factor": -1.0}, "from 0 to 10"),
        ("travel", {"factor": 1.0, "channels": "Lb"}, "one of L, a, b, ab, Lab"),
        ("set-travel", {"vertex_deg": 45.0}, "above 45 to 110 degrees, not 45"),
        ("set-sample", {"angle_deg": 45.0, "L": math.nan}, "L must be"),
        ("set-sample", {"angle_deg": 45.0, "L": 171.0}, "from 0 to 170"),
        ("tint-flop", {"color": (50.0, 0.0), "amount": 0.5}, "L,a,b of a colour"),
        ("tint-flop", {"color": (5.0, 0.0, 50.0), "amount": 0.5}, "XYZ of at least"),
        ("tint-flop", {"color": (50.0, math.inf, 0.0), "amount": 0.5}, "XYZ"),
        ("tint-flop", {"color": "gold", "amount": 0.5}, "not 'gold'"),
        ("tint-flop", {"color": (50.0, 0.0, 0.0), "amount": 1.1}, "from 0 to 1"),
        ("tint-highlight", {"color": (9, 0, 0), "amount": 1, "vertex_deg": 91}, "90"),
        ("towards", {"paint": "RM209", "amount": 0.5}, "code of a known paint"),
    ],
)
def test_value_outside_its_limits_names_them(
    step: str, values: dict[str, object], says: str
) -> None:
    with pytest.raises(DesignError, match=f"^{step}: .*{says}") as caught:
        make_step(step, values)

    assert caught.value.step == step
    assert caught.value.parameter in values


def test_unknown_step_gets_a_suggestion() -> None:
    with pytest.raises(DesignError, match="did you mean rotate-hue"):
        make_step("rotate-heu", {})


def test_unknown_parameter_gets_a_suggestion() -> None:
    with pytest.raises(DesignError, match="did you mean angle_deg"):
        make_step("rotate-hue", {"angle": 3.0})


def test_missing_parameter_is_named_with_its_limits() -> None:
    with pytest.raises(DesignError, match="amount is missing: it is a number from 0"):
        make_step("tint-flop", {"color": (50.0, 0.0, 0.0)})


@pytest.mark.parametrize("step", ["set-face", "set-flop"])
def test_end_point_without_a_value_is_refused(step: str) -> None:
    with pytest.raises(DesignError, match="at least one of L, a, b"):
        make_step(step, {})


@pytest.mark.parametrize("name", STEPS)
def test_every_step_is_documented_and_stored_by_its_name(name: str) -> None:
    kind = STEPS[name]

    assert kind.name == name
    assert (kind.__doc__ or "").partition("\n")[0].endswith(".")
    assert all(about.kind.words for about in parameters(kind).values())


def test_text_becomes_the_value_a_person_means() -> None:
    assert value_from_text("exposure", "stops", "1.5") == 1.5
    assert value_from_text("tint-flop", "color", "82,12,62") == [82.0, 12.0, 62.0]
    assert value_from_text("mirror", "channels", "ab") == "ab"
    assert value_from_text("exposure", "stops", "much") == "much"


def test_negative_zero_is_stored_as_zero() -> None:
    step = make_step("tint-flop", {"color": (50, -0.0, 0), "amount": -0.0})

    assert step.values == {
        "color": Lab(50.0, 0.0, 0.0),
        "amount": 0.0,
        "channels": "Lab",
    }
    assert math.copysign(1.0, step.values["amount"]) == 1.0  # type: ignore[arg-type]
