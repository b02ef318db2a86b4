"""docs/import.md says what the program does."""

from __future__ import annotations

import re
from pathlib import Path

from paintlink.cli.import_ import command
from paintlink.intake import importers, load_profile
from paintlink.intake.profile import WORDS

PAGE = (Path(__file__).parents[2] / "docs" / "import.md").read_text(encoding="utf-8")


def test_page_lists_the_formats_there_are() -> None:
    told = set(re.findall(r"^\| `([a-z0-9_]+)` \|", PAGE, re.MULTILINE))

    assert told == importers().keys()


def test_profile_on_the_page_can_be_used(tmp_path: Path) -> None:
    (example,) = re.findall(r"```toml\n(format = 1.*?)```", PAGE, re.DOTALL)
    path = tmp_path / "shop.toml"
    path.write_text(example, encoding="utf-8")

    profile = load_profile(path)

    assert profile.decimal == ","
    assert profile.columns["15° 400 nm"].value == "400"


def test_page_names_every_meaning_of_a_column() -> None:
    assert all(f"`{word}`" in PAGE or f'"{word}' in PAGE for word in WORDS)


def test_options_on_the_page_exist() -> None:
    known = {name for option in command.params for name in option.opts}

    assert set(re.findall(r"(?<!-)--[a-z]+(?:-[a-z]+)*", PAGE)) <= known
