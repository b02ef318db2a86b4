"""How many characters a serial line has let through."""

from __future__ import annotations

BITS_PER_CHARACTER = 10
UNPACED = 65536


class Pacer:
    """The characters that may leave by a given time at ``baud``; None for no limit."""

    def __init__(self, baud: int | None) -> None:
        self._character_s = BITS_PER_CHARACTER / baud if baud else None
        self._free_at = 0.0

    def start(self, now_s: float) -> None:
        """A burst begins on the idle line."""
        self._free_at = max(self._free_at, now_s)

    def allowance(self, now_s: float) -> int:
        """The characters that have had time to pass by now and have not been sent."""
        if self._character_s is None:
            return UNPACED
        return int((now_s - self._free_at) / self._character_s)

    def sent(self, count: int) -> None:
        """``count`` characters have left."""
        if self._character_s is not None:
            self._free_at += count * self._character_s
