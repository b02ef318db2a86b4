"""The sections of the configuration file.

The fields of each class are the keys of the section: their types, limits, defaults and
explanations are written down here and nowhere else.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Literal

from paintlink.config._keys import (
    FileMode,
    FilledText,
    Folder,
    Key,
    NamePattern,
    Options,
    Rule,
    number,
    whole,
)

Origin = Literal["real", "simulated"]


def _is_list(value: object) -> bool:
    return isinstance(value, list | tuple)


def _is_web(text: str) -> bool:
    return text.startswith(("http://", "https://"))


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
class SiteSettings:
    """The shop or laboratory, and the folder where files come in and go out."""

    folder: Annotated[
        Folder,
        Key(
            "Below this folder lie inbox/ (colour files for paintlink), working/, "
            "done/, failed/ and duplicate/ (where those files go next) and answers/ "
            "(formulas from the formulation software). Make it a folder that "
            "paintlink may write to.",
            example="/srv/paintlink",
            unset="the service uses the folder site/ inside its state folder; "
            "without systemd it is site/ in your own data folder for paintlink",
        ),
    ]
    name: Annotated[
        FilledText,
        Key("Your name for this place. It tells several shops apart."),
    ] = "paintlink"


@dataclass(frozen=True, slots=True, kw_only=True)
class StateSettings:
    """Where paintlink keeps its memory: the journal and the pictures."""

    folder: Annotated[
        Folder,
        Key(
            "Must lie on a disk of this computer, never on a network share: the "
            "journal would not survive a power cut there. Include it in your backup.",
            example="/var/lib/paintlink",
            unset="the folder that systemd gives the service (/var/lib/paintlink), "
            "or your own state folder for paintlink when systemd is not involved",
        ),
    ]
    keep_days: Annotated[
        int,
        whole(0, 36500),
        Key(
            "Days after which the raw bytes, the nearest paints and the picture of a "
            "closed job are removed. The job itself and its history stay. 0 keeps "
            "everything."
        ),
    ] = 0


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


@dataclass(frozen=True, slots=True, kw_only=True)
class InboxSettings:
    """The folder that takes colour files from people and other programs."""

    folder: Annotated[
        Folder,
        Key(
            "The folder to watch. No route may write into it.",
            example="/srv/paintlink/inbox",
            unset="the folder inbox/ inside the folder of [site]",
        ),
    ]
    enabled: Annotated[bool, Key("Whether the folder is watched at all.")] = True
    poll_s: Annotated[
        float,
        number(0.1, 3600),
        Key(
            "Seconds between two looks into the folder. For a folder on a network "
            "share take 2: such folders do not report new files by themselves."
        ),
    ] = 10.0
    quiet_s: Annotated[
        float,
        number(0.1, 3600),
        Key(
            "Seconds a file must stay unchanged before it is taken, so that no "
            "half-written file is read. Raise it for a slow network."
        ),
    ] = 1.0
    share: Annotated[
        bool,
        Key(
            "Whether the folder lies on a network share. paintlink then looks every 2 "
            "seconds, and only while the file .paintlink-share can be seen in it "
            "(create it once, empty)."
        ),
    ] = False
    max_size_mib: Annotated[
        int,
        whole(1, 100),
        Key(
            "Largest file that is read, in MiB. A colour file is far smaller; "
            "anything above this was put there by mistake."
        ),
    ] = 5
    finish: Annotated[
        Literal["solid", "metallic", "pearl", "unknown"],
        Key("Finish of a colour whose file does not name one."),
    ] = "unknown"

    @property
    def max_bytes(self) -> int:
        """Largest file that is read, in bytes."""
        return self.max_size_mib * 1024 * 1024


@dataclass(frozen=True, slots=True, kw_only=True)
class SnapSettings:
    """ColorSnap: how the nearest paints are found and judged."""

    formula: Annotated[
        FilledText,
        Key(
            "Colour difference formula. Which paint is nearest depends on it, so keep "
            "one formula for all your work."
        ),
    ] = "cie76"
    library: Annotated[
        FilledText,
        Key(
            "Paint library that readings are compared with: virtual, munsell or one of "
            "your own (`paintlink library libraries` lists them). The service reads it "
            "when it starts."
        ),
    ] = "virtual"
    top: Annotated[int, whole(1, 1000), Key("Paints on the list of the nearest.")] = 20
    green: Annotated[
        float,
        number(0, 100),
        Key(
            "Up to this mean difference per angle a paint is shown in green: a good "
            "starting point for the formulation software, never a match by itself."
        ),
    ] = 1.5
    amber: Annotated[
        float,
        number(0, 100),
        Key("Up to this mean difference it is shown in amber, above it in red."),
    ] = 3.0
    repeatability: Annotated[
        float,
        number(0, 10),
        Key(
            "Mean difference between a reading of your instrument and its repetition. "
            "Says how sure the first rank is."
        ),
    ] = 0.1
    outside: Annotated[
        float,
        number(0, 200),
        Key(
            "Tell when a colour lies farther than this outside all colours of the "
            "library, in Lab units. The next keys say when to tell other problems."
        ),
    ] = 2.0
    sparse: Annotated[
        float,
        number(0, 200),
        Key("The ten nearest paints differ by more than this per angle."),
    ] = 12.0
    too_chromatic: Annotated[
        float, number(0, 200), Key("The nearest paint lacks more chroma than this.")
    ] = 3.0
    off_radial: Annotated[
        float,
        number(0, 200),
        Key("The hue travels farther off the radial line than the nearest paint's."),
    ] = 4.0
    face_and_flop: Annotated[
        float,
        number(0, 200),
        Key("Brighter face and darker flop, or the other way, by more than this."),
    ] = 4.0
    flop_index: Annotated[
        float,
        number(0, 100),
        Key("The Flop Index differs by more than this: the finish looks different."),
    ] = 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RouteSettings:
    """A folder that another program watches. Repeat the block for each program."""

    name: Annotated[
        FilledText,
        Key("Your name for the program behind the folder.", "colornet"),
    ]
    folder: Annotated[
        Folder,
        Key(
            "The folder that the program watches, used by nothing else. paintlink "
            "keeps a folder .paintlink in it: leave that alone.",
            "/srv/paintlink/colornet",
        ),
    ]
    format: Annotated[
        FilledText,
        Key("Format of the files, as `paintlink convert` names it.", "colornet"),
    ]
    enabled: Annotated[bool, Key("Whether files are written at all.")] = True
    accept: Annotated[
        tuple[Origin, ...],
        Rule('a list of "real", "simulated" or both, such as ["real"]', bool),
        Key(
            "Readings that may go here. Simulated readings never reach a program "
            "unless you ask for them."
        ),
    ] = ("real",)
    pattern: Annotated[
        NamePattern | None,
        Key(
            "Beginning of the file names, in which {date}, {time}, {name}, {code}, "
            "{paint}, {format}, {copy} and {id6} stand for values of the job. "
            "paintlink adds what keeps the names apart.",
            "{date}_{name}",
            "the pattern that belongs to the format",
        ),
    ] = None
    mode: Annotated[
        FileMode,
        Key(
            "Who may read (4) or read and change (6) the files: paintlink itself, its "
            "group, everybody else."
        ),
    ] = "0664"
    share: Annotated[
        bool,
        Key(
            "Whether the folder lies on a network share. paintlink then writes only "
            "while the file .paintlink-share can be seen in it (create it once, "
            "empty): a share that is not connected is no empty folder."
        ),
    ] = False
    stale_min: Annotated[
        float,
        number(1, 10080),
        Key(
            "Minutes after which a file still lying in the folder raises an alarm: "
            "the other program has probably stopped."
        ),
    ] = 15.0

    @property
    def mode_bits(self) -> int:
        """Permission bits of a delivered file."""
        return int(self.mode, 8)


@dataclass(frozen=True, slots=True, kw_only=True)
class FormulationSettings:
    """The way back from the formulation software: its answers and sprayed panels."""

    enabled: Annotated[
        bool, Key("Whether the folder answers/ of the site is watched.")
    ] = True
    route: Annotated[
        str,
        Key(
            "The [[route]] whose program answers; corrections are asked from it.",
            "colornet",
            "the first route with the format colornet",
        ),
    ] = ""
    toners: Annotated[
        tuple[str, ...],
        Rule("a list of toner codes in quotes", _is_list),
        Key(
            "Toners this shop can mix; an answer with another one is refused. With an "
            "empty list every toner is taken."
        ),
    ] = ()
    accept_dE00: Annotated[  # noqa: N815
        float,
        number(0, 100),
        Key(
            "A panel at most this far from the target (CIEDE2000, mean over the "
            "angles) closes its job."
        ),
    ] = 1.0
    panels: Annotated[
        int,
        whole(1, 20),
        Key("Panels after which a person decides instead of another correction."),
    ] = 3


OrderField = Literal["repair_order", "vin", "paint_code", "panel", "operator"]


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateSettings:
    """A kind of job that orders name. Repeat the block for each kind."""

    name: Annotated[
        FilledText, Key("Your name for it, as orders write it.", "refinish")
    ]
    readings: Annotated[
        int, whole(1, 20), Key("Readings of one sample, averaged into one job.")
    ] = 1
    required: Annotated[
        tuple[OrderField, ...],
        Rule(
            'a list of "repair_order", "vin", "paint_code", "panel" and "operator"',
            _is_list,
        ),
        Key("Fields an order must have; one without them is refused."),
    ] = ()
    routes: Annotated[
        tuple[str, ...],
        Rule("a list of names of routes in quotes", _is_list),
        Key("The [[route]]s these jobs go to; every route that takes them when empty."),
    ] = ()
    preview: Annotated[bool, Key("Whether a picture is drawn.")] = True
    pass_dE: Annotated[  # noqa: N815
        float,
        number(0, 100),
        Key(
            "At every angle at most this far from the paint that the order names, or "
            "from the nearest one: the machine says pass."
        ),
    ] = 1.0
    marginal_dE: Annotated[  # noqa: N815
        float,
        number(0, 100),
        Key("Up to this difference the machine says marginal, above it fail."),
    ] = 2.0
    label_zpl: Annotated[
        str,
        Key("Label for ZPL printers, in the language of Jinja2; built in when empty."),
    ] = ""
    label_html: Annotated[
        str, Key("Label as a page, in the language of Jinja2; built in when empty.")
    ] = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class SinkSettings:
    """A program that is told what happens to jobs. Repeat the block for each."""

    name: Annotated[
        FilledText, Key("Your name for it. Each needs its own.", "dashboard")
    ]
    url: Annotated[
        str,
        Rule('an address that begins with "http://" or "https://"', _is_web),
        Key(
            "Where every event is posted to as JSON, in order, again and again until "
            "it is answered with success. A redirection is not followed.",
            "http://127.0.0.1:9000/paintlink",
        ),
    ]
    kinds: Annotated[
        tuple[str, ...],
        Rule("a list of kinds of events in quotes", _is_list),
        Key('Kinds of events to tell, such as ["done", "failed"]; all when empty.'),
    ] = ()
    secret: Annotated[
        str,
        Key(
            "Shared with the other program: each post is then signed with HMAC-SHA256 "
            "in the header X-Paintlink-Signature."
        ),
    ] = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PreviewSettings:
    """The pictures of a paint."""

    enabled: Annotated[bool, Key("Whether a picture is drawn for every job.")] = True
    object: Annotated[
        FilledText,
        Key('What is painted in the picture: a "panel", a "sphere" or another form.'),
    ] = "panel"
    light: Annotated[
        FilledText, Key('The light it stands in, such as "studio" or "sky".')
    ] = "studio"
    size: Annotated[
        int, whole(16, 4096), Key("Width and height of a picture in pixels.")
    ] = 512
    backend: Annotated[
        Literal["auto", "gl", "cpu"],
        Key(
            'What draws: "gl" the graphics hardware or driver, "cpu" plain '
            'arithmetic, "auto" the first of the two that works here.'
        ),
    ] = "auto"
    caption: Annotated[
        bool,
        Key("Whether the picture says what it shows, and that it is no colour match."),
    ] = True


@dataclass(frozen=True, slots=True, kw_only=True)
class LogSettings:
    """The messages of the service (`journalctl -u paintlink` shows them)."""

    level: Annotated[
        Literal["debug", "info", "warning", "error"],
        Key(
            'The least important message to write. "info" tells the story of each '
            'job; "debug" adds every byte exchanged with the instruments.'
        ),
    ] = "info"
