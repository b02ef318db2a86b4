"""How long to wait before trying again: longer each time, cut short by a hint."""

from __future__ import annotations

import threading
import time

from paintlink.links import kind_of

FIRST_S = 0.5
LAST_S = 30.0
# Nothing tells when these come back: a replugged instrument is there within 3 s.
LAST_UNSEEN_S = 2.0
LOOK_S = 0.2


class Patience:
    """Back-off without end: 0.5 s, doubled up to 30 s; 2 s where nothing is seen."""

    def __init__(self, address: str) -> None:
        self._last_s = LAST_S if kind_of(address) == "device" else LAST_UNSEEN_S
        self._hint = threading.Event()
        self.delay_s = FIRST_S

    def wake(self) -> None:
        """Try again now."""
        self._hint.set()

    def reset(self) -> None:
        """Begin with short waits again: it worked."""
        self._hint.clear()
        self.delay_s = FIRST_S

    def wait(self, stop: threading.Event) -> None:
        """Return when it is time to try again, or when stopped."""
        deadline = time.monotonic() + self.delay_s
        self.delay_s = min(self.delay_s * 2.0, self._last_s)
        while (left_s := deadline - time.monotonic()) > 0.0 and not stop.is_set():
            if self._hint.wait(min(left_s, LOOK_S)):
                self.reset()
                return
