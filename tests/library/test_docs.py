"""What docs/library.md shows is what the program takes."""

from __future__ import annotations

import re
from pathlib import Path

from click.testing import CliRunner

from paintlink.cli import main
from paintlink.library import bundled, munsell
from paintlink.library.profile import read_profile

PAGE = Path(__file__).parents[2] / "docs" / "library.md"


def test_profile_of_the_page_can_be_read(tmp_path: Path) -> None:
    (toml,) = re.findall(r"```toml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)
    path = tmp_path / "profile.toml"
    path.write_text(toml, encoding="utf-8")

    assert read_profile(path).finishes == {"Uni": "solid", "Effekt": "metallic"}


def test_every_command_of_the_page_is_one() -> None:
    text = PAGE.read_text(encoding="utf-8")
    named = set(re.findall(r"paintlink library ([a-z]+)", text))

    done = CliRunner().invoke(main, ["library", "--help"])

    commands = set(
        re.findall(r"^  ([a-z]+)", done.output.partition("Commands:")[2], re.M)
    )
    assert named == commands


def test_every_option_of_the_page_is_one() -> None:
    text = PAGE.read_text(encoding="utf-8")
    named = set(re.findall(r"--[a-z][a-z-]*", text)) - {"--check"}

    known = {
        option
        for command in main.get_command(None, "library").commands.values()  # type: ignore[union-attr,arg-type]
        for parameter in command.params
        for option in parameter.opts
    }

    assert named <= known


def test_numbers_of_the_page_are_those_of_the_libraries() -> None:
    text = PAGE.read_text(encoding="utf-8")

    assert f"{len(bundled())} invented paints" in text
    assert f"{len(munsell())} real colours" in text
