"""Measured data that is read by hand and never shipped with the project."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

import pytest

HELD_OUT = Path(__file__).parents[2].parent / "shared" / "data"


@pytest.fixture(scope="session")
def held_out() -> Callable[[str], list[dict[str, str]]]:
    def rows(name: str) -> list[dict[str, str]]:
        path = HELD_OUT / name
        if not path.exists():
            pytest.skip(f"shared/data/{name} is not on this machine")
        with path.open(newline="") as file:
            return list(csv.DictReader(file))

    return rows
