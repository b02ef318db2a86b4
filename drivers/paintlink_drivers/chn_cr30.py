"""CHNSpec CR30: docs/wire/chn_cr30.md. This project never met the hardware."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from paintlink import errors, instrument, model
from paintlink.instrument import Link, Prompt, confirm, option
from paintlink_drivers._cr30_frames import TRIGGER, exchange, receive

ID, FIRMWARE = b"\xaa\x0a\x00", b"\xaa\x0a\x02"
CALIBRATION = {
    b"\xbb\x10\x00": "Hold the instrument into the air, away from any light.",
    b"\xbb\x11\x00": "Set the instrument on its white tile.",
}
HEADER = b"\xbb\x01\x09"
HEADS = (b"\xbb\x01\x10", b"\xbb\x01\x11", b"\xbb\x01\x12")
AXIS = bytes([400 // 10, 31, 10])
IDENTITY_S, TRIGGER_S, FETCH_S, CALIBRATION_S = 1.0, 3.0, 1.0, 5.0
MOST_FRAMES = 12
# A solid colour reflects no more than the perfect diffuser: its white is spoiled.
BRIGHTEST = 1.05
GEOMETRY = (instrument.parse_geometry("45as45"),)


@dataclass(frozen=True, slots=True)
class Options:
    """What the operator may set."""

    trigger: str = option("host", "who starts a reading", choices=("host", "button"))
    press_timeout_s: float = option(300.0, "for the operator", minimum=1, maximum=3600)


INFO = instrument.DriverInfo(
    id="chn_cr30",
    maker="CHNSpec",
    models={"CR30": GEOMETRY},
    options=Options(),
    serial=instrument.SerialSettings(baudrate=115200),
    hardware_tested=False,
)


def create(link: Link, options: Mapping[str, object]) -> instrument.Driver:
    """Return the driver."""
    return Reader(link, instrument.parse_options(Options(), options))


class Reader:
    """Reads one solid colour; a single angle shows nothing of an effect."""

    def __init__(self, link: Link, options: Options) -> None:
        self._link = link
        self._options = options
        self._check = instrument.ReadingCheck()

    def identify(self) -> model.Instrument:
        """Return the serial number and firmware; only the model proves a CR30."""
        self._link.discard()
        first = exchange(self._link, ID, IDENTITY_S)
        name = text(first, 39, 55)
        if name != "CR30":
            msg = f"not a CR30: it calls itself {instrument.quoted(name)}"
            raise errors.WrongInstrumentError(msg, code=name)
        firmware = text(exchange(self._link, FIRMWARE, IDENTITY_S), 29, 55)
        return model.Instrument(INFO.maker, name, text(first, 9, 39), firmware)

    def calibration(self) -> model.CalibrationState:
        """Return ``unknown``: the instrument has no way to say it."""
        return "unknown"

    def calibrate(self, prompt: Prompt) -> None:
        """Write the black and the white reference anew."""
        for head, sentence in CALIBRATION.items():
            confirm(prompt, sentence)
            self._link.discard()
            if exchange(self._link, head, CALIBRATION_S)[6] != 1:
                msg = "the instrument did not confirm the calibration: repeat it"
                raise errors.InstrumentError(msg, code=head.hex())

    def measure(self, prompt: Prompt) -> model.Measurement:
        """Return one reading, started by us or by its button."""
        if self._options.trigger == "button":
            self._link.discard()
            prompt("Set the instrument on the panel and press its button.")
            self._link.wait_for_data(self._options.press_timeout_s)
            header = receive(self._link, FETCH_S, HEADER)
        else:
            confirm(prompt, "Set the instrument on the panel and hold it still.")
            self._link.discard()
            exchange(self._link, TRIGGER, TRIGGER_S)
            header = exchange(self._link, HEADER, FETCH_S)
        check_header(header)
        chunks = self._fetch()
        raw = b"".join((header, *chunks))
        bands = chunks[0][6:54] + chunks[1][6:54] + chunks[2][6:34]
        factors = np.frombuffer(bands, "<f4").astype(np.float64) / 100.0
        reading = self._check.admit(GEOMETRY, instrument.BANDS_NM, factors[None], raw)
        if factors.max() > BRIGHTEST:
            msg = "brighter than white: calibrate the instrument on its white tile"
            raise errors.NeedsCalibrationError(msg)
        return reading

    def _fetch(self) -> list[bytes]:
        """The chunks of one reading; a press meanwhile makes another one."""
        chunks: list[bytes] = []
        for _ in range(MOST_FRAMES):
            frame = exchange(self._link, HEADS[len(chunks)], FETCH_S, HEADER)
            if frame[:3] == HEADER:
                check_header(frame)
                chunks.clear()
            else:
                chunks.append(frame)
            if len(chunks) == len(HEADS):
                return chunks
        msg = "the button was pressed again and again: press it once a reading"
        raise errors.InstrumentError(msg)


def check_header(frame: bytes) -> None:
    """Refuse a header with another wavelength axis or with the cap on."""
    if frame[4:7] != AXIS:
        msg = "the reading has another wavelength axis: measure again"
        raise errors.ProtocolError(msg, raw=frame)
    if frame[24] == 1:
        msg = "the magnetic cap is on: take it off, calibrate, and measure again"
        raise errors.InstrumentError(msg, code="cap")


def text(frame: bytes, start: int, stop: int) -> str:
    """Return the characters of a field up to its NUL."""
    return frame[start:stop].split(b"\0", 1)[0].decode("latin-1").strip()
