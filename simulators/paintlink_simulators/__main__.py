"""One simulated instrument by hand: ``python -m paintlink_simulators xrite_ma --pty``.

Enter presses the instrument, ``w`` and Enter presses it on its white plaque, ``q`` and
Enter ends.
"""

from __future__ import annotations

import argparse
import importlib
import sys
import time
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from paintlink.errors import InputError, PaintlinkError
from paintlink_simulators._simulator import Simulator
from paintlink_simulators.paint import (
    Panel,
    SprayBooth,
    formula_of,
    panel_from_lab,
)
from paintlink_simulators.ports import PtyPort, TcpPort

PAINT = "BM304"


def main() -> int:
    """Serve until the operator ends; returns the exit code."""
    options = _parser().parse_args()
    try:
        simulator = _simulator(options)
    except PaintlinkError as fault:
        sys.stderr.write(f"{fault}\n")
        return fault.exit_code
    with _port(simulator, options) as port:
        _say(port.url if isinstance(port, TcpPort) else port.path)
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
        prog="python -m paintlink_simulators",
        description="A simulated instrument to talk to.",
        epilog="Enter presses it, w and Enter presses it on its plaque, q ends.",
    )
    parser.add_argument("instrument", help="driver id, for example xrite_ma")
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--pty", action="store_true", help="at a pseudo-terminal")
    where.add_argument("--tcp", type=int, metavar="PORT", help="0: the system chooses")
    parser.add_argument("--link", type=Path, help="symbolic link to the terminal")
    parser.add_argument("--baud", type=int, help="pace of the answers")
    parser.add_argument("--model", help="one of the instrument's models")
    parser.add_argument(
        "--paint", default=PAINT, help="code of the bundled library (default BM304)"
    )
    parser.add_argument("--lab-file", type=Path, help="lines of: angle L a b (D65/10)")
    parser.add_argument("--seed", type=int, default=0, help="of the noise")
    return parser


def _simulator(options: argparse.Namespace) -> Simulator:
    try:
        module = importlib.import_module(f"paintlink_simulators.{options.instrument}")
        create = module.create
    except (ImportError, AttributeError) as fault:
        msg = f"there is no simulated instrument {options.instrument!r}"
        raise InputError(msg) from fault
    panel = _panel(options)
    chosen = {"model": options.model} if options.model else {}
    simulator: Simulator = create(
        panel, clock=time.monotonic, seed=options.seed, **chosen
    )
    return simulator


def _panel(options: argparse.Namespace) -> Panel:
    if options.lab_file:
        return panel_from_file(options.lab_file)
    booth = SprayBooth(seed=options.seed)
    return booth.spray(formula_of(options.paint), options.paint)


def _port(simulator: Simulator, options: argparse.Namespace) -> PtyPort | TcpPort:
    if options.tcp is None:
        return PtyPort(simulator, link=options.link, baud=options.baud)
    return TcpPort(simulator, port=options.tcp, baud=options.baud)


def _operate(
    port: PtyPort | TcpPort, simulator: Simulator, keys: Iterable[str]
) -> None:
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
