"""What leaves the shop: files, labels and messages."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from paintlink.config._keys import (
    FileMode,
    FilledText,
    Folder,
    Key,
    NamePattern,
    Origin,
    Rule,
    number,
    whole,
)


def _is_web(text: str) -> bool:
    return text.startswith(("http://", "https://"))


def _is_list(value: object) -> bool:
    return isinstance(value, list | tuple)


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
    instruments: Annotated[
        tuple[str, ...],
        Rule("a list of names of instruments in quotes", _is_list),
        Key(
            "The [[instrument]]s whose next readings fulfil the oldest of these orders "
            "by themselves, and those of no other do. When empty, readings of any "
            "instrument do that bear the sample name of an order."
        ),
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
