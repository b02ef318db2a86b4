"""What the journal holds, as the rest of the program sees it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from paintlink.model import ColorSpec, Match, Origin

JobState = Literal["collecting", "received", "specified", "matched", "done", "failed"]
DeliveryState = Literal[
    "pending", "publishing", "written", "stale", "taken", "answered", "failed",
    "unknown", "closed",
]  # fmt: skip
PreviewState = Literal["pending", "done", "failed"]
InstrumentState = Literal[
    "absent", "opening", "identifying", "needs calibration", "ready", "reading", "lost"
]


@dataclass(frozen=True, slots=True)
class Delivery:
    """One file for one route; ``copy`` counts explicit resends from 1."""

    id: int
    job_id: int
    route: str
    copy: int
    folder: str
    state: DeliveryState
    name: str = ""
    sha256: str = ""
    error: str = ""
    attempts: int = 0
    written_at: str = ""


@dataclass(frozen=True, slots=True)
class Preview:
    """The picture of a job: where it is, or why there is none."""

    job_id: int
    state: PreviewState
    path: str = ""
    note: str = ""


@dataclass(frozen=True, slots=True)
class Job:
    """One colour on its way from the reading to the formulation software.

    ``document`` is the specification as it is stored.
    """

    id: int
    token: str
    reading_id: int | None
    source: str
    origin: Origin
    state: JobState
    created_at: str
    spec: ColorSpec | None = None
    matches: tuple[Match, ...] = ()
    deliveries: tuple[Delivery, ...] = ()
    preview: Preview | None = None
    error: str = ""
    document: bytes = b""
    order_id: int | None = None
    panel_of: int | None = None
    iteration: int = 0


@dataclass(frozen=True, slots=True)
class Event:
    """One thing that happened to a job, in the journal's order."""

    at: str
    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class InstrumentStatus:
    """What an instrument is doing, with a sentence for the person next to it."""

    name: str
    state: InstrumentState
    text: str
    identity: str = ""
    changed_at: str = ""
