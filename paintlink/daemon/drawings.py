"""The preview folder at work: a colour file that is dropped gets its picture."""

from __future__ import annotations

import logging
from functools import partial

from paintlink.config import Settings
from paintlink.daemon.faults import OF_NO_JOB, in_words
from paintlink.daemon.render import picture_of
from paintlink.errors import PaintlinkError, PreviewError
from paintlink.intake import Options, load_profiles, read_colours
from paintlink.model import ColorSpec
from paintlink.preview import Picture
from paintlink.preview.hot_folder import HotFolder

log = logging.getLogger(__name__)


class Drawings:
    """Draws what lies in the preview folder, one file at a time.

    Files are read as those of the inbox are, and stay where they are.
    """

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._folder = settings.drawings_folder
        options = Options(
            finish=settings.inbox.finish,
            profiles=load_profiles(settings.profiles_folder),
        )
        read = partial(read_colours, options=options)
        self._hot = HotFolder(self._folder, read, self._draw)
        self._trouble = ""

    def step(self) -> bool:
        """Draw one file; False when none is waiting."""
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            drawn = self._hot.step()
        except OSError as error:
            self._tell_once(f"{error}; previews wait")
            return False
        self._trouble = ""
        if drawn is not None:
            outcome = drawn.error or ", ".join(drawn.pictures)
            log.info("%s: %s", drawn.source.name, outcome)
        return drawn is not None

    def _draw(self, spec: ColorSpec) -> Picture:
        """The picture; a fault of the program refuses this file only."""
        settings = self._settings
        try:
            return picture_of(spec, settings.preview, settings.previews_folder)
        except (PaintlinkError, *OF_NO_JOB):
            raise
        except Exception as error:
            log.exception("%s: no picture", spec.name)
            raise PreviewError(in_words(error)) from error

    def _tell_once(self, trouble: str) -> None:
        if trouble != self._trouble:
            log.warning(trouble)
        self._trouble = trouble
