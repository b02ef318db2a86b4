"""One simulated instrument by hand: ``paintlink simulate xrite_ma --pty``.

Enter presses the instrument, ``w`` and Enter presses it on its white plaque, ``q`` and
Enter ends.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType
from typing import Protocol

import numpy as np

from paintlink.errors import InputError, PaintlinkError
from paintlink_simulators._simulator import Simulator
from paintlink_simulators._uart import LineSettings
from paintlink_simulators.faults import FAULTS, STATES, Fault, from_answer
from paintlink_simulators.paint import (
    Panel,
    SprayBooth,
    formula_of,
    panel_from_lab,
)
from paintlink_simulators.ports import PtyPort, TcpPort, UsbIpPort
from paintlink_simulators.usb import UsbSocket

NETWORK = {
    "tcp": "at a TCP port as a plain serial server; 0: the system chooses",
    "rfc2217": "at a TCP port as a serial server that takes settings",
    "usbip": "at a TCP port as a USB device by USB/IP",
}

PAINT = "BM304"


class Port(Protocol):
    """Where the instrument is: it can be pressed there, and put away."""

    def press(self) -> None:
        """Press the instrument down."""

    def close(self) -> None:
        """Put it away."""


def main() -> int:
    """Serve until the operator ends; returns the exit code."""
    options = _parser().parse_args()
    try:
        simulator, module = _simulator(options)
    except PaintlinkError as fault:
        sys.stderr.write(f"{fault}\n")
        return fault.exit_code
    with contextlib.ExitStack() as opened:
        port, address = _port(simulator, module, options, opened)
        _say(address)
        _operate(port, simulator, sys.stdin)
    return 0


def panel_from_file(path: Path) -> Panel:
    """The panel whose file has one line an angle: aspecular angle, L, a and b.

    Raises
    ------
    InputError
        When it cannot be read or a line holds anything else.
    """
    try:
        lines = path.read_text("utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as fault:
        msg = f"{path} cannot be read: {fault}"
        raise InputError(msg) from fault
    rows = [_angle_and_lab(path, *numbered) for numbered in enumerate(lines, start=1)]
    table = np.array(sorted(rows)).reshape(-1, 4)
    return panel_from_lab(table[:, 0], table[:, 1:], path.stem)


def _angle_and_lab(path: Path, number: int, line: str) -> list[float]:
    try:
        angle, lightness, a, b = map(float, line.split())
    except ValueError as fault:
        msg = f"{path}, line {number}: expected angle, L, a and b, found {line!r}"
        raise InputError(msg) from fault
    return [angle, lightness, a, b]


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="paintlink simulate",
        description="A simulated instrument to talk to.",
        epilog=f"Enter presses it, w and Enter presses it on its plaque, q ends. "
        f"Faults: {', '.join(FAULTS)}. States: {', '.join(STATES)}.",
    )
    parser.add_argument("instrument", help="driver id, for example xrite_ma")
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--pty", action="store_true", help="at a pseudo-terminal")
    for name, what in NETWORK.items():
        where.add_argument(f"--{name}", type=int, metavar="PORT", help=what)
    parser.add_argument("--link", type=Path, help="symbolic link to the terminal")
    parser.add_argument("--baud", type=int, help="rate of its line: pace, and garbage")
    parser.add_argument("--model", help="one of the instrument's models")
    parser.add_argument(
        "--paint", default=PAINT, help="code of the bundled library (default BM304)"
    )
    parser.add_argument("--lab-file", type=Path, help="lines of: angle L a b (D65/10)")
    parser.add_argument("--seed", type=int, default=0, help="of noise and faults")
    parser.add_argument(
        "--fault",
        metavar="NAME[@N]",
        type=_fault,
        help="what goes wrong on the line, after N answers (0 if left out)",
    )
    parser.add_argument("--state", choices=STATES, help="state of the device")
    return parser


def _fault(text: str) -> Fault:
    name, _, answers = text.partition("@")
    if name not in FAULTS or not (answers or "0").isdigit():
        msg = f"{text!r} is no fault: choose NAME or NAME@N of {', '.join(FAULTS)}"
        raise argparse.ArgumentTypeError(msg)
    return from_answer(int(answers or 0), FAULTS[name])


def _simulator(options: argparse.Namespace) -> tuple[Simulator, ModuleType]:
    try:
        module = importlib.import_module(f"paintlink_simulators.{options.instrument}")
        create = module.create
    except (ImportError, AttributeError) as fault:
        msg = f"there is no simulated instrument {options.instrument!r}"
        raise InputError(msg) from fault
    panel = _panel(options)
    chosen = {"model": options.model} if options.model else {}
    state = STATES[options.state] if options.state else {}
    simulator: Simulator = create(
        panel, clock=time.monotonic, seed=options.seed, **chosen, **state
    )
    if options.fault:
        simulator = options.fault(simulator, options.seed)
    return simulator, module


def _panel(options: argparse.Namespace) -> Panel:
    if options.lab_file:
        return panel_from_file(options.lab_file)
    booth = SprayBooth(seed=options.seed)
    return booth.spray(formula_of(options.paint), options.paint)


def _port(
    simulator: Simulator,
    module: ModuleType,
    options: argparse.Namespace,
    opened: contextlib.ExitStack,
) -> tuple[Port, str]:
    """The port and its address, closed with ``opened``."""
    line = LineSettings(options.baud) if options.baud else None
    if options.usbip is not None:
        device = UsbSocket(module.usb_function(simulator))
        opened.callback(device.close)
        server = opened.enter_context(UsbIpPort([device], port=options.usbip))
        return device, server.url()
    if options.pty:
        pty = PtyPort(simulator, link=options.link, baud=options.baud, line=line)
        return opened.enter_context(pty), pty.path
    kind: type[TcpPort] = TcpPort if options.rfc2217 is None else _rfc2217()
    number = options.tcp if options.rfc2217 is None else options.rfc2217
    tcp = kind(simulator, port=number, baud=options.baud, line=line)
    return opened.enter_context(tcp), tcp.url


def _rfc2217() -> type[TcpPort]:
    from paintlink_simulators import Rfc2217Port

    return Rfc2217Port


def _operate(port: Port, simulator: Simulator, keys: Iterable[str]) -> None:
    for key in keys:
        if key.strip() == "q":
            return
        simulator.plate_on = key.strip() == "w"
        port.press()


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
