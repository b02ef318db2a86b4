"""The program that writes the bundled library."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from paintlink.library.store import BUNDLED

TOOL = Path(__file__).parents[2] / "tools" / "make_library.py"
PATIENCE_S = 500


def generated(target: Path, seed: str) -> Path:
    """A library written under another hash seed, time zone and number of threads."""
    environment = {
        "PYTHONHASHSEED": seed,
        "TZ": f"UTC{seed}",
        "OPENBLAS_NUM_THREADS": seed,
    }
    subprocess.run(
        [sys.executable, "-W", "error", str(TOOL), str(target)],
        check=True,
        env={**os.environ, **environment},
        cwd=target.parent,
    )
    return target


@pytest.mark.timeout(PATIENCE_S)
def test_packaged_paints_come_out_of_the_program(tmp_path: Path) -> None:
    """Column by column: another zlib may pack the same paints into other bytes."""
    again = generated(tmp_path / "again.npz", "1")

    with np.load(again) as ours, np.load(BUNDLED) as packaged:
        assert ours.files == packaged.files
        assert all(
            np.array_equal(ours[name], packaged[name], equal_nan=name.endswith("deg"))
            for name in ours.files
        )


@pytest.mark.proof
@pytest.mark.timeout(2 * PATIENCE_S)
def test_every_run_writes_the_same_bytes(tmp_path: Path) -> None:
    first = generated(tmp_path / "first.npz", "1")
    second = generated(tmp_path / "second.npz", "2")

    assert first.read_bytes() == second.read_bytes()
