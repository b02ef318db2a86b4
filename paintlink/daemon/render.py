"""The render role: draws the picture of each job, and never holds up the line."""

from __future__ import annotations

import logging
from functools import partial
from pathlib import Path

from paintlink.config import PreviewSettings
from paintlink.daemon.faults import put_aside
from paintlink.daemon.journal import Journal
from paintlink.daemon.records import Job, Preview
from paintlink.errors import PreviewError
from paintlink.preview import LEAST_WIDTH, render, to_png, with_caption

log = logging.getLogger(__name__)


class Render:
    """Draws waiting pictures into a folder, one at a time."""

    def __init__(
        self, journal: Journal, settings: PreviewSettings, folder: Path
    ) -> None:
        self._journal = journal
        self._settings = settings
        self._folder = folder

    def step(self) -> bool:
        """Draw one picture; False when none is waiting."""
        job = self._journal.waiting_preview()
        if job is None:
            return False
        with put_aside(f"{job.token} no picture", partial(self._refuse, job)):
            try:
                self._journal.set_preview(self._draw(job))
            except (PreviewError, OSError) as error:
                log.warning("%s no picture: %s", job.token, error)
                self._refuse(job, str(error))
        return True

    def _refuse(self, job: Job, why: str) -> None:
        self._journal.set_preview(Preview(job.id, "failed", note=why))

    def _draw(self, job: Job) -> Preview:
        if job.spec is None:
            return Preview(job.id, "failed", note="the job has no specification")
        picture = render(
            [job.spec],
            object=self._settings.object,
            light=self._settings.light,
            size=self._settings.size,
            backend=self._settings.backend,
            cache_dir=self._folder / "baked",
        )
        if self._settings.caption and self._settings.size >= LEAST_WIDTH:
            picture = with_caption(picture)
        path = self._folder / f"{job.token}.png"
        write_whole(path, to_png(picture))
        return Preview(
            job.id, "done", str(path), f"{picture.backend}: {picture.reason}"
        )


def write_whole(path: Path, data: bytes) -> None:
    """Write a file that appears whole or not at all; a picture can be drawn again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.tmp")
    temporary.write_bytes(data)
    temporary.replace(path)
