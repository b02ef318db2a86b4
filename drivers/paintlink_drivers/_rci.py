"""Questions and answers of the RCI dialect: docs/wire/xrite_rci.md."""

import contextlib
import re

from paintlink import errors, instrument
from paintlink.instrument import Link, complete, quoted

ANSWER_S, READ_S, POLL_S, POLLS = 2.0, 5.0, 0.2, 50
IDLE_S, TAIL_S, LIMIT_S = 0.2, 0.05, 5.0
END = instrument.up_to(rb"<[0-9A-Fa-f]{2}>")
SPECTRUM_SIZE, REFUSAL = 62, re.compile(rb"\s*<([0-9A-Fa-f]{2})>\s*")
BUSY, FULL, WORKING, TAKEN = 0x14, 0x37, 4, (6, 7)
MEANINGS = {
    **{0x11: "unknown command", 0x14: "busy", 0x20: "measurement failed"},
    **{0x27: "bad reading", 0x28: "not calibrated", 0x29: "calibration failed"},
    **{0x31: "lamp", FULL: "memory full", 0x3B: "battery low", 0x42: "no reading"},
}


class RciLine:
    """A link that speaks RCI.

    ``first_generation`` chooses the table of codes. ``uncalibrated`` turns true when
    the instrument refuses for want of a calibration.
    """

    def __init__(self, link: Link) -> None:
        self.link = link
        self.first_generation = False
        self.uncalibrated = False

    def pause(self) -> None:
        """Let the instrument work a while."""
        self.link.drain(POLL_S, LIMIT_S)

    def ask(self, command: str, timeout_s: float = ANSWER_S) -> str:
        """Return the data of the answer; a busy instrument is asked again.

        Raises
        ------
        NeedsCalibrationError, InstrumentError
            When the answer is an error, which is cleared.
        """
        for _ in range(POLLS):
            data, code = self.exchange(command, timeout_s)
            if code != BUSY or self.first_generation:
                break
            self.pause()
        self.require(code, command)
        return data

    def exchange(self, command: str, timeout_s: float) -> tuple[str, int]:
        """Return data and code of the answer, whatever the code is."""
        with complete(f"answer to {command}"):
            frame = self.link.request(f"{command}\r".encode(), END, timeout_s)
        return answer(frame, command)

    def require(self, code: int, command: str) -> None:
        """Clear an error and raise it; a status is none."""
        if code == 0 or (code < 5 and not self.first_generation):
            return
        with contextlib.suppress(errors.LinkTimeoutError, errors.ProtocolError):
            self.exchange("CE", ANSWER_S)
        first = self.first_generation
        wanting = code in ((0x12, 0x13, 0x17) if first else (0x28, 0x29, 0x45))
        self.uncalibrated = self.uncalibrated or wanting
        kind = errors.NeedsCalibrationError if wanting else errors.InstrumentError
        meaning = "" if first else MEANINGS.get(code, "")
        msg = f"the instrument answered {command} with error {code:02X} {meaning}"
        todo = "repeat it, and calibrate if it stays"
        if meaning == MEANINGS[FULL]:
            todo = "take over its readings with `paintlink measure --stored --clear`"
        raise kind(f"{msg.strip()}: {todo}", code=f"{code:02X}")

    def number(self, command: str) -> int:
        """Return the whole number that an answer begins with."""
        data = self.ask(command)
        found = re.match(r"\s*(\d{1,6})\b", data)
        if found is None:
            msg = f"the instrument answered {command} with {quoted(data)}, not a number"
            raise errors.ProtocolError(msg, raw=data.encode("latin-1"))
        return int(found[1])

    def serial_number(self) -> str:
        """Return it; empty when the instrument has no such answer."""
        with contextlib.suppress(errors.LinkTimeoutError, errors.InstrumentError):
            answer = self.ask("GI")
            found = re.search(r"^Serial Number:\s*(\S+)", answer, re.MULTILINE)
            return found[1] if found else ""
        return ""

    def await_idle(self) -> None:
        """Return once a DTP20 is no longer busy."""
        for _ in range(POLLS):
            self.pause()
            if self.number("CS") != WORKING:
                return

    def await_spot(self, timeout_s: float) -> None:
        """Return once a DTP20 has taken a reading that was not there before."""
        before = (self.number("CS"), self.number("00GM"))
        for _ in range(int(timeout_s / POLL_S)):
            self.pause()
            now = self.number("CS")
            if now in TAKEN and (now, self.number("00GM")) != before:
                return
        msg = "nobody pressed the button: press it once the instrument stands still"
        raise errors.LinkTimeoutError(msg)

    def await_press(self, button: tuple[str, str], timeout_s: float) -> None:
        """Return once the instrument has sent an answer that nobody asked for."""
        on, off = button
        self.ask(on)
        try:
            self.link.wait_for_data(timeout_s)
            frame = self.link.receive(END, ANSWER_S)
        finally:
            with contextlib.suppress(errors.LinkTimeoutError, errors.ProtocolError):
                self.exchange(off, ANSWER_S)
        self.require(answer(frame, "")[1], "the button")

    def spectrum(self, command: str) -> bytes:
        """Return the 62 bytes of a binary spectrum; nothing marks their end."""
        self.ask("0318CF")
        self.ask("011BCF")
        try:
            with complete("spectrum"):
                raw = self.link.request(
                    f"{command}\r".encode(), spectrum_size, READ_S, idle_s=IDLE_S
                )
            raw += self.link.drain(TAIL_S, LIMIT_S)
        finally:
            with contextlib.suppress(errors.LinkTimeoutError, errors.ProtocolError):
                self.exchange("001BCF", ANSWER_S)
        if len(raw) > SPECTRUM_SIZE:
            raw = raw.removeprefix(f"{command}\r".encode())
        if refused := REFUSAL.fullmatch(raw):
            self.require(int(refused[1], 16) & 0x7F, command)
        if len(raw) != SPECTRUM_SIZE:
            msg = f"the spectrum has {len(raw)} bytes, expected 62: measure again"
            raise errors.ProtocolError(msg, raw=raw)
        return raw


def answer(frame: bytes, command: str) -> tuple[str, int]:
    """Return data and code of a frame; an echo of the command is left out."""
    lines = frame[:-4].decode("latin-1").split("\r")
    lines = [line.strip("\n") for line in lines if line.strip()]
    if lines and lines[0].strip().upper() == command.upper():
        del lines[0]
    return "\n".join(lines), int(frame[-3:-1], 16) & 0x7F


def spectrum_size(buffer: bytes) -> int:
    """Return the size of a spectrum or, after a silence, of a refusal in its place."""
    if len(buffer) >= SPECTRUM_SIZE:
        return SPECTRUM_SIZE
    refused = buffer.endswith(b"\n") and REFUSAL.fullmatch(buffer)
    return len(buffer) if refused else 0
