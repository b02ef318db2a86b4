"""`paintlink run` as systemd runs it."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

from tests.cli.test_line import config


def test_service_tells_systemd_and_ends_on_sigterm(tmp_path: Path) -> None:
    path = config(tmp_path, port="/dev/ttyUSB9")
    address = str(tmp_path / "notify")
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as systemd:
        systemd.bind(address)
        systemd.settimeout(30.0)
        command = [sys.executable, "-m", "paintlink", "run", "--config", str(path)]
        with subprocess.Popen(
            command,
            env={**os.environ, "NOTIFY_SOCKET": address},
            stderr=subprocess.PIPE,
            text=True,
        ) as process:
            ready = systemd.recv(4096).decode()
            process.send_signal(signal.SIGTERM)
            _, log = process.communicate(timeout=30)
        last = systemd.recv(4096).decode()

    assert "READY=1" in ready
    assert "bench; 1 routes" in ready
    assert "STOPPING=1" in last
    assert process.returncode == 0, log
    assert "Traceback" not in log


def test_faulty_configuration_refuses_to_start(tmp_path: Path) -> None:
    path = config(tmp_path)
    path.write_text(path.read_text().replace('format = "colornet"', 'format = "pdf"'))

    done = subprocess.run(
        [sys.executable, "-m", "paintlink", "run", "--config", str(path)],
        capture_output=True,
        text=True,
        check=False,
        timeout=30,
    )

    assert done.returncode == 2
    assert "pdf" in done.stderr
    assert "colornet" in done.stderr
