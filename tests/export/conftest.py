"""Real file systems that fail in real ways."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest


@contextmanager
def mounted(place: Path, options: str) -> Iterator[Path]:
    if os.geteuid() != 0 or shutil.which("mount") is None:
        pytest.skip("mounting a tmpfs needs root")
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", options, "paintlink-test", str(place)]
    if subprocess.run(mount, capture_output=True, check=False).returncode != 0:
        pytest.skip("this machine lets even root mount nothing")
    try:
        yield place
    finally:
        subprocess.run(["umount", str(place)], check=True)


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    with mounted(tmp_path / "disk", "size=1m,mode=0777") as place:
        yield place


@pytest.fixture
def big_disk(tmp_path: Path) -> Iterator[Path]:
    with mounted(tmp_path / "disk", "size=8m,mode=0777") as place:
        yield place


@pytest.fixture
def read_only_disk(big_disk: Path) -> Path:
    remount = ["mount", "-o", "remount,ro", str(big_disk)]
    subprocess.run(remount, check=True)
    return big_disk


@pytest.fixture
def locked_folder() -> Iterator[Path]:
    """A folder this process may look into and not write to; root steps down for it."""
    root = os.geteuid() == 0
    with tempfile.TemporaryDirectory(prefix="paintlink-test-") as name:
        folder = Path(name)
        folder.chmod(0o555)
        if root:
            os.seteuid(65534)
        try:
            yield folder
        finally:
            if root:
                os.seteuid(0)
            folder.chmod(0o755)
