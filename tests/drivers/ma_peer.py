"""Golden data of docs/wire/xrite_ma.md, and a peer that answers with it."""

import struct
from collections.abc import Callable, Mapping

import numpy as np

from paintlink.instrument import Driver, Link, load_driver
from paintlink.model import Measurement

Speech = bytes | tuple[bytes | float, ...]

# docs/wire/xrite_ma.md, section 7: n(i) = 1185 + 977 i.
GOLDEN_HEX = (
    "A104000072080000430C000014100000E5130000B6170000871B0000581F0000"
    "29230000FA260000CB2A00009C2E00006D3200003E3600000F3A0000E03D0000"
    "B14100008245000053490000244D0000F5500000C654000097580000685C0000"
    "396000000A640000DB670000AC6B00007D6F00004E7300001F770000"
)
# Reflectance factors of `golden_answers`, shape (5, 31).
GOLDEN = (1185 + 977 * np.arange(31) + 100 * np.arange(5)[:, None]) / 32768
DUMP_COMMANDS = (
    *(b"207B2000i\r", b"20F7207Ci\r", b"217320F8i\r"),
    *(b"21EF2174i\r", b"226B21F0i\r"),
)


def dump_text(digits: str, grouping: int = 0) -> bytes:
    """Return a dump as section 4 of the wire page prints it."""
    pairs = [digits[place : place + 2] for place in range(0, len(digits), 2)]
    text = ""
    for count, pair in enumerate(pairs, start=1):
        text += f"{pair} "
        if grouping and count % grouping == 0:
            text += " "
    text += "\r\n"
    return (text + " " * (380 - 4 - len(text)) + "OK\r\n").encode()


def shifted_hex(shift: int) -> str:
    """Return the golden integers, each larger by ``shift``, as hexadecimal digits."""
    return struct.pack("<31i", *(1185 + 977 * i + shift for i in range(31))).hex()


def report_text(percent: Callable[[int, int], float], rows: int = 36) -> bytes:
    """Return a report of section 5: sample values in the even tokens."""
    angles = (15, 25, 45, 75, 110)
    lines = ["MA68II REPORT"]
    for wavelength in range(400, 701, 10):
        pairs = (f"99.00 {percent(k, wavelength):.2f}" for k in range(5))
        lines.append(f"{wavelength} {' '.join(pairs)}")
    lines += [f"{angle} 50.00 1.00 -2.00 2.24 296.57" for angle in angles]
    return "".join(f"{line}\r\n" for line in lines[: rows + 1]).encode()


def golden_answers(model: str = "MA68II", grouping: int = 0) -> dict[bytes, bytes]:
    """Return the transcript of section 7; the k-th angle is shifted by 100 k."""
    dumps = [GOLDEN_HEX, *(shifted_hex(100 * k) for k in range(1, 5))]
    texts = [dump_text(digits, grouping) for digits in dumps]
    return {
        b"v\r": f"X-RITE {model} 3.02\r\n".encode(),
        b"ys\r": b"CALIBRATION OK\r\n",
        b"00A04Cw\r": b"OK\r\n",
        **dict(zip(DUMP_COMMANDS, texts, strict=True)),
    }


def golden_report() -> bytes:
    return report_text(lambda k, wavelength: 10 * k + wavelength / 100)


class Peer:
    """Gives fixed answers to fixed commands, in pieces of chosen sizes.

    An answer is bytes, or a tuple of bytes and of seconds of silence between them. The
    clock moves in silence only. A press adds the report to what is sent.
    """

    def __init__(
        self,
        answers: Mapping[bytes, Speech],
        *,
        report: Speech = b"",
        cuts: tuple[int, ...] = (4096,),
        echo: bool = False,
    ) -> None:
        self.answers = dict(answers)
        self.report = report
        self.cuts = cuts
        self.echo = echo
        self.sent: list[bytes] = []
        self.sentences: list[str] = []
        self.now_s = 0.0
        self._queue: list[bytes | float] = []

    def clock(self) -> float:
        return self.now_s

    def say(self, speech: Speech) -> None:
        pieces = speech if isinstance(speech, tuple) else (speech,)
        self._queue += [piece for piece in pieces if piece]

    def press(self, sentence: str) -> None:
        self.sentences.append(sentence)
        self.say(self.report)

    def write(self, data: bytes) -> None:
        self.sent.append(data)
        self.say(data + b"\n" if self.echo else b"")
        self.say(self.answers.get(data, b""))

    def read(self, timeout_s: float) -> bytes:
        head = self._queue.pop(0) if self._queue else timeout_s
        if isinstance(head, bytes):
            size = self.cuts[len(head) % len(self.cuts)]
            self._queue[:0] = [head[size:]] if head[size:] else []
            return head[:size]
        wait_s = min(head, timeout_s)
        self.now_s += wait_s
        self._queue[:0] = [head - wait_s] if head - wait_s > 1e-9 else []
        return b""

    def close(self) -> None:
        self._queue.clear()


def connect(peer: Peer, options: Mapping[str, object] | None = None, **link) -> Driver:
    """Return the driver on a link to the peer."""
    line = Link(peer, clock=peer.clock, **link)
    return load_driver("xrite_ma").create(line, options or {})


def measured(peer: Peer, **link) -> Measurement:
    """Return the reading of one press."""
    return connect(peer, **link).measure(peer.press)
