"""Spectra a second through `xrite_ma`, against bare pyserial in the same run.

Run ``python benchmarks/drivers.py``. Another process serves an unpaced pseudo-terminal
with ready-made answers, faster than any simulator. Bare pyserial sends the command for
a memory dump and reads as many bytes as it has; the driver does the same five times
for a reading, finds their ends, checks and converts them. Its rate counts from the
first dump command of a reading to its return: the 0.3 s of silence that end a report
before are the instrument's, not ours. Both take turns in blocks, so that load from
elsewhere meets both; the best block of each counts.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
import tty

import serial

from paintlink.instrument import Direction, Link, SerialSettings, load_driver
from paintlink.links import open_serial

BLOCKS, READINGS, DUMP_BYTES = 8, 10, 380
DUMPS = (
    *(b"207B2000i\r", b"20F7207Ci\r", b"217320F8i\r"),
    *(b"21EF2174i\r", b"226B21F0i\r"),
)


class DumpTime:
    """When the first dump of the reading was asked for."""

    start_s = 0.0

    def tap(self, direction: Direction, data: bytes) -> None:
        """Note what goes over the link."""
        if direction == "sent" and data == DUMPS[0]:
            self.start_s = time.perf_counter()


def through_the_driver(path: str) -> float:
    """Spectra a second."""
    stream, watch = open_serial(path, SerialSettings()), DumpTime()
    link = Link(stream, clock=time.monotonic, tap=watch.tap)
    driver = load_driver("xrite_ma").create(link, {})
    driver.identify()
    total_s = 0.0
    for _ in range(READINGS):
        driver.measure(lambda _sentence: None)
        total_s += time.perf_counter() - watch.start_s
    stream.close()
    return READINGS * len(DUMPS) / total_s


def bare(path: str) -> float:
    """Round trips a second with the same numbers of bytes."""
    with serial.Serial(path, timeout=5.0) as port:
        start_s = time.perf_counter()
        for _ in range(READINGS):
            for command in DUMPS:
                port.write(command)
                port.read(DUMP_BYTES)
        return READINGS * len(DUMPS) / (time.perf_counter() - start_s)


def serve() -> None:
    """Answer on a terminal until the terminal goes; each reading is another one."""
    near, far = os.openpty()
    tty.setraw(near)
    tty.setraw(far)
    print(os.ttyname(far), flush=True)
    answers = {
        b"v\r": b"X-RITE MA68II 3.02\r\n",
        b"ys\r": b"CALIBRATION OK\r\n",
        b"00A04Cw\r": b"OK\r\nPRESSED\r\n",
    }
    readings = [
        {command: dump(900 * number + place) for place, command in enumerate(DUMPS)}
        for number in range(2)
    ]
    while True:
        command = os.read(near, 64)
        if command == DUMPS[0]:
            readings.reverse()
        os.write(near, answers.get(command) or readings[0][command])


def dump(first: int) -> bytes:
    """A memory dump in the instrument's form."""
    data = b"".join((first + 977 * band).to_bytes(4, "little") for band in range(31))
    return f"{data.hex(' ').upper()} \r\n  OK\r\n".encode()


def main() -> None:
    """Print the rates and their ratio."""
    server = subprocess.Popen(
        [sys.executable, __file__, "serve"], stdout=subprocess.PIPE, text=True
    )
    assert server.stdout is not None  # noqa: S101
    path = server.stdout.readline().strip()
    rates = [(through_the_driver(path), bare(path)) for _ in range(BLOCKS)]
    server.kill()
    server.wait()
    driver, line = (max(column) for column in zip(*rates, strict=True))
    print(f"xrite_ma {driver:.0f} spectra/s; bare pyserial {line:.0f} round trips/s")
    print(f"ratio {driver / line:.2f}; {1e6 / driver - 1e6 / line:.0f} us a spectrum")


if __name__ == "__main__":
    serve() if sys.argv[1:] == ["serve"] else main()
