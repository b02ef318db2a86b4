"""The command line as a user runs it: real processes, real files."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from paintlink.spec import write_spec
from tests.daemon.conftest import make_spec

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Run `paintlink` with arguments in an empty folder and home."""

    def go(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
        environment = {
            "HOME": str(tmp_path / "home"),
            "PATH": "/usr/bin:/bin",
            "COLUMNS": "200",
        }
        return subprocess.run(
            [sys.executable, "-m", "paintlink", *map(str, arguments)],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )

    return go


@pytest.fixture
def spec_file(tmp_path: Path) -> Path:
    """A specification of a grey metallic."""
    path = tmp_path / "grey.xml"
    path.write_bytes(write_spec(make_spec("grey")))
    return path
