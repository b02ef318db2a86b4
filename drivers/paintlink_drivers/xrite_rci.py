"""X-Rite RCI, over USB and serial: docs/wire/xrite_rci.md. Never met real hardware."""

import contextlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from paintlink import errors, instrument, model
from paintlink.instrument import Link, Prompt, confirm, option, quoted
from paintlink_drivers import _rci
from paintlink_drivers._rci_models import MODELS

RESET_S, PING_S, CALIBRATION_S, MOST_KEPT = 0.5, 1.5, 10.0, 5
VALUE = re.compile(r"(?<![XYZ\d.])\d+\.\d+")
SET_UP = ("0008CF", "0005CF", "0207CF", "020ACF", "001ACF", "0716CF")


@dataclass(frozen=True, slots=True)
class Options:
    """What the operator may set."""

    model: str = option("auto", "model", choices=("auto", *MODELS))
    trigger: str = option("host", "starts a reading", choices=("host", "button"))
    press_timeout_s: float = option(300.0, "for the operator", minimum=1, maximum=3600)


INFO = instrument.DriverInfo(
    id="xrite_rci",
    maker="X-Rite",
    models={name: dialect.geometry for name, dialect in MODELS.items()},
    options=Options(),
    serial=instrument.SerialSettings(),
    hardware_tested=False,
    usb=instrument.UsbSettings(vendor_id=0x0765, product_id=0xD020),
)


def create(link: Link, options: Mapping[str, object]) -> instrument.Driver:
    """Return the driver; the transport makes no difference to it."""
    return Reader(link, instrument.parse_options(Options(), options))


class Reader:
    """Reads one solid colour; a single angle shows nothing of an effect."""

    def __init__(self, link: Link, options: Options) -> None:
        self._line = _rci.RciLine(link)
        self._options = options
        self._check = instrument.ReadingCheck()
        self._use(options.model)
        self._calibrated, self._kept_before = False, -1

    def identify(self) -> model.Instrument:
        """Return what the version text says, after a reset that clears the line."""
        for _ in range(2):
            self._line.link.send(b"0PR\r")
            self._line.link.drain(RESET_S, _rci.LIMIT_S)
        for command in ("", "CE"):
            with contextlib.suppress(errors.LinkTimeoutError, errors.ProtocolError):
                self._line.exchange(command, PING_S)
        self._line.link.drain(RESET_S, _rci.LIMIT_S)
        # A late answer to what was sent before has no text.
        version = self._line.ask("SV") or self._line.ask("SV")
        found = re.search(rf"\b({'|'.join(MODELS)})\b", version)
        if self._options.model == "auto" and not found:
            msg = f"no RCI instrument known by name: it answered {quoted(version)}"
            raise errors.WrongInstrumentError(msg, code=version)
        self._use(found[1] if found else self._options.model)
        if not self._dialect.read:
            for command in SET_UP:
                self._line.ask(command)
            if self._kept_before < 0:
                self._kept_before = self._line.number("00GM")
        firmware = (re.search(r"\d+\.\d+", version) or [""])[0]
        serial = self._line.serial_number()
        return model.Instrument(INFO.maker, self._name, serial, firmware)

    def calibration(self) -> model.CalibrationState:
        """Return what the last exchange told of it: there is no way to ask."""
        if self._line.uncalibrated:
            return "needed"
        return "valid" if self._calibrated else "unknown"

    def calibrate(self, prompt: Prompt) -> None:
        """Calibrate on the white plaque, and on black where the model wants it."""
        plaque = "" if self._dialect.read else f" Its number: {self._line.ask('04SN')}."
        for command, sentence in self._dialect.calibrate.items():
            confirm(prompt, sentence + plaque)
            self._line.ask(command, CALIBRATION_S)
        if not self._dialect.read:
            self._line.await_idle()
        self._calibrated, self._line.uncalibrated = True, False

    def measure(self, prompt: Prompt) -> model.Measurement:
        """Return one reading, started by us or by the button."""
        if self._name == "auto":
            self.identify()
        self._make_room()
        if self._options.trigger == "host":
            confirm(prompt, "Set the instrument on the panel and hold it still.")
            self._line.ask("RM", _rci.READ_S)
        else:
            prompt("Set the instrument on the panel and press its button.")
            wait_s = self._options.press_timeout_s
            if self._dialect.read:
                self._line.await_press(self._dialect.button, wait_s)
            else:
                self._line.await_spot(wait_s)
        self._calibrated, self._line.uncalibrated = True, False
        return self._read("01GM", self._check)

    def stored(self) -> Iterator[model.Measurement]:
        """Yield the readings a DTP20 keeps."""
        count = 0 if self._dialect.read else self._line.number("00GM")
        for number in range(1, count + 1):
            reading = self._read(f"{number:03d}01GM", instrument.ReadingCheck())
            yield replace(reading, record=f"stored {number}")

    def clear(self) -> None:
        """Delete the readings a DTP20 keeps."""
        if not self._dialect.read:
            self._line.ask("02CD")
            self._line.await_idle()
            self._kept_before = 0

    def _make_room(self) -> None:
        """Clear a DTP20's memory where it holds nothing but what we have read."""
        if self._kept_before == 0 and self._line.number("00GM") >= MOST_KEPT:
            self.clear()

    def _use(self, name: str) -> None:
        self._name = name
        self._dialect = MODELS.get(name, MODELS["DTP20"])
        self._line.first_generation = self._dialect.first_generation

    def _read(self, command: str, check: instrument.ReadingCheck) -> model.Measurement:
        if self._dialect.read:
            text = [self._line.ask(c, _rci.READ_S) for c in self._dialect.read][-1]
            raw = text.encode("latin-1")
            if not self._dialect.form.fullmatch(text):
                msg = "the spectrum is not 31 numbers: measure again"
                raise errors.ProtocolError(msg, raw=raw)
            factors = np.array(VALUE.findall(text)[-31:], dtype=np.float64) / 100.0
        else:
            raw = self._line.spectrum(command)
            factors = np.frombuffer(raw, ">u2") * (2.0 / 65535.0)
        geometry = self._dialect.geometry
        return check.admit(geometry, instrument.BANDS_NM, factors[None], raw)
