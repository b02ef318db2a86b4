"""The program that writes the bundled library."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from paintlink.library.store import BUNDLED

TOOL = Path(__file__).parents[2] / "tools" / "make_standin_library.py"


def generated(target: Path, hash_seed: str) -> bytes:
    subprocess.run(
        [sys.executable, "-W", "error", str(TOOL), str(target)],
        check=True,
        env={**os.environ, "PYTHONHASHSEED": hash_seed, "TZ": f"UTC{hash_seed}"},
        cwd=target.parent,
    )
    return target.read_bytes()


def test_every_run_writes_the_packaged_bytes(tmp_path: Path) -> None:
    first = generated(tmp_path / "first.npz", "1")
    second = generated(tmp_path / "second.npz", "7")

    assert first == second
    assert first == BUNDLED.read_bytes()
