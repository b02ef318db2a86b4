"""The shop: its folders, its memory, its log."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from paintlink.config._keys import FilledText, Folder, Key, whole


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
class LogSettings:
    """The messages of the service (`journalctl -u paintlink` shows them)."""

    level: Annotated[
        Literal["debug", "info", "warning", "error"],
        Key(
            'The least important message to write. "info" tells the story of each '
            'job; "debug" adds every byte exchanged with the instruments.'
        ),
    ] = "info"
