from dataclasses import dataclass

import pytest

from paintlink.errors import ConfigError
from paintlink.instrument import (
    SerialSettings,
    describe_options,
    option,
    parse_options,
)


@dataclass(frozen=True, slots=True)
class Options:
    mode: str = option("read", "how", choices=("read", "listen"))
    wait_s: float = option(2.0, "how long", minimum=1, maximum=60)
    gain: float = option(1.0, "any number")
    count: int = option(1, "how many", minimum=1)
    beep: bool = option(True, "whether to beep")
    note: str = option("", "free text")
    columns: tuple[int, ...] = option((2, 4), "which", minimum=1)


def test_nothing_given_leaves_the_defaults():
    assert parse_options(Options(), {}) == Options()


def test_given_values_take_their_place():
    given = {"mode": "listen", "wait_s": 5, "beep": False, "columns": [4, 2]}

    options = parse_options(Options(), given)

    assert options == Options("listen", 5.0, 1.0, 1, False, "", (4, 2))
    assert isinstance(options.wait_s, float)


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        ("mode", "reed", r"did you mean 'read'\? must be one of 'read', 'listen'"),
        ("wait_s", 0.5, "0.5: must be a number from 1 to 60"),
        ("wait_s", "5", "'5': must be a number from 1 to 60"),
        ("wait_s", float("nan"), "nan: must be a number"),
        ("gain", float("inf"), "inf: must be a number"),
        ("wait_s", True, "True: must be a number"),
        ("count", 0, "0: must be a whole number from 1 upwards"),
        ("count", 1.5, "1.5: must be a whole number"),
        ("count", True, "True: must be a whole number"),
        ("beep", 1, "1: must be true or false"),
        ("note", None, "None: must be text"),
        ("columns", [2], r"\[2\]: must be 2 different whole numbers from 1 upwards"),
        ("columns", [2, 2], "must be 2 different"),
        ("columns", [2, 0], "must be 2 different"),
        ("columns", [[], []], "must be 2 different"),
        ("columns", 2, "2: must be 2 different"),
        ("columns", "24", "'24': must be 2 different"),
    ],
)
def test_wrong_value_is_named_with_what_is_allowed(name, value, allowed):
    with pytest.raises(ConfigError, match=f"option {name} = .*{allowed}"):
        parse_options(Options(), {name: value})


def test_unknown_name_brings_the_nearest():
    with pytest.raises(
        ConfigError, match=r"'wait', did you mean 'wait_s'\? known: mode"
    ):
        parse_options(Options(), {"wait": 1})


def test_all_faults_are_told_at_once():
    with pytest.raises(
        ConfigError, match=r"(?s)unknown option 'xyz'; known.*count = 0"
    ):
        parse_options(Options(), {"xyz": 1, "count": 0})


def test_options_describe_themselves_in_order():
    described = describe_options(Options())

    assert [option.name for option in described] == [
        *("mode", "wait_s", "gain", "count", "beep", "note", "columns"),
    ]
    assert described[1].help == "how long"
    assert described[1].default == 2.0


def test_serial_settings_are_checked_alike():
    settings = parse_options(SerialSettings(), {"baudrate": 1200, "parity": "E"})

    assert settings.summary == "1200 8E1"
    with pytest.raises(
        ConfigError,
        match=r"baudrate = 9601, did you mean '9600'\? must be one of 300, .*921600",
    ):
        parse_options(settings, {"baudrate": 9601})
