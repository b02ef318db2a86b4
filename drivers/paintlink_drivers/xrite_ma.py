"""X-Rite MA58, MA68, MA68II: docs/wire/xrite_ma.md. Never met real hardware."""

import contextlib
import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from paintlink import errors, instrument, model
from paintlink.instrument import Link, Prompt, ask, complete, option, quoted, up_to

THREE = tuple(instrument.parse_geometry(f"45as{angle}") for angle in (25, 45, 75))
FIVE = tuple(instrument.parse_geometry(f"45as{a}") for a in (15, 25, 45, 75, 110))
IDENTITY_TRIES, LINE_IDLE_S, REPORT_IDLE_S = 3, 0.2, 0.3
DUMP_S, REPORT_S, WHITE_S, WHITE_MORE_S = 5.0, 30.0, 120.0, 5.0
IDENTITY = r"X-RITE.*(MA58|MA68II|MA68)\D*(\d+\.\d+)?"
DUMP_END = up_to(rb"OK[ \t]*(?:\r\n|[\r\n])")
REPORT_END = up_to(rb"(?:\A|[\r\n])[ \t]*110[ \t][^\r\n]*(?:\r\n|[\r\n])")
PRESS = "Set the instrument on the panel and press it down."
NEEDED = "the instrument is not calibrated: calibrate it on its white plaque first"


@dataclass(frozen=True, slots=True)
class Options:
    """What the operator may set."""

    mode: str = option("memory", "source of readings", choices=("memory", "listen"))
    model: str = option("MA68II", "model to listen to", choices=("MA68", "MA68II"))
    serial: str = option("", "serial number: the instrument does not tell it")
    press_timeout_s: float = option(300.0, "for the operator", minimum=1, maximum=3600)
    sample_columns: tuple[int, ...] = option((2, 4, 6, 8, 10), "in reports", minimum=1)


INFO = instrument.DriverInfo(
    id="xrite_ma",
    maker="X-Rite",
    models={"MA58": THREE, "MA68": FIVE, "MA68II": FIVE},
    options=Options(),
    serial=instrument.SerialSettings(),
    hardware_tested=False,
)


def create(link: Link, options: Mapping[str, object]) -> instrument.Driver:
    """Return the driver that the option ``mode`` asks for."""
    chosen = instrument.parse_options(Options(), options)
    return Listener(link, chosen) if chosen.mode == "listen" else Reader(link, chosen)


class Reader:
    """Arms the instrument, waits for the press and reads the memory."""

    def __init__(self, link: Link, options: Options) -> None:
        self._link = link
        self._options = options
        self._check = instrument.ReadingCheck()
        self._geometries: tuple[model.Geometry, ...] = ()

    def identify(self) -> model.Instrument:
        """Return model and firmware; the first tries clear a disturbed line."""
        for _ in range(IDENTITY_TRIES - 1):
            with contextlib.suppress(errors.LinkTimeoutError, errors.InstrumentError):
                return self._identify()
        return self._identify()

    def calibration(self) -> model.CalibrationState:
        """Return the state of the white calibration."""
        return "valid" if ask(self._link, "ys", "CALIBRATION( OK)?")[1] else "needed"

    def calibrate(self, prompt: Prompt) -> None:
        """Calibrate on the white plaque; these models have no black calibration."""
        ask(self._link, "p", "RESET")
        ask(self._link, "3ys", "CALIBRATION")
        prompt("Set the instrument on its white plaque and press it down.")
        ask(self._link, "yw", "OK", timeout_s=WHITE_S, more_s=WHITE_MORE_S)
        if self.calibration() != "valid":
            msg = "the white calibration failed: clean the plaque and calibrate again"
            raise errors.InstrumentError(msg)

    def measure(self, prompt: Prompt) -> model.Measurement:
        """Return one reading, taken when the operator presses the instrument down."""
        if not self._geometries:
            self.identify()
        if self.calibration() != "valid":
            raise errors.NeedsCalibrationError(NEEDED)
        ask(self._link, "00A04Cw", "(?<!CALIBRATION )OK")
        prompt(PRESS)
        self._link.wait_for_data(self._options.press_timeout_s, after=b"OK")
        report = self._link.drain(REPORT_IDLE_S, REPORT_S)
        if report.lstrip().startswith(b"CALIBRATION"):
            raise errors.NeedsCalibrationError(NEEDED)
        dumps = [self._dump(0x2000 + 0x7C * k) for k in range(len(self._geometries))]
        rows = np.stack([factors(dump) for dump in dumps])
        raw = b"".join(dumps)
        return self._check.admit(self._geometries, instrument.BANDS_NM, rows, raw)

    def _identify(self) -> model.Instrument:
        found = ask(self._link, "v", IDENTITY, refusal=errors.WrongInstrumentError)
        name, firmware = found.groups(default="")
        self._geometries = INFO.models[name]
        return model.Instrument("X-Rite", name, self._options.serial, firmware)

    def _dump(self, start: int) -> bytes:
        command = f"{start + 0x7B:04X}{start:04X}i\r".encode()
        with complete("memory dump"):
            return self._link.request(command, DUMP_END, DUMP_S, idle_s=LINE_IDLE_S)


class Listener:
    """Sends nothing; each printed report is a reading."""

    def __init__(self, link: Link, options: Options) -> None:
        self._link = link
        self._options = options
        self._check = instrument.ReadingCheck()

    def identify(self) -> model.Instrument:
        """Return what is configured: the instrument is not asked."""
        return model.Instrument("X-Rite", self._options.model, self._options.serial)

    def calibration(self) -> model.CalibrationState:
        """Return ``unknown``: the instrument is not asked."""
        return "unknown"

    def calibrate(self, prompt: Prompt) -> None:
        """Refuse: nothing is sent."""
        msg = "in listen mode nothing is sent: calibrate with the instrument's own keys"
        raise errors.InstrumentError(msg)

    def measure(self, prompt: Prompt) -> model.Measurement:
        """Return the next printed report."""
        prompt(PRESS)
        self._link.wait_for_data(self._options.press_timeout_s)
        with complete("report"):
            raw = self._link.receive(REPORT_END, REPORT_S, idle_s=REPORT_IDLE_S)
        columns = self._options.sample_columns
        percent = instrument.parse_band_rows(raw, instrument.BANDS_NM, columns)
        return self._check.admit(FIVE, instrument.BANDS_NM, percent / 100, raw)


def factors(dump: bytes) -> model.FloatArray:
    """Return the 31 reflectance factors of one memory dump, its echo left out."""
    match = re.fullmatch(rb"(?:\w{8}i)?([0-9A-Fa-f]{248})OK", b"".join(dump.split()))
    if match is None:
        msg = f"the memory dump is not 124 bytes and OK: {quoted(dump)}"
        raise errors.ProtocolError(msg, raw=dump)
    return np.frombuffer(bytes.fromhex(match[1].decode()), "<i4") / 32768
