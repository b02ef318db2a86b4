"""Capture files: everything that went over a link, one JSON object a line.

The first line is the header, ``{"paintlink-capture": 1, "driver": ..., "options": ...,
"started_at": ...}``. Each further line has ``t``, seconds since the start, and one of
``call`` (what the driver was asked to do), ``sent`` or ``received`` (bytes in
hexadecimal), ``silence`` (a wait ended because nothing came).
"""

from __future__ import annotations

import json
import logging
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from datetime import datetime
from io import FileIO
from pathlib import Path
from typing import Literal, NamedTuple, get_args

from paintlink.errors import InputError
from paintlink.instrument import Direction

Verb = Literal["identify", "calibration", "calibrate", "measure", "stored", "clear"]

MAGIC = "paintlink-capture"
VERSION = 1

_log = logging.getLogger(__name__)
_VERBS: tuple[Verb, ...] = get_args(Verb)
_DIRECTIONS: tuple[Direction, ...] = ("sent", "received", "silence")


class Event(NamedTuple):
    """One run of bytes, or the silence that ended a wait."""

    t_s: float
    direction: Direction
    data: bytes


class Call(NamedTuple):
    """One thing the driver was asked to do, and all that went over the link for it."""

    verb: Verb
    events: tuple[Event, ...]


@dataclass(frozen=True, slots=True)
class Capture:
    """A captured session."""

    driver: str
    options: Mapping[str, object]
    started_at: datetime
    calls: tuple[Call, ...]


class CaptureWriter:
    """Writes a session to a new file: announce each call, give `tap` to the link.

    A capture is a by-product: when the disk is full it ends, the reading goes on.
    """

    def __init__(
        self,
        path: Path,
        *,
        driver: str,
        options: Mapping[str, object],
        started_at: datetime,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._file: FileIO | None = path.open("xb", buffering=0)
        self._path = path
        self._clock = clock
        self._start_s = clock()
        self._write({
            MAGIC: VERSION,
            "driver": driver,
            "options": dict(options),
            "started_at": started_at.isoformat(),
        })

    def call(self, verb: Verb) -> None:
        """Note that the driver is about to be asked."""
        self._event(call=verb)

    def tap(self, direction: Direction, data: bytes) -> None:
        """Note what went over the link."""
        self._event(**{direction: data.hex()})

    def close(self) -> None:
        """End the capture; later events are dropped."""
        if self._file is not None:
            self._file.close()
            self._file = None

    def _event(self, **what: str) -> None:
        self._write({"t": round(self._clock() - self._start_s, 6), **what})

    def _write(self, document: Mapping[str, object]) -> None:
        if self._file is None:
            return
        line = json.dumps(document).encode() + b"\n"
        try:
            complete = self._file.write(line) == len(line)
        except OSError:
            complete = False
        if not complete:
            _log.warning("%s: the disk is full, the capture ends here", self._path)
            self.close()


def read_capture(path: Path) -> Capture:
    """Return a captured session; a last line that was cut short is left out.

    Raises
    ------
    InputError
        Naming the line that is no line of a capture.
    """
    lines = path.read_bytes().split(b"\n")[:-1]
    try:
        header = json.loads(lines[0])
        if header[MAGIC] != VERSION:
            raise ValueError
        started_at = datetime.fromisoformat(header["started_at"])
        driver, options = str(header["driver"]), dict(header["options"])
    except (IndexError, KeyError, TypeError, ValueError) as error:
        msg = f"{path} is no capture of paintlink: its first line is not the header"
        raise InputError(msg) from error
    return Capture(driver, options, started_at, tuple(_calls(path, lines[1:])))


def _calls(path: Path, lines: list[bytes]) -> Iterator[Call]:
    found: list[tuple[Verb, list[Event]]] = []
    for number, line in enumerate(lines, start=2):
        try:
            document = json.loads(line)
            if "call" in document:
                found.append((_VERBS[_VERBS.index(document["call"])], []))
            else:
                found[-1][1].append(_event(document))
        except (IndexError, KeyError, TypeError, ValueError) as error:
            msg = f"{path}, line {number}: not a line of a capture"
            raise InputError(msg) from error
    return (Call(verb, tuple(events)) for verb, events in found)


def _event(document: dict[str, str]) -> Event:
    (direction,) = (name for name in _DIRECTIONS if name in document)
    return Event(float(document["t"]), direction, bytes.fromhex(document[direction]))
