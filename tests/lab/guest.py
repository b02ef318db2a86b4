"""What runs inside the lab: every list on the real kernel, against the fakes."""

from __future__ import annotations

import multiprocessing
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor

from paintlink.conformance import (
    Result,
    Subject,
    cases,
    differences,
    examine_all,
    failed,
    rows,
    subject,
    subjects,
)
from paintlink.conformance import stands as fakes
from paintlink_simulators.usb import FtdiFunction, engine
from tests.lab import stands
from tests.lab.bus import compare_usb

# Past identification, so that the fault meets the reading itself.
EXCHANGES = (2,)
COLUMNS = ("kernel", "ttyACM")
# Its own adapter or USB protocol is what each driver meets; CDC-ACM is shown on one.
BEHIND_ACM = {"km_cm512"}
# Two processes for two processors, each with half of the controller's ports.
SHIFTS = (("xrite_ma", "xrite_rci"), ("km_cm512", "chn_cr30"))
PORTS = (range(0, 4), range(4, 8))


def main() -> int:
    """Print every table; 0 when the kernel gives what the fakes give."""
    start = time.monotonic()
    lines = compare_usb()
    assert {one for shift in SHIFTS for one in shift} == set(subjects())
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(len(SHIFTS), context) as pool:
        shifts = list(pool.map(examined, SHIFTS, PORTS))
    results = [result for seen, _ in shifts for result in seen]
    lines += [line for _, different in shifts for line in different]
    for row in [("driver", "fault", *COLUMNS), *rows(results, COLUMNS)]:
        print("{:10} {:22} {:9} {:9}".format(*row))
    print(
        f"{len(results)} readings through the kernel, {time.monotonic() - start:.0f} s"
    )
    for line in lines:
        print(f"DIFFERENCE {line}")
    print(f"differences between kernel and fakes: {len(lines)}")
    return int(bool(lines))


def examined(drivers: Sequence[str], ports: range) -> tuple[list[Result], list[str]]:
    """Every fault through the kernel, and where memory gives another verdict."""
    fakes.HURRY = (
        1.0  # an emulated processor is slow enough, and spared where it can be
    )
    engine.TICK_S = 0.1
    FtdiFunction.LAZY_S = 0.2
    results: list[Result] = []
    lines: list[str] = []
    for driver in drivers:
        start = time.monotonic()
        seen, different = examined_one(subject(driver), ports)
        results += seen
        lines += different + failed(seen)
        print(
            f"{driver}: {len(seen)} readings, {time.monotonic() - start:.0f} s",
            *different,
            *failed(seen),
            sep="\n  ",
            flush=True,
        )
    return results, lines


def examined_one(found: Subject, ports: range) -> tuple[list[Result], list[str]]:
    """As `examined`, for one driver on its adapter and behind CDC-ACM."""
    half = len(ports) // 2
    acm = found.id in BEHIND_ACM
    adapters = ports[:half] if acm else ports
    kinds = {"kernel": stands.Bays(found, stands.adapter, adapters)}
    if acm:
        kinds["ttyACM"] = stands.Bays(found, stands.acm, ports[half:])
    fakes.TRANSPORTS.update({name: bays.stand for name, bays in kinds.items()})
    try:
        asked = [
            (found, case)
            for name in kinds
            for case in cases(found, name, exchanges=EXCHANGES)
        ]
        # Alternating, so that both kinds are busy to the end.
        asked.sort(key=lambda question: question[1].fault)
        seen = examine_all(asked, workers=len(ports))
        return seen, differences(seen, found)
    finally:
        for name, bays in kinds.items():
            bays.close()
            fakes.TRANSPORTS.pop(name)


if __name__ == "__main__":
    sys.exit(main())
