"""The folder that takes colour files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from paintlink.config._keys import Folder, Key, number, whole


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
