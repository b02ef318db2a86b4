"""docs/configuration.md says what the program does."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from paintlink.config import explain

DOCUMENT = Path(__file__).parents[2] / "docs" / "configuration.md"
FAULTY = """
[preview]
backend = "gpu"
[[instrument]]
name = "bench"
driver = "xrite_ma"
prot = "/dev/ttyUSB0"
readings = 25
[[route]]
name = "colornet"
folder = "/srv/paintlink/colornet"
format = "colornet"
[[route]]
name = "labels"
folder = "/srv/paintlink/colornet"
format = "csv"
"""


@pytest.fixture
def document() -> str:
    return DOCUMENT.read_text(encoding="utf-8")


def blocks(document: str) -> list[str]:
    """The indented blocks, without their indent."""
    found = re.findall(r"(?:^ {4}.*\n|^\n(?= {4}))+", document, re.MULTILINE)
    return [re.sub("^ {4}", "", block, flags=re.MULTILINE) for block in found]


def test_every_key_is_shown(document: str) -> None:
    assert f"```toml\n{explain()}\n```" in document


def test_example_of_one_reader_loads(document: str, load) -> None:
    (example,) = [block for block in blocks(document) if "[[instrument]]\n" in block]

    settings = load(example)

    assert [one.driver for one in settings.instruments] == ["xrite_ma"]
    assert [one.format for one in settings.routes] == ["colornet"]
    assert settings.routes[0].folder.is_relative_to(settings.site_folder)


@pytest.mark.parametrize("text", [FAULTY, '[[instrument]]\n\nname "bench"'])
def test_faults_are_told_as_shown(document: str, refuse, text: str) -> None:
    faults = [fault.replace("FILE", "paintlink.toml") for fault in refuse(text)]

    assert "\n".join(faults) in "\n".join(blocks(document))


def test_example_variables_are_accepted(document: str, load) -> None:
    found = dict(re.findall(r"^ {4}(PAINTLINK__\w+)=(.*)$", document, re.MULTILINE))

    settings = load("", **found)

    assert settings.inbox.poll_s == 2.0
    assert settings.log_level == "debug"
