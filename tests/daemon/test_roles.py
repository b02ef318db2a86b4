from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from paintlink.daemon.roles import RoleLocks
from paintlink.errors import ConfigError

HOLD = """
import sys, pathlib
from paintlink.daemon.roles import RoleLocks
locks = RoleLocks(pathlib.Path(sys.argv[1]), ["line"])
print("held", flush=True)
sys.stdin.read()
"""


def test_second_process_in_a_role_is_refused(tmp_path: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == b"held\n"

        with pytest.raises(
            ConfigError, match="another paintlink already runs the line"
        ):
            RoleLocks(tmp_path, ("render", "line"))

        RoleLocks(tmp_path, ("render",)).release()
        other.kill()

    RoleLocks(tmp_path, ("line",)).release()


def test_released_role_can_be_taken_again(tmp_path: Path) -> None:
    RoleLocks(tmp_path, ("line",)).release()

    RoleLocks(tmp_path, ("line",)).release()
