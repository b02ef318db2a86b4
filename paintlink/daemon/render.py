"""The render role: draws the picture of each job, and never holds up the line."""

from __future__ import annotations

import json
import logging
from functools import partial
from pathlib import Path

from paintlink.config import PreviewSettings
from paintlink.daemon.faults import put_aside
from paintlink.daemon.journal import Journal
from paintlink.daemon.records import Job, Preview
from paintlink.errors import PreviewError
from paintlink.model import ColorSpec
from paintlink.preview import (
    LEAST_WIDTH,
    Picture,
    facts,
    render,
    to_png,
    with_caption,
)

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
        picture = picture_of(job.spec, self._settings, self._folder)
        path = self._folder / f"{job.token}.png"
        write_whole(path, to_png(picture))
        words = json.dumps(facts(picture), indent=2, ensure_ascii=False)
        write_whole(path.with_suffix(".json"), f"{words}\n".encode())
        return Preview(
            job.id, "done", str(path), f"{picture.backend}: {picture.reason}"
        )


def picture_of(spec: ColorSpec, settings: PreviewSettings, folder: Path) -> Picture:
    """The picture of a colour as the settings want it.

    Parameters
    ----------
    folder
        Baked light is kept in it.
    """
    picture = render(
        [spec],
        object=settings.object,
        light=settings.light,
        size=settings.size,
        backend=settings.backend,
        cache_dir=folder / "baked",
    )
    captioned = settings.caption and settings.size >= LEAST_WIDTH
    return with_caption(picture) if captioned else picture


def write_whole(path: Path, data: bytes) -> None:
    """Write a file that appears whole or not at all; a picture can be drawn again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.tmp")
    temporary.write_bytes(data)
    temporary.replace(path)
