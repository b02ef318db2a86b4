"""Serve simulated instruments on pseudo-terminals until standard input ends.

A program of its own, so that the simulators cost the service nothing. Prints the paths
as one JSON object, name to path.
"""

from __future__ import annotations

import json
import sys

from paintlink_simulators import PtyPort
from tests.daemon.instrument_bench import simulator

KINDS = ("chn_cr30", "km_cm512", "xrite_ma", "xrite_rci")
SPEED = 20.0


def main() -> None:
    """Serve two instruments of each kind."""
    ports = {
        f"{kind} {number}": PtyPort(
            simulator(kind, seed=number, speed=SPEED), auto_press_after_s=0.02
        )
        for kind in KINDS
        for number in (1, 2)
    }
    print(json.dumps({name: port.path for name, port in ports.items()}), flush=True)  # noqa: T201
    sys.stdin.read()
    for port in ports.values():
        port.close()


if __name__ == "__main__":
    main()
