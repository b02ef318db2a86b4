"""The configuration spells the words of the program, without importing all of it."""

from __future__ import annotations

from pathlib import Path
from typing import get_args

import pytest

from paintlink import instrument, model
from paintlink.config import RouteSettings, _keys
from paintlink.config._document import keys
from paintlink.config._keys import choices
from paintlink.export.names import FIELDS


def test_origins_are_those_of_the_model() -> None:
    assert get_args(_keys.Origin) == get_args(model.Origin)


def test_finishes_are_those_of_the_model() -> None:
    assert choices(keys("inbox")["finish"]) == model.FINISHES


@pytest.mark.parametrize(
    ("key", "field"), [("baud", "baudrate"), ("bytesize",) * 2, ("stopbits",) * 2]
)
def test_serial_choices_are_those_of_the_line(key: str, field: str) -> None:
    options = instrument.describe_options(instrument.SerialSettings())
    (known,) = [option for option in options if option.name == field]

    assert choices(keys("instrument")[key]) == known.choices


def test_parities_begin_with_the_letters_of_the_line() -> None:
    words = [str(word) for word in choices(keys("instrument")["parity"])]

    letters = tuple(word[0].upper() for word in words)

    options = instrument.describe_options(instrument.SerialSettings())
    (known,) = [option for option in options if option.name == "parity"]
    assert letters == known.choices


def test_every_field_of_a_file_name_is_explained() -> None:
    (key,) = [
        one for one in keys("route")["pattern"].__metadata__ if hasattr(one, "meaning")
    ]

    assert all(f"{{{field}}}" in key.meaning for field in FIELDS)


def test_simulated_readings_need_to_be_asked_for() -> None:
    route = RouteSettings(name="a", folder=Path("/x"), format="f")

    assert route.accept == ("real",)
    assert route.mode_bits == 0o664
