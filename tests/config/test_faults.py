from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from paintlink.config import load_settings
from paintlink.config._document import SECTIONS
from paintlink.config._toml import toml
from paintlink.errors import ConfigError

INSTRUMENT = '[[instrument]]\nname = "bench"\ndriver = "xrite_ma"\nport = "p"\n'
ROUTE = '[[route]]\nname = "net"\nformat = "colornet"\n'
BAUD = "300, 600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800"


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("[inbox]\npol_s = 1", '[inbox]: unknown key "pol_s": did you mean "poll_s"?'),
        ("[log]\nx = 1", '[log]: unknown key "x": known are level'),
        ("[inbx]", 'unknown section "inbx": did you mean "inbox"?'),
        (
            'name = "x"',
            'key "name" stands outside every section: move it below one like [site]',
        ),
        (
            f'{INSTRUMENT}prot = "x"',
            '[[instrument]] 1 "bench": unknown key "prot": did you mean "port"?',
        ),
    ],
    ids=["key", "nothing near", "section", "no section", "repeated"],
)
def test_unknown_word_gets_the_nearest_one(refuse, text: str, fault: str) -> None:
    assert refuse(text) == [f"FILE: {fault}"]


@pytest.mark.parametrize(
    ("section", "line", "allowed"),
    [
        ("inbox", "enabled = 1", "true or false"),
        ("inbox", "poll_s = 0.05", "a number from 0.1 to 3600"),
        ("inbox", 'quiet_s = "1"', "a number from 0.1 to 3600"),
        ("inbox", "max_size_mib = 101", "a whole number from 1 to 100"),
        ("snap", "top = 2.5", "a whole number from 1 to 1000"),
        ("snap", "top = true", "a whole number from 1 to 1000"),
        ("snap", "green = NaN", "a number from 0 to 100"),
        ("snap", 'formula = " "', "text in quotes, not empty"),
        ("site", 'folder = ""', 'a folder in quotes, without "~", such as "/srv"'),
        ("site", 'folder = "~/x"', 'a folder in quotes, without "~", such as "/srv"'),
        ("state", "folder = 7", 'a folder in quotes, without "~", such as "/srv"'),
        ("preview", 'backend = "gpu"', '"auto", "gl" or "cpu"; did you mean "cpu"?'),
    ],
)
def test_wrong_value_is_shown_with_allowed_ones(
    refuse, section: str, line: str, allowed: str
) -> None:
    faults = refuse(f"[{section}]\n{line.replace('NaN', 'nan')}")

    assert faults == [f"FILE: [{section}]: {line}: must be {allowed}"]


@pytest.mark.parametrize(
    ("line", "allowed"),
    [
        ("readings = 25", "a whole number from 1 to 20"),
        ("baud = 9601", f"{BAUD} or 921600; did you mean 9600?"),
        ("serial = 12345", "text in quotes"),
        ("options = 3", "a table, such as { key = 1 }"),
    ],
)
def test_wrong_instrument_value_names_the_block(
    refuse, line: str, allowed: str
) -> None:
    faults = refuse(INSTRUMENT + line)

    assert faults == [f'FILE: [[instrument]] 1 "bench": {line}: must be {allowed}']


@pytest.mark.parametrize(
    ("line", "allowed"),
    [
        ('mode = "777"', '"06" and two digits out of 0, 4 and 6, such as "0664"'),
        ("accept = []", 'a list of "real", "simulated" or both, such as ["real"]'),
        ('pattern = "{moon}"', 'a pattern in quotes, such as "{date}_{name}"'),
        ('pattern = ""', 'a pattern in quotes, such as "{date}_{name}"'),
    ],
)
def test_wrong_route_value_names_the_block(refuse, line: str, allowed: str) -> None:
    faults = refuse(f'{ROUTE}folder = "/out"\n{line}')

    assert faults == [f'FILE: [[route]] 1 "net": {line}: must be {allowed}']


def test_wrong_list_element_gets_nearest_word(refuse) -> None:
    (fault,) = refuse(f'{ROUTE}folder = "/out"\naccept = ["real", "simulate"]')

    assert fault.endswith('such as ["real"]; did you mean "simulated"?')


def test_missing_key_is_named_in_its_block(refuse) -> None:
    faults = refuse(f'{INSTRUMENT}[[instrument]]\nname = "lab"\ndriver = "x"')

    assert faults == [
        'FILE: [[instrument]] 2 "lab": key "port" is missing: it must be text in '
        "quotes, not empty"
    ]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (
            "[[log]]",
            "[log]: write [log] once, in single brackets, and its keys below it",
        ),
        (
            "[instrument]",
            "[instrument]: write [[instrument]], in double brackets, and its keys "
            "below it",
        ),
        (
            "route = [1]",
            "[[route]] 1: write [[route]], in double brackets, and its keys below it",
        ),
        ("site = 3", "[site]: write [site] once, in single brackets, and its keys"),
    ],
)
def test_wrong_brackets_are_told(refuse, text: str, fault: str) -> None:
    (found,) = refuse(text)

    assert found.startswith(f"FILE: {fault}")


def test_all_faults_come_at_once(refuse) -> None:
    faults = refuse(
        f"nme = 1\n[log]\nlevl = 2\n[snap]\ntop = 0\n{INSTRUMENT}{INSTRUMENT}baud = 1\n"
        '[[route]]\nname = "net"'
    )

    assert [fault.partition(": ")[2][:24] for fault in faults] == [
        '[[instrument]] 2 "bench"',
        "[snap]: top = 0: must be",
        '[[route]] 1 "net": key "',
        '[[route]] 1 "net": key "',
        '[log]: unknown key "levl',
        'key "nme" stands outside',
        '[[instrument]] 2 "bench"',
    ]


@pytest.mark.parametrize("readings", [1, 20])
def test_limits_themselves_are_allowed(load, readings: int) -> None:
    settings = load(f"{INSTRUMENT}readings = {readings}\n[snap]\ngreen = 0")

    assert settings.instruments[0].readings == readings
    assert settings.snap.green == 0.0


def test_long_value_is_shortened(refuse) -> None:
    (fault,) = refuse(f'[log]\nlevel = "{"x" * 200}"')

    assert f'level = "{"x" * 59}...: must be' in fault


VALUES = st.recursive(
    st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(["name", "folder", "x"]), inner)
    ),
    max_leaves=5,
)
KEYS = st.sampled_from(["folder", "name", "green", "accept", "options", "pattern"])


@settings(
    max_examples=300,
    deadline=None,  # the machine may be busy
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(
    head=st.sampled_from(["", *(f"[{name}]" for name in SECTIONS)]),
    lines=st.dictionaries(KEYS | st.sampled_from([*SECTIONS]), VALUES, max_size=3),
    repeated=st.booleans(),
)
def test_any_file_is_loaded_or_refused_in_words(
    write, head: str, lines: dict[str, object], repeated: bool
) -> None:
    body = "\n".join(f"{key} = {toml(value)}" for key, value in lines.items())
    path = write(f"[{head}]\n{body}" if head and repeated else f"{head}\n{body}")

    try:
        source = load_settings(path, environ={}).source
    except ConfigError as error:
        source = Path(str(error).partition(": ")[0])

    assert source == path
