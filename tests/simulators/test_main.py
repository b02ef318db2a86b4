"""``python -m paintlink_simulators``, as a person runs it."""

from __future__ import annotations

import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import serial

from paintlink.errors import InputError
from paintlink.instrument import Link, load_driver
from paintlink.links import open_link
from paintlink_simulators.__main__ import panel_from_file

COMMAND = (sys.executable, "-m", "paintlink_simulators")


@contextmanager
def running(*arguments: str) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(
        [*COMMAND, *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        bufsize=1,
    ) as process:
        try:
            yield process
        finally:
            process.kill()


def first_line(process: subprocess.Popen[str]) -> str:
    assert process.stdout is not None
    return process.stdout.readline().strip()


def type_keys(process: subprocess.Popen[str], keys: str) -> None:
    assert process.stdin is not None
    process.stdin.write(keys)


def test_terminal_is_operated_by_keys(
    terminal: Callable[[str], Any], tmp_path: Path
) -> None:
    link = tmp_path / "ma68"
    with running("xrite_ma", "--pty", "--link", str(link)) as process:
        assert Path(first_line(process)) == link.readlink()
        client = terminal(str(link))
        client.write(b"yw\r")
        client.write(b"v\r")
        assert client.read_lines(1) == [b"X-RITE MA68II 3.02"]

        type_keys(process, "w\n")
        assert client.read_lines(1) == [b"OK"]
        type_keys(process, "\n")
        assert client.read_lines(37)[-1].startswith(b"110 ")
        type_keys(process, "q\n")

        assert process.wait(10.0) == 0
    assert not link.is_symlink()


def test_tcp_serves_the_chosen_model() -> None:
    with running("xrite_ma", "--tcp", "0", "--model", "MA58") as process:
        host, _, port = first_line(process).removeprefix("socket://").partition(":")
        with socket.create_connection((host, int(port)), timeout=10.0) as client:
            client.sendall(b"v\r")

            assert client.recv(100) == b"X-RITE MA58 3.02\r\n"


def test_usbip_serves_an_instrument_that_a_driver_reads() -> None:
    with running("xrite_rci", "--usbip", "0") as process:
        address = first_line(process)
        info = load_driver("xrite_rci").INFO

        stream = open_link(address, info.serial, info.usb)
        driver = load_driver("xrite_rci").create(Link(stream, clock=time.monotonic), {})

        assert driver.identify().serial == "SIM00001"
        stream.close()


def test_rfc2217_takes_the_settings_of_a_client() -> None:
    with running("xrite_ma", "--rfc2217", "0", "--baud", "4800") as process:
        address = first_line(process)
        with serial.serial_for_url(address, baudrate=4800, timeout=5.0) as right:
            right.write(b"v\r")
            assert right.read_until(b"\n") == b"X-RITE MA68II 3.02\r\n"
        with serial.serial_for_url(address, baudrate=19200, timeout=0.5) as wrong:
            wrong.write(b"v\r")
            assert b"X-RITE" not in wrong.read(100)


def test_terminal_at_the_wrong_rate_gives_garbage(tmp_path: Path) -> None:
    link = tmp_path / "ma68"
    arguments = ("--pty", "--link", str(link), "--baud", "9600")
    with running("xrite_ma", *arguments) as process:
        first_line(process)
        with serial.Serial(str(link), 9600, timeout=5.0) as right:
            right.write(b"v\r")
            assert right.read_until(b"\n") == b"X-RITE MA68II 3.02\r\n"
        with serial.Serial(str(link), 38400, timeout=0.5) as wrong:
            wrong.write(b"v\r")
            assert b"X-RITE" not in wrong.read(100)


def test_fault_and_state_come_from_the_command_line() -> None:
    arguments = ("--tcp", "0", "--fault", "truncate@1", "--state", "low_battery")
    with running("xrite_ma", *arguments) as process:
        host, _, port = first_line(process).removeprefix("socket://").partition(":")
        with socket.create_connection((host, int(port)), timeout=10.0) as client:
            client.sendall(b"00A04Cw\r")
            assert client.recv(100) == b"BATTERY LOW\r\n"
            client.sendall(b"v\r")
            assert client.recv(100) == b"X-RITE "


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["xrite_ma9"], 3, "there is no simulated instrument 'xrite_ma9'"),
        (["xrite_ma", "--paint", "BM3044"], 3, "no paint 'BM3044': did you mean "),
        (["faults"], 3, "there is no simulated instrument 'faults'"),
        (["xrite_ma", "--model", "MA96"], 2, "model = 'MA96' is not one of 'MA58'"),
        (["xrite_ma", "--fault", "rain"], 2, "'rain' is no fault: choose NAME"),
        (["xrite_ma", "--fault", "late@x"], 2, "'late@x' is no fault"),
        (["xrite_ma", "--lab-file", "absent.txt"], 3, "absent.txt cannot be read"),
    ],
)
def test_wrong_call_says_what_is_wrong(
    arguments: list[str], code: int, message: str
) -> None:
    ended = subprocess.run(
        [*COMMAND, *arguments, "--pty"],
        capture_output=True,
        text=True,
        timeout=30.0,
        check=False,
    )

    assert ended.returncode == code
    assert message in ended.stderr
    assert "Traceback" not in ended.stderr


def test_lab_file_makes_a_panel(tmp_path: Path) -> None:
    file = tmp_path / "gold.txt"
    file.write_text("45 60 5 30\n15 110 4 40\n")

    panel = panel_from_file(file)

    assert panel.aspecular_deg.tolist() == [15.0, 45.0]
    assert panel.name == "gold"


def test_wrong_lab_line_is_named(tmp_path: Path) -> None:
    file = tmp_path / "gold.txt"
    file.write_text("15 110 4 40\n45 60 5\n")

    with pytest.raises(InputError, match="line 2: expected angle, L, a and b, found"):
        panel_from_file(file)
