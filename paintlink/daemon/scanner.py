"""A thread that wakes whoever waits for a device when devices come or go."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Sequence

from paintlink.links import Hotplug


class Scanner(threading.Thread):
    """Calls every one of ``wake`` after each change; a hint, never the truth."""

    def __init__(
        self,
        addresses: Iterable[str],
        wake: Sequence[Callable[[], None]],
        *,
        stop: threading.Event,
    ) -> None:
        super().__init__(name="scanner", daemon=True)
        self._hotplug = Hotplug(addresses)
        self._wake = wake
        self._stop_event = stop

    def run(self) -> None:
        """Look until the service stops."""
        while not self._stop_event.is_set():
            if self._hotplug.wait():
                for wake in self._wake:
                    wake()
        self._hotplug.close()
