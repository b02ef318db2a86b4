from __future__ import annotations

import re
import tomllib
from dataclasses import fields
from pathlib import Path

import pytest

from paintlink.config import default_settings, explain, load_settings
from paintlink.config._document import SECTIONS, keys
from paintlink.config._keys import Key, _parts

ROOT = Path(__file__).parents[2]
SHIPPED = ROOT / "config" / "paintlink.toml"
SWITCHED_OFF = re.compile(r"^#(?=[\[a-z])", re.MULTILINE)


def everything(text: str) -> dict[str, list[dict[str, object]]]:
    """Every section of the text with all that is switched off switched on."""
    table = tomllib.loads(SWITCHED_OFF.sub("", text))
    return {
        name: found if isinstance(found, list) else [found]
        for name, found in table.items()
    }


def test_shipped_file_is_the_explanation() -> None:
    assert SHIPPED.read_text(encoding="utf-8") == explain() + "\n"


def test_shipped_file_holds_exactly_the_defaults() -> None:
    environ = {"STATE_DIRECTORY": "/var/lib/paintlink"}

    shipped = load_settings(SHIPPED, environ=environ)

    default = default_settings(environ=environ)
    for section in default.__slots__:
        if section != "source":
            assert getattr(shipped, section) == getattr(default, section)


def test_every_key_is_explained_once() -> None:
    sections = everything(explain())

    assert list(sections) == list(SECTIONS)
    for name, (section,) in sections.items():
        assert list(section) == [field.name for field in fields(SECTIONS[name])]


def test_examples_are_values_that_are_allowed(tmp_path: Path) -> None:
    path = tmp_path / "paintlink.toml"
    path.write_text(SWITCHED_OFF.sub("", explain()), encoding="utf-8")

    settings = load_settings(path, environ={})

    assert (len(settings.instruments), len(settings.routes)) == (1, 1)


@pytest.mark.parametrize("section", SECTIONS)
def test_explanation_is_made_of_sentences(section: str) -> None:
    for name, hint in keys(section).items():
        (key,) = [part for part in _parts(hint) if isinstance(part, Key)]

        assert key.meaning[0].isupper(), name
        assert key.meaning.endswith("."), name
        assert key.example is not None or not key.unset, name


def test_lines_fit_a_terminal() -> None:
    long = [line for line in explain().splitlines() if len(line) > 88]

    assert long == []
