"""A captured session played to a driver: the same bytes must give the same reading."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from typing import NamedTuple

from paintlink.errors import InputError, LinkError, PaintlinkError
from paintlink.instrument import (
    Direction,
    Driver,
    DriverModule,
    Link,
    ReadingMemory,
    quoted,
)
from paintlink.links.capture import Call, Capture, Event, Verb
from paintlink.model import CalibrationState, Instrument, Measurement

Answer = Instrument | CalibrationState | Measurement | tuple[Measurement, ...] | None


class Outcome(NamedTuple):
    """What one captured call gives now: a value, or the error it ended with."""

    verb: Verb
    value: Answer
    error: PaintlinkError | None


class ReplayStream:
    """A byte stream that answers as the capture says, call by call.

    Its clock moves in silence only, so that a replay depends on the order of what
    happened and on nothing else.
    """

    def __init__(self) -> None:
        self._events: deque[Event] = deque()
        self._now_s = 0.0

    def play(self, call: Call) -> None:
        """Take up the next call."""
        self._events = deque(call.events)

    def clock(self) -> float:
        """Return the seconds of silence so far."""
        return self._now_s

    def tap(self, direction: Direction, _data: bytes) -> None:
        """Learn from the link that it has waited enough."""
        if direction == "silence":
            self._events.popleft()

    def write(self, data: bytes) -> None:
        """Check ``data`` against the capture.

        Raises
        ------
        InputError
            When the captured driver did something else at this point.
        """
        event = self._next()
        if event.direction != "sent" or event.data != data:
            raise _differs(event, f"sends {quoted(data)}")
        self._events.popleft()

    def read(self, timeout_s: float) -> bytes:
        """Return the next captured run of bytes; nothing where there was silence.

        Raises
        ------
        InputError
            When the captured driver did something else at this point.
        LinkError
            At the end of the capture, as when the instrument is unplugged.
        """
        event = self._next()
        if event.direction == "sent":
            raise _differs(event, "waits for an answer")
        if event.direction == "received":
            return self._events.popleft().data
        self._now_s += timeout_s
        return b""

    def close(self) -> None:
        """Do nothing: there is no port."""

    def _next(self) -> Event:
        if not self._events:
            msg = "the capture of this call ends here"
            raise LinkError(msg)
        return self._events[0]


def replay(capture: Capture, module: DriverModule) -> Iterator[Outcome]:
    """Yield what each captured call gives with this driver.

    Raises
    ------
    ConfigError
        When the driver does not know the captured options.
    InputError
        When the driver talks otherwise than the captured one.
    """
    stream = ReplayStream()
    link = Link(stream, clock=stream.clock, tap=stream.tap)
    driver = module.create(link, capture.options)
    for call in capture.calls:
        stream.play(call)
        yield _outcome(driver, call.verb)


def _outcome(driver: Driver, verb: Verb) -> Outcome:
    verbs: dict[Verb, Callable[[], Answer]]
    verbs = {
        "identify": driver.identify,
        "calibration": driver.calibration,
        "calibrate": lambda: driver.calibrate(_no_operator),
        "measure": lambda: driver.measure(_no_operator),
        "stored": lambda: _stored(driver),
        "clear": lambda: _clear(driver),
    }
    try:
        return Outcome(verb, verbs[verb](), None)
    except InputError:
        raise
    except PaintlinkError as error:
        return Outcome(verb, None, error)


def _stored(driver: Driver) -> tuple[Measurement, ...]:
    return tuple(driver.stored()) if isinstance(driver, ReadingMemory) else ()


def _clear(driver: Driver) -> None:
    if isinstance(driver, ReadingMemory):
        driver.clear()


def _no_operator(_sentence: str) -> None:
    pass


def _differs(event: Event, does: str) -> InputError:
    was = "a silence" if event.direction == "silence" else quoted(event.data)
    msg = (
        f"at {event.t_s:g} s the capture holds {was} ({event.direction}), but the "
        f"driver {does}: replay it with the driver version that wrote it"
    )
    return InputError(msg)
