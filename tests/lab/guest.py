"""What runs inside the lab: every list on the real kernel, against the fakes."""

from __future__ import annotations

import sys
import time

from paintlink.conformance import (
    Case,
    Result,
    Subject,
    cases,
    differences,
    examine,
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
from tests.lab.lines import compare_lines
from tests.lab.rules import compare_rules

# Past identification, so that the fault meets the reading itself.
EXCHANGES = (2,)
COLUMNS = ("kernel", "ttyACM")
# Its own adapter or USB protocol is what each driver meets; CDC-ACM is shown on one.
BEHIND_ACM = {"km_cm512"}
BAYS = 4  # of eight ports the controller has


def main() -> int:
    """Print every table, for the drivers named or for all; 0 without differences."""
    # An emulated processor is slow enough, and spared where that changes nothing.
    fakes.HURRY = 1.0
    engine.TICK_S = 1.0
    FtdiFunction.LAZY_S = 2.0
    start = time.monotonic()
    chosen = sys.argv[1:] or list(subjects())
    for driver in chosen:
        _warm_up(subject(driver))
    lines = compare_usb() + compare_rules() + compare_lines()
    results: list[Result] = []
    for driver in chosen:
        seen, different = examined(driver)
        results += seen
        lines += different
    for row in [("driver", "fault", *COLUMNS), *rows(results, COLUMNS)]:
        print("{:10} {:22} {:9} {:9}".format(*row))
    print(
        f"{len(results)} readings through the kernel, {time.monotonic() - start:.0f} s"
    )
    for line in lines:
        print(f"DIFFERENCE {line}")
    print(f"differences between kernel and fakes: {len(lines)}")
    return int(bool(lines))


def _warm_up(found: Subject) -> None:
    """Read everything from the host's disk that an examination needs.

    While the guest waits for it nothing runs, so that its time jumps ahead.
    """
    differences([Result(case, "failed") for case in _cases(found, "kernel")], found)


def _cases(found: Subject, transport: str) -> list[Case]:
    return [*cases(found, transport, exchanges=EXCHANGES)]


def examined(driver: str) -> tuple[list[Result], list[str]]:
    """Every fault through the kernel, and where memory gives another verdict."""
    start = time.monotonic()
    found = subject(driver)
    seen, lines = examined_one(found)
    lines += failed(seen)
    took_s = time.monotonic() - start
    print(f"{driver}: {len(seen)} readings, {took_s:.0f} s", *lines, sep="\n  ")
    sys.stdout.flush()
    return seen, lines


def examined_one(found: Subject) -> tuple[list[Result], list[str]]:
    """As `examined`, for one driver on its adapter and behind CDC-ACM."""
    kinds = {"kernel": stands.Bays(found, stands.adapter, range(BAYS))}
    if found.id in BEHIND_ACM:
        kinds["ttyACM"] = stands.Bays(found, stands.acm, range(BAYS, 2 * BAYS))
    fakes.TRANSPORTS.update({name: bays.stand for name, bays in kinds.items()})
    try:
        asked = [(found, case) for name in kinds for case in _cases(found, name)]
        # Alternating, so that both kinds are busy to the end.
        asked.sort(key=lambda question: question[1].fault)
        seen = examine_all(asked, workers=BAYS * len(kinds))
        seen = [_once_more(found, one) for one in seen]
        return seen, differences(seen, found)
    finally:
        for name, bays in kinds.items():
            bays.close()
            fakes.TRANSPORTS.pop(name)


def _once_more(found: Subject, result: Result) -> Result:
    """The result; where memory gives another one, that of asking again, alone.

    An emulated processor on a busy machine stands still for seconds at times.
    """
    if not differences([result], found):
        return result
    print(f"  asked again: {result.case}: {result.verdict} {result.text}", flush=True)
    return examine(found, result.case)


if __name__ == "__main__":
    sys.exit(main())
