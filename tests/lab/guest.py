"""What runs inside the lab: every list on the real kernel, against the fakes."""

from __future__ import annotations

import sys
import time

from paintlink.conformance import Result, Subject, cases, rows, subjects
from paintlink.conformance import stands as fakes
from paintlink.conformance.exam import differences, examine_all
from tests.lab import stands
from tests.lab.bus import compare_usb

# Past identification, so that the fault meets the reading itself.
EXCHANGES = (2,)
BAYS_EACH = 4
COLUMNS = ("kernel", "ttyACM")


def main() -> int:
    """Print every table; 0 when the kernel gives what the fakes give."""
    start = time.monotonic()
    fakes.HURRY = 1.0  # an emulated processor is slow enough
    lines = compare_usb()
    results: list[Result] = []
    for driver, subject in subjects().items():
        seen, different = examined(subject)
        results += seen
        lines += different
        print(
            f"{driver}: {len(seen)} readings, {time.monotonic() - start:.0f} s",
            flush=True,
        )
    for row in [("driver", "fault", *COLUMNS), *rows(results, COLUMNS)]:
        print("{:10} {:22} {:9} {:9}".format(*row))
    lines += [f"{one.case}: {one.text}" for one in results if one.verdict == "failed"]
    print(
        f"{len(results)} readings through the kernel, {time.monotonic() - start:.0f} s"
    )
    for line in lines:
        print(f"DIFFERENCE {line}")
    print(f"differences between kernel and fakes: {len(lines)}")
    return int(bool(lines))


def examined(subject: Subject) -> tuple[list[Result], list[str]]:
    """Every fault through the kernel, and where memory gives another verdict."""
    kinds = {"kernel": stands.Bays(subject, stands.adapter, range(BAYS_EACH))}
    if subject.driver.INFO.usb is None:
        ports = range(BAYS_EACH, 2 * BAYS_EACH)
        kinds["ttyACM"] = stands.Bays(subject, stands.acm, ports)
    fakes.TRANSPORTS.update({name: bays.stand for name, bays in kinds.items()})
    try:
        asked = [
            (subject, case)
            for name in kinds
            for case in cases(subject, name, exchanges=EXCHANGES)
        ]
        seen = examine_all(asked, workers=2 * BAYS_EACH)
        return seen, differences(seen, subject)
    finally:
        for name, bays in kinds.items():
            bays.close()
            fakes.TRANSPORTS.pop(name)


if __name__ == "__main__":
    sys.exit(main())
