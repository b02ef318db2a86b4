"""What a driver is: facts about the instrument, and four verbs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from paintlink.instrument._link import Link
from paintlink.instrument._options import OptionSet, option
from paintlink.model import CalibrationState, Geometry, Instrument, Measurement

Prompt = Callable[[str], None]

BAUD_RATES = (
    *(300, 600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200),
    *(230400, 460800, 921600),
)


@dataclass(frozen=True, slots=True)
class SerialSettings:
    """How a serial line is set.

    Software flow control is missing on purpose: it swallows the bytes 11 and 13.
    """

    baudrate: int = option(9600, "bits per second", choices=BAUD_RATES)
    bytesize: int = option(8, "data bits", choices=(7, 8))
    parity: str = option("N", "none, even or odd", choices=("N", "E", "O"))
    stopbits: int = option(1, "stop bits", choices=(1, 2))
    rtscts: bool = option(False, "hardware flow control")
    dtr: bool = option(True, "state of the DTR line")
    rts: bool = option(True, "state of the RTS line")

    @property
    def summary(self) -> str:
        """The settings as they are spoken: ``9600 8N1``."""
        return f"{self.baudrate} {self.bytesize}{self.parity}{self.stopbits}"


@dataclass(frozen=True, slots=True)
class UsbSettings:
    """How an instrument is found on USB and where its bytes go.

    Parameters
    ----------
    out_endpoint
        None: commands go out as control transfers with ``control_request``, that is
        bmRequestType, bRequest, wValue, wIndex.
    """

    vendor_id: int
    product_id: int
    in_endpoint: int = 0x81
    out_endpoint: int | None = None
    control_request: tuple[int, int, int, int] = (0x41, 0, 0, 0)
    configuration: int = 1
    interface: int = 0

    @property
    def usb_id(self) -> str:
        """Vendor and product as `lsusb` writes them: ``0765:d020``."""
        return f"{self.vendor_id:04x}:{self.product_id:04x}"


@dataclass(frozen=True, slots=True)
class DriverInfo:
    """What is known of an instrument before it is connected.

    Parameters
    ----------
    id
        File name of the driver module.
    models
        Model name, as `Driver.identify` returns it, to the geometries it measures.
    options
        The driver's options, all at their defaults.
    hardware_tested
        Whether the driver ever met a real instrument.
    usb
        How it is reached on USB; None when it has a serial line only.
    """

    id: str
    maker: str
    models: Mapping[str, tuple[Geometry, ...]]
    options: OptionSet
    serial: SerialSettings
    hardware_tested: bool
    usb: UsbSettings | None = None

    @property
    def label(self) -> str:
        """The instruments as a person would say them."""
        return f"{self.maker} {', '.join(self.models)}"


class Driver(Protocol):
    """One connected instrument.

    Every method may raise ``LinkError``, ``LinkTimeoutError``, ``ProtocolError``,
    ``InstrumentError`` and ``CancelledError``. A driver never opens a port, never
    repeats a reading by itself and never sleeps. What the instrument itself is told
    by a press needs a ``prompt`` only; before the driver starts something the operator
    has to be ready for, it calls `confirm`.
    """

    def identify(self) -> Instrument:
        """Return what the instrument says it is.

        Raises
        ------
        WrongInstrumentError
            When something else answers.
        """
        ...

    def calibration(self) -> CalibrationState:
        """Return the state of the white calibration."""
        ...

    def calibrate(self, prompt: Prompt) -> None:
        """Calibrate; ``prompt`` is given each sentence for the operator."""

    def measure(self, prompt: Prompt) -> Measurement:
        """Return one reading; ``prompt`` is given each sentence for the operator.

        Raises
        ------
        NeedsCalibrationError
            When the instrument is not calibrated.
        """
        ...


@runtime_checkable
class ReadingMemory(Protocol):
    """A driver whose instrument keeps readings taken without us."""

    def stored(self) -> Iterator[Measurement]:
        """Yield every kept reading, oldest first, and delete none.

        ``Measurement.record`` tells the same reading in a later transfer.
        """
        ...

    def clear(self) -> None:
        """Delete every kept reading."""


class Confirming(Protocol):
    """A prompt that can also wait for the operator."""

    def __call__(self, sentence: str) -> None:
        """Tell the operator ``sentence``."""

    def confirm(self, sentence: str) -> None:
        """Tell the operator ``sentence`` and return when it is done."""


def confirm(prompt: Prompt | Confirming, sentence: str) -> None:
    """Return when the operator has done it; at once where nobody can say so."""
    getattr(prompt, "confirm", prompt)(sentence)


class DriverModule(Protocol):
    """A module in a package of the entry point group ``paintlink.drivers``."""

    @property
    def INFO(self) -> DriverInfo:  # noqa: N802
        """Facts about the instrument."""
        ...

    def create(self, link: Link, options: Mapping[str, object]) -> Driver:
        """Return a driver that talks through ``link``.

        Raises
        ------
        ConfigError
            Naming every unknown or wrong option.
        """
        ...
