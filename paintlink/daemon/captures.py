"""Captures of the sessions with instruments: one file after another, the oldest go."""

from __future__ import annotations

import contextlib
import logging
import re
from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from paintlink.config import InstrumentSettings
from paintlink.instrument import Direction
from paintlink.links import CaptureWriter, Verb

log = logging.getLogger(__name__)

FILE_BYTES = 4 << 20
KEPT_BYTES = 256 << 20


class Recorder:
    """Writes every byte of a session; without a folder it only listens.

    Parameters
    ----------
    heard
        Called whenever bytes arrive.
    """

    def __init__(
        self,
        folder: Path | None,
        settings: InstrumentSettings,
        *,
        now: Callable[[], datetime],
        heard: Callable[[], None] = lambda: None,
    ) -> None:
        self._folder = folder
        self._settings = settings
        self._now = now
        self._heard = heard
        self._written = 0
        self._file: CaptureWriter | None = None
        self.start_anew()

    @property
    def full(self) -> bool:
        """Whether the file is large enough to begin another one."""
        return self._file is not None and self._written >= FILE_BYTES

    def start_anew(self) -> None:
        """Begin another file; a disk that takes none costs the capture only."""
        self.close()
        if self._folder is None:
            return
        try:
            self._file = _new_file(self._folder, self._settings, self._now())
        except OSError as error:
            log.warning("%s: no capture is kept: %s", self._settings.name, error)

    def call(self, verb: Verb) -> None:
        """Note what the driver is about to be asked."""
        if self._file is not None:
            self._file.call(verb)

    def tap(self, direction: Direction, data: bytes) -> None:
        """Note what went over the link."""
        if self._file is not None:
            self._file.tap(direction, data)
            self._written += 2 * len(data) + 32
        if direction == "received":
            self._heard()

    def close(self) -> None:
        """End the file."""
        if self._file is not None:
            self._file.close()
        self._file = None
        self._written = 0


def _new_file(
    folder: Path, settings: InstrumentSettings, started_at: datetime
) -> CaptureWriter:
    folder.mkdir(parents=True, exist_ok=True)
    _make_room(folder)
    name = re.sub(r"[^A-Za-z0-9-]+", "_", settings.name).strip("_")
    return CaptureWriter(
        folder / f"{name}-{started_at:%Y%m%dT%H%M%S.%f}.jsonl",
        driver=settings.driver,
        options=settings.options,
        started_at=started_at,
    )


def _make_room(folder: Path) -> None:
    """Remove the oldest captures beyond the limit; a file of somebody else stays."""
    files = []
    for path in folder.glob("*.jsonl"):
        with contextlib.suppress(OSError):
            status = path.stat()
            files.append((status.st_mtime, status.st_size, path))
    left = sum(size for _, size, _ in files)
    for _, size, path in sorted(files):
        if left <= KEPT_BYTES:
            return
        with contextlib.suppress(OSError):
            path.unlink()
        left -= size
