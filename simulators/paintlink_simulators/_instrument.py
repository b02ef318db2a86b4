"""What simulated instruments have in common: a panel, a clock, one thing at a time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np

from paintlink.errors import ConfigError
from paintlink.model import FloatArray
from paintlink_simulators._simulator import Clock
from paintlink_simulators.paint import TYPICAL, Panel, Repeatability, noisy

Condition = Literal["ready", "warming", "battery_low", "memory_full"]
CONDITIONS: tuple[Condition, ...] = ("ready", "warming", "battery_low", "memory_full")
Defect = Literal["none", "not_a_number", "impossible"]
DEFECTS: tuple[Defect, ...] = ("none", "not_a_number", "impossible")
IMPOSSIBLE_FACTOR = 20.0
DEFECTIVE_BAND = 5

WARM_UP_S = 60.0
HOST_LINE_END = b"\r"


@dataclass(frozen=True, slots=True, kw_only=True)
class CommonOptions:
    """The state an instrument is in when it is switched on.

    Parameters
    ----------
    condition
        What keeps it from measuring; a lamp has warmed up after `WARM_UP_S`.
    defect
        What its electronics make of the sixth band of a reading.
    """

    calibrated: bool = True
    plate_on: bool = False
    condition: Condition = "ready"
    defect: Defect = "none"
    repeatability: Repeatability = TYPICAL

    def check(self, simulator: str, **choices: tuple[object, ...]) -> None:
        """Do nothing when every option is one of its choices.

        Raises
        ------
        ConfigError
            Naming the option and its choices.
        """
        common = {"condition": CONDITIONS, "defect": DEFECTS}
        for option, known in {**common, **choices}.items():
            value = getattr(self, option)
            if value not in known:
                listed = ", ".join(map(repr, known))
                what = f"simulator {simulator}: {option} = {value!r}"
                msg = f"{what} is not one of {listed}"
                raise ConfigError(msg)


class _Work(NamedTuple):
    ends_at: float
    finish: Callable[[], bytes]
    on_plate: bool


class Instrument:
    """An instrument as a state machine from bytes to bytes; see `Simulator`.

    While it works at one command the next ones wait. A subclass says where a command
    ends (`_next_command`) and what it does (`_execute`).
    """

    __slots__ = (
        "_calibrated",
        "_common",
        "_pressed_on_plate",
        "_received",
        "_rng",
        "_warm_at",
        "_work",
        "clock",
        "panel",
        "plate_on",
    )

    def __init__(
        self, panel: Panel, clock: Clock, seed: int, options: CommonOptions
    ) -> None:
        self.panel = panel
        self.clock = clock
        self.plate_on = options.plate_on
        self._common = options
        self._rng = np.random.default_rng(seed)
        self._calibrated = options.calibrated
        self._warm_at = clock() + WARM_UP_S
        self._received = b""
        self._work: _Work | None = None
        self._pressed_on_plate = False

    @property
    def armed(self) -> bool:
        """Whether it waits for a press to measure."""
        return False

    @property
    def awaits_plate(self) -> bool:
        """Whether it waits for a press on its white plaque."""
        return self._work is not None and self._work.on_plate

    def feed(self, data: bytes) -> bytes:
        """The answers to the commands that ``data`` completes."""
        self._received += data
        return self.poll()

    def poll(self) -> bytes:
        """What has become due, and the answers to commands held up by it."""
        sent = b""
        while True:
            if self._work is not None:
                if self.clock() < self._work.ends_at:
                    return sent
                finish, self._work = self._work.finish, None
                sent += finish()
            elif (command := self._next_command()) is not None:
                sent += self._execute(command)
            else:
                return sent

    def due_at(self) -> float | None:
        """When the running work ends."""
        return None if self._work is None else self._work.ends_at

    def disconnect(self) -> None:
        """Forget the unfinished command and the work in hand."""
        self._received = b""
        self._work = None

    def press(self) -> bytes:
        """What it sends when the operator presses it down."""
        self._pressed_on_plate = self._pressed_on_plate or self.plate_on
        return b"" if self._work is not None else self._on_press()

    def _on_press(self) -> bytes:
        return b""

    def _next_command(self) -> bytes | None:
        if HOST_LINE_END not in self._received:
            return None
        command, _, self._received = self._received.partition(HOST_LINE_END)
        return command

    def _execute(self, command: bytes) -> bytes:
        raise NotImplementedError

    def _work_for(
        self, seconds: float, finish: Callable[[], bytes], *, on_plate: bool = False
    ) -> bytes:
        """Nothing yet; what ``finish`` returns is sent after so many seconds."""
        self._pressed_on_plate = False
        self._work = _Work(self.clock() + seconds, finish, on_plate)
        return b""

    def _stands_on_plate(self) -> bool:
        """Whether the work that ends now had the white plaque under it."""
        return self.plate_on or self._pressed_on_plate

    @property
    def _condition(self) -> Condition:
        warm = self._common.condition == "warming" and self.clock() >= self._warm_at
        return "ready" if warm else self._common.condition

    def _look(self, aspecular_deg: tuple[float, ...]) -> FloatArray:
        """The reflectance factors one reading has at these angles, shape (m, 31)."""
        angles = np.array(aspecular_deg)
        seen = replace(
            self.panel, aspecular_deg=angles, factors=self.panel.factors_at(angles)
        )
        reading = noisy(seen, self._rng, self._common.repeatability).factors.copy()
        match self._common.defect:
            case "not_a_number":
                reading[:, DEFECTIVE_BAND] = np.nan
            case "impossible":
                reading[:, DEFECTIVE_BAND] = IMPOSSIBLE_FACTOR
        return reading
