"""The spectrophotometers."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Literal

from paintlink.config._keys import FilledText, Key, Options, Origin, number, whole

Baud = Literal[
    300,
    600,
    1200,
    2400,
    4800,
    9600,
    19200,
    38400,
    57600,
    115200,
    230400,
    460800,
    921600,
]


Parity = Literal["none", "even", "odd"]


@dataclass(frozen=True, slots=True, kw_only=True)
class InstrumentSettings:
    """A spectrophotometer and its connection. Repeat the block for each instrument."""

    name: Annotated[
        FilledText,
        Key("Your name for it, seen on every reading. Each needs its own.", "bench"),
    ]
    driver: Annotated[
        FilledText,
        Key(
            "Kind of instrument. `paintlink devices` lists the kinds it knows.",
            "xrite_ma",
        ),
    ]
    port: Annotated[
        FilledText,
        Key(
            "Where it is plugged in. Use a name below /dev/serial/by-id: it stays the "
            "same when cables are moved, /dev/ttyUSB0 does not. An instrument on a "
            "network adapter has a URL, such as socket://192.168.1.20:4001; one on USB "
            "without a serial port usb://0765:d020. A name with * is looked for among "
            "all that fit.",
            "/dev/serial/by-id/usb-FTDI_FT232R_USB_UART_A50285BI-if00-port0",
        ),
    ]
    serial: Annotated[
        str,
        Key(
            "Serial number from the type plate, for an instrument that cannot tell its "
            "own. One that tells another number is refused."
        ),
    ] = ""
    origin: Annotated[
        Origin,
        Key(
            'Write "simulated" for anything that is not a real instrument: its '
            "readings then stay out of every route that does not ask for them. A "
            "simulator on a pseudo-terminal, or at this computer's own network address "
            "127.0.0.1, is always taken as simulated."
        ),
    ] = "real"
    readings: Annotated[
        int,
        whole(1, 20),
        Key(
            "Readings averaged for one sample. More of them even out texture, dust "
            "and the hand that holds the instrument."
        ),
    ] = 3
    finish: Annotated[
        Literal["solid", "metallic", "pearl", "unknown"],
        Key(
            "Finish of what this instrument measures. An instrument with a single "
            'angle serves solid colours only: write "solid" to declare them so.'
        ),
    ] = "unknown"
    calibration_h: Annotated[
        float,
        number(0.1, 168),
        Key("Hours after which the instrument has to be calibrated again."),
    ] = 8.0
    calibration_policy: Annotated[
        Literal["warn", "block"],
        Key(
            'What happens then: "warn" says so and takes readings, "block" takes none '
            "until it is calibrated."
        ),
    ] = "warn"
    baud: Annotated[
        Baud | None,
        Key(
            "Speed of the serial line in bits per second. Only for an instrument "
            "whose speed was changed.",
            9600,
            "as the driver knows it",
        ),
    ] = None
    bytesize: Annotated[
        Literal[7, 8] | None,
        Key("Data bits on the serial line.", 8, "as the driver knows it"),
    ] = None
    parity: Annotated[
        Parity | None,
        Key("Parity on the serial line.", "none", "as the driver knows it"),
    ] = None
    stopbits: Annotated[
        Literal[1, 2] | None,
        Key("Stop bits on the serial line.", 1, "as the driver knows it"),
    ] = None
    options: Annotated[
        Options,
        Key("Settings of this driver alone; its wire document explains them."),
    ] = field(default_factory=dict)
