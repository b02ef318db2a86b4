"""The worked examples of docs/design.md, called as they stand there."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from click.testing import CliRunner

from paintlink.cli import main

PAGE = Path(__file__).parents[2] / "docs" / "design.md"
BLOCK = re.compile(r"```(sh|text)\n(.*?)```", re.DOTALL)
EXAMPLES = 4


def test_examples_print_what_the_page_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    printed, compared = "", 0

    for kind, block in BLOCK.findall(PAGE.read_text()):
        if kind == "text":
            assert block.split() == printed.split()
            compared += 1
            continue
        for line in block.splitlines():
            printed = output_of(line)

    assert compared == EXAMPLES


def output_of(line: str) -> str:
    """What a command prints; pictures are drawn small."""
    program, *arguments = shlex.split(line)
    assert program == "paintlink"
    small = {"480": "128"}
    done = CliRunner().invoke(main, [small.get(one, one) for one in arguments])
    assert done.exit_code == 0, done.output
    return done.stdout


def test_every_picture_of_the_page_is_there_and_small() -> None:
    names = re.findall(r"\]\((images/[^)]+)\)", PAGE.read_text())

    assert len(names) >= EXAMPLES
    for name in names:
        assert (PAGE.parent / name).stat().st_size < 150_000
