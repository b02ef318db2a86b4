"""Reads every file of a folder and says what became of it; watched by the tests.

Usage: read_all.py file|parser FOLDER. What matters lies between two attempts to open
FOLDER/begin and FOLDER/end, which do not exist. FOLDER/warm-up makes the reader load
what it needs itself.
"""

from __future__ import annotations

import contextlib
import json
import sys
import traceback
from collections.abc import Callable
from pathlib import Path

from paintlink.errors import SpecError
from paintlink.spec import read_spec_file
from paintlink.spec.document import decoded, parsed


def mark(path: Path) -> None:
    with contextlib.suppress(FileNotFoundError):
        path.open()


def parse(path: Path) -> object:
    """The document as the parser sees it without the checks before it."""
    return parsed(decoded(path.read_bytes()))


def outcome(read: Callable[[Path], object], path: Path) -> object:
    try:
        return read(path)
    except SpecError as error:
        return error


def report(outcome: object) -> tuple[str, str]:
    if isinstance(outcome, SpecError):
        return "refused", "".join(traceback.format_exception(outcome))
    return "read", str(outcome)


def main(reader: str, folder: Path) -> None:
    read = {"file": read_spec_file, "parser": parse}[reader]
    documents = sorted(folder.glob("*.xml"))
    outcome(read, folder / "warm-up")
    mark(folder / "begin")
    outcomes = [outcome(read, path) for path in documents]
    mark(folder / "end")
    json.dump([report(outcome) for outcome in outcomes], sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
