"""Events of the file system, which only ever mean: look now instead of later.

Everything works without them: they come late, twice, or not at all. On network shares
none come, and the folder is not even watched.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from paintlink.intake import mount_of

if TYPE_CHECKING:
    from watchdog.events import FileSystemEvent

log = logging.getLogger(__name__)


class Watcher(Protocol):
    """What tells of changes; watchdog's observer, or none in the tests."""

    def schedule(self, handler: Callable[[], None], folder: Path) -> None:
        """Call the handler whenever something happens in the folder."""

    def start(self) -> None:
        """Begin to watch."""

    def stop(self) -> None:
        """End watching."""


class Hints:
    """Wakes workers when something happens in their folders.

    Parameters
    ----------
    make_watcher
        Makes the watcher when it is first needed.
    """

    def __init__(self, make_watcher: Callable[[], Watcher] | None = None) -> None:
        self._make_watcher = make_watcher or Observing
        self._wanted: list[tuple[Path, Callable[[], None]]] = []
        self._watcher: Watcher | None = None

    def watch(self, folder: Path, wake: Callable[[], None]) -> None:
        """Wake somebody when the folder changes, if that can be told."""
        self._wanted.append((folder, wake))

    def start(self) -> None:
        """Watch what can be watched; a folder that cannot be is scanned anyway."""
        local = [(one, wake) for one, wake in self._wanted if _can_be_watched(one)]
        if not local:
            return
        try:
            self._watcher = self._make_watcher()
            for folder, wake in local:
                self._watcher.schedule(wake, folder)
            self._watcher.start()
        except OSError as error:
            self._watcher = None
            log.warning("no events of folders (%s): they are looked into", error)

    def stop(self) -> None:
        """End watching."""
        if self._watcher is not None:
            with suppress(RuntimeError):
                self._watcher.stop()


class Observing:
    """watchdog's observer of this system."""

    def __init__(self) -> None:
        from watchdog.observers import Observer

        # It warns of events that arrive while it is being stopped.
        logging.getLogger("watchdog").setLevel(logging.ERROR)
        self._observer = Observer()

    def schedule(self, handler: Callable[[], None], folder: Path) -> None:
        """Call the handler whenever something happens in the folder."""
        from watchdog.events import FileSystemEventHandler

        class Wake(FileSystemEventHandler):
            def on_any_event(self, event: FileSystemEvent) -> None:
                del event
                handler()

        self._observer.schedule(Wake(), str(folder), recursive=False)

    def start(self) -> None:
        """Begin to watch."""
        self._observer.start()

    def stop(self) -> None:
        """End watching."""
        self._observer.stop()


def _can_be_watched(folder: Path) -> bool:
    return folder.is_dir() and not mount_of(folder).is_network
