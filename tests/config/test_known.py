from __future__ import annotations

import pytest

from paintlink.config import check_against, default_settings
from paintlink.errors import ConfigError

TEXT = """
[preview]
object = "spere"
[[instrument]]
name = "bench"
driver = "xrite_mb"
port = "p"
[[route]]
name = "net"
folder = "/x"
format = "colornet"
"""


def test_known_names_pass(load) -> None:
    check_against(load(TEXT), drivers={"xrite_mb"}, formats={"colornet": 1})


def test_unknown_names_are_told_together(load, tmp_path) -> None:
    settings = load(TEXT)

    with pytest.raises(ConfigError, match="unknown driver") as caught:
        check_against(
            settings,
            drivers=["xrite_ma", "km_cm512"],
            formats=["csv"],
            objects=["panel", "sphere"],
            lights=["hall"],
        )

    file = tmp_path / "paintlink.toml"
    assert str(caught.value).splitlines() == [
        f'{file}: [[instrument]] 1 "bench": unknown driver "xrite_mb": did you mean '
        '"xrite_ma"?',
        f'{file}: [[route]] 1 "net": unknown format "colornet": known are csv',
        f'{file}: [preview]: unknown object "spere": did you mean "sphere"?',
        f'{file}: [preview]: unknown light "studio": known are hall',
    ]


def test_template_names_what_is_configured(load) -> None:
    template = """
    [[template]]
    name = "refinish"
    routes = ["nett"]
    instruments = ["bench", "bank"]
    """

    with pytest.raises(ConfigError) as caught:
        check_against(load(TEXT + template), drivers={"xrite_mb"}, formats={"colornet"})

    assert [line.split(": ", 2)[2] for line in str(caught.value).splitlines()] == [
        'unknown routes "nett": did you mean "net"?',
        'unknown instruments "bank": known are bench',
    ]


def test_nothing_known_is_said_so(load) -> None:
    with pytest.raises(ConfigError, match='unknown driver "xrite_mb": known are none'):
        check_against(load(TEXT), drivers=(), formats=["colornet"])


def test_built_in_settings_are_named_as_such() -> None:
    settings = default_settings(environ={"STATE_DIRECTORY": "/s"})

    with pytest.raises(ConfigError, match=r"^built-in settings: \[snap\]: unknown for"):
        check_against(settings, drivers=(), formats=(), formulas=["x"])


def test_default_names_are_known_to_the_program() -> None:
    from paintlink.color import FORMULAS
    from paintlink.preview import light_names, object_names

    check_against(
        default_settings(environ={"STATE_DIRECTORY": "/s"}),
        drivers=(),
        formats=(),
        formulas=FORMULAS,
        objects=object_names(),
        lights=light_names(),
    )
