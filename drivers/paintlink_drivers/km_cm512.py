"""Konica Minolta CM-512m3 and m3A: docs/wire/km_cm512.md. Never met real hardware."""

import contextlib
import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from paintlink import errors, instrument, model
from paintlink.instrument import Link, Prompt, ask, confirm, option

ANGLES = (25, 45, 75)
GEOMETRIES = {
    # Only 45as45 has the light of a colour specification: solid colours only.
    "normal": tuple(instrument.parse_geometry(f"{a}as{a}") for a in ANGLES),
    "45": tuple(instrument.parse_geometry(f"45as{a}") for a in ANGLES),
}
WAKE_S, IDENTITY_S, IDENTITY_TRIES = 1.0, 2.0, 3
CALIBRATION_S, MEASURE_S, NEXT_S, CHARGING = 30.0, 30.0, 5.0, "1"
CONTINUATIONS = 6
REPLY = r"\A(OK\d\d)(?:,(.*))?\Z"
NAME = re.compile(r"CM-?512\w*", re.IGNORECASE)
PERCENT = re.compile(r"\d{3}\.\d\d")
ZERO = ("UZC", "Hold the instrument into the air or onto its zero box.")
WHITE = ("CAL", "Set the instrument on its white plate.")
NEEDED = "the instrument is not calibrated: calibrate it on its white plate first"


@dataclass(frozen=True, slots=True)
class Options:
    """What the operator may set."""

    looks_from: str = option(
        "normal",
        "the normal: light from 25, 45 and 75 degrees; 45: light from 45 degrees",
        choices=("normal", "45"),
    )
    calibrate_first: str = option("zero", "order", choices=("zero", "white"))
    serial_field: int = option(3, "place in the answer to IDR", minimum=1, maximum=20)
    any_name: bool = option(False, "take an answer to IDR without the model's name")


INFO = instrument.DriverInfo(
    id="km_cm512",
    maker="Konica Minolta",
    models=dict.fromkeys(("CM-512m3A", "CM-512m3"), GEOMETRIES["normal"]),
    options=Options(),
    serial=instrument.SerialSettings(),
    hardware_tested=False,
)


def create(link: Link, options: Mapping[str, object]) -> instrument.Driver:
    """Return the driver; the host starts each reading."""
    return Reader(link, instrument.parse_options(Options(), options))


class Reader:
    """Starts a measurement and fetches its seven replies."""

    def __init__(self, link: Link, options: Options) -> None:
        self._link = link
        self._options = options
        self._check = instrument.ReadingCheck()

    def identify(self) -> model.Instrument:
        """Return model, serial number and firmware; the first question may be lost."""
        self._link.send(b"IDR\r")
        self._link.drain(WAKE_S, 2 * WAKE_S)
        for _ in range(IDENTITY_TRIES - 1):
            with contextlib.suppress(errors.LinkTimeoutError, errors.InstrumentError):
                return self._identify()
        return self._identify()

    def calibration(self) -> model.CalibrationState:
        """Return the state of the white calibration."""
        return "needed" if self._status()[1] == "0" else "valid"

    def calibrate(self, prompt: Prompt) -> None:
        """Calibrate on zero and on the white plate, in the configured order."""
        steps = [ZERO, WHITE]
        for command, sentence in steps[
            :: 1 if self._options.calibrate_first == "zero" else -1
        ]:
            confirm(prompt, sentence)
            self._reply(command, CALIBRATION_S, prompt)
        if self.calibration() != "valid":
            msg = "the calibration failed: clean the white plate and calibrate again"
            raise errors.InstrumentError(msg)

    def measure(self, prompt: Prompt) -> model.Measurement:
        """Return one reading, started by us."""
        lamp, white = self._status()
        if white == "0":
            raise errors.NeedsCalibrationError(NEEDED)
        if lamp == CHARGING:
            msg = "the lamp is charging: wait ten seconds and measure again"
            raise errors.InstrumentError(msg, code=lamp)
        confirm(prompt, "Set the instrument on the panel and hold it still.")
        replies = [self._reply("MES", MEASURE_S, prompt)]
        for _ in range(CONTINUATIONS):
            replies.append(self._reply("&", NEXT_S, prompt))
        raw = "\r".join(replies).encode("latin-1")
        rows = [values for reply in replies if (values := percents(reply))]
        if len(rows) != len(ANGLES):
            msg = f"the instrument sent {len(rows)} whole spectra of 3: measure again"
            raise errors.ProtocolError(msg, raw=raw)
        geometries = GEOMETRIES[self._options.looks_from]
        factors = np.array(rows) / 100.0
        return self._check.admit(geometries, instrument.BANDS_NM, factors, raw)

    def _identify(self) -> model.Instrument:
        fields = ask(self._link, "IDR", REPLY, timeout_s=IDENTITY_S)[0].split(",")
        name = next(
            (found[0] for f in fields if (found := NAME.fullmatch(f.strip()))), ""
        )
        if not (name or self._options.any_name):
            msg = f"not a CM-512m3: it answered {instrument.quoted(','.join(fields))}"
            raise errors.WrongInstrumentError(msg, code=",".join(fields))
        known = {model.casefold(): model for model in INFO.models}
        place = self._options.serial_field
        return model.Instrument(
            INFO.maker,
            known.get(name.casefold(), name or "CM-512m3"),
            serial=fields[place].strip() if place < len(fields) else "",
            firmware=next((f for f in fields if re.fullmatch(r"\d\.\d+", f)), ""),
        )

    def _status(self) -> tuple[str, str]:
        """Lamp and white calibration, as the instrument spells them."""
        found = ask(self._link, "STR", r"\AOK\d\d,\s*(\d)\s*,\s*(\d)")
        return found[1], found[2]

    def _reply(self, command: str, timeout_s: float, prompt: Prompt) -> str:
        found = ask(self._link, command, REPLY, timeout_s=timeout_s)
        if found[1] != "OK00":
            prompt(f"The instrument remarks {found[1]} to {command}.")
        return found[0]


def percents(reply: str) -> list[float]:
    """Return the 31 percents of a spectrum; nothing when the reply is another one."""
    # Blanks stand at the end of a reply only: within one they were spliced in.
    fields = reply.strip().split(",")[1:]
    whole = len(fields) == len(instrument.BANDS_NM)
    spectrum = whole and all(PERCENT.fullmatch(field) for field in fields)
    return [float(field) for field in fields] if spectrum else []
