"""Somebody at the instrument."""

from __future__ import annotations

from paintlink_simulators._simulator import Simulator, Wrapper, earlier


class Operator(Wrapper):
    """A simulator that is pressed ``after_s`` seconds after it begins to wait for it.

    For a calibration it is put on its plaque for the press, and taken off again.
    """

    def __init__(self, inner: Simulator, after_s: float) -> None:
        super().__init__(inner)
        self._after_s = after_s
        self._press_at: float | None = None

    def poll(self) -> bytes:
        """What the simulator sends by itself, and on the press when that is due."""
        sent = super().poll()
        if self._press_at is not None and self.clock() >= self._press_at:
            # A press that is not noticed is repeated, not at once but as late again.
            self._press_at = None
            sent += self._press_where_wanted()
        return sent

    def due_at(self) -> float | None:
        """When the simulator is due, or the press."""
        return earlier(self.inner.due_at(), self._press_at)

    def _pass(self, answer: bytes) -> bytes:
        if not (self.inner.armed or self.inner.awaits_plate):
            self._press_at = None
        elif self._press_at is None:
            self._press_at = self.clock() + self._after_s
        return answer

    def _press_where_wanted(self) -> bytes:
        plate_on = self.plate_on
        self.plate_on = plate_on or self.awaits_plate
        try:
            return self.press()
        finally:
            self.plate_on = plate_on
