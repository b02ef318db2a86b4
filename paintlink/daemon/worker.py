"""A thread that repeats one step: at once while there is work, else when woken."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable

from paintlink.errors import JournalError, JournalFullError

log = logging.getLogger(__name__)

PAUSE_AFTER_FAULT_S = 5.0


class Worker(threading.Thread):
    """Runs ``step`` until stopped.

    A fault of the program is logged with its traceback and the work goes on after a
    pause; so it does when the disk of the journal is full. A journal that fails to
    store for any other reason ends the service: after an error in syncing, nobody
    knows what is on the disk.

    Parameters
    ----------
    make_step
        Called inside the thread, so that what it opens belongs to the thread.
    idle_s
        How long to wait for a wake-up before looking again, or what tells it.
    """

    def __init__(
        self,
        name: str,
        make_step: Callable[[], Callable[[], bool]],
        *,
        stop: threading.Event,
        idle_s: float | Callable[[], float],
    ) -> None:
        super().__init__(name=name, daemon=True)
        self._make_step = make_step
        self._stop_event = stop
        self._idle_s = idle_s
        self._wake = threading.Event()
        self._idle_lock = threading.Lock()
        self.idle = threading.Event()
        self.last_beat_s = time.monotonic()

    def wake(self) -> None:
        """Look for work now."""
        with self._idle_lock:
            self.idle.clear()
            self._wake.set()

    def run(self) -> None:
        """Repeat the step until the service stops."""
        try:
            step = self._make_step()
            while not self._stop_event.is_set():
                self._once(step)
        except JournalError:
            log.exception("%s: the journal cannot be trusted: stopping", self.name)
            self._stop_event.set()

    def _once(self, step: Callable[[], bool]) -> None:
        self.last_beat_s = time.monotonic()
        self._wake.clear()
        try:
            if step():
                return
        except JournalFullError:
            log.exception("%s: nothing can be stored; trying again", self.name)
            self._stop_event.wait(PAUSE_AFTER_FAULT_S)
            return
        except JournalError:
            raise
        except Exception:
            log.exception("%s: a fault of the program; the work goes on", self.name)
            self._stop_event.wait(PAUSE_AFTER_FAULT_S)
            return
        with self._idle_lock:
            if not self._wake.is_set():
                self.idle.set()
        self._wake.wait(self._idle_s() if callable(self._idle_s) else self._idle_s)
