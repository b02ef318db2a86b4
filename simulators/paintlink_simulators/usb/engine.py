"""Requests of a host to one device: queued, moved packet by packet, finished once."""

from __future__ import annotations

import errno
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from paintlink_simulators.usb import _requests
from paintlink_simulators.usb._requests import (
    CLEAR_FEATURE,
    CONFIGURATION,
    DEVICE,
    IN,
    STRING,
    Setup,
    StallError,
    string_descriptor,
)
from paintlink_simulators.usb.function import PACKET, UsbFunction

TICK_S, SHORT_S = 0.01, 0.0005
PATIENCE_S = 5.0


@dataclass(eq=False, slots=True)
class Urb:
    """One request: filled in by the host, finished by the engine.

    Parameters
    ----------
    address
        Of the endpoint, with the direction bit; 0 for control requests.
    setup
        Of a control request.
    data
        Bytes for the device.
    length
        The most bytes the host wants.
    done
        Called once, when it is finished.
    status
        0 or a negative errno, once it is finished.
    """

    address: int
    done: Callable[[Urb], None]
    setup: Setup | None = None
    data: bytes = b""
    length: int = 0
    status: int | None = None
    received: bytearray = field(default_factory=bytearray)


class Engine:
    """The device's side of the bus, until it is unplugged.

    One lock guards the device; a thread moves what only time sets free. Every method
    may be called from any thread.
    """

    def __init__(self, function: UsbFunction) -> None:
        self._function = function
        self._queues: dict[int, deque[Urb]] = {
            address: deque() for address in function.endpoints
        }
        self._halted: set[int] = set()
        self._configured = 0
        self._when_gone: list[Callable[[], None]] = []
        self.gone = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def submit(self, urb: Urb) -> None:
        """Begin a request; control requests are finished at once."""
        with self._changed:
            if self.gone:
                _finish(urb, -errno.ESHUTDOWN)
            elif urb.setup is not None:
                self._control(urb, urb.setup)
            elif urb.address not in self._queues:
                _finish(urb, -errno.ENOENT)
            else:
                self._queues[urb.address].append(urb)
            self._pump()
            self._changed.notify()

    def unlink(self, urb: Urb) -> bool:
        """Take a request back; false when it was finished already."""
        with self._changed:
            queue = self._queues.get(urb.address, deque())
            if urb.status is not None or urb not in queue:
                return False
            queue.remove(urb)
            urb.status = -errno.ECONNRESET
            return True

    def halt(self, address: int) -> None:
        """Refuse everything on an endpoint until the host clears the halt."""
        with self._changed:
            self._halted.add(address)
            self._pump()

    def press(self) -> None:
        """Press the instrument down."""
        with self._changed:
            self._function.press()
            self._pump()
            self._changed.notify()

    def unplug(self) -> None:
        """Finish every request with ESHUTDOWN, and all later ones as well."""
        with self._changed:
            self._leave()
        if threading.current_thread() is not self._thread:
            self._thread.join(PATIENCE_S)

    def on_gone(self, call: Callable[[], None]) -> None:
        """Call it once the device is gone, at once if it is already."""
        with self._changed:
            if not self.gone:
                self._when_gone.append(call)
                return
        call()

    def _leave(self) -> None:
        if self.gone:
            return
        self.gone = True
        for queue in self._queues.values():
            while queue:
                _finish(queue.popleft(), -errno.ESHUTDOWN)
        for call in self._when_gone:
            call()
        self._function.simulator.disconnect()
        self._changed.notify()

    def _run(self) -> None:
        with self._changed:
            while not self.gone:
                self._changed.wait(self._wait_s())
                if not self.gone:
                    self._pump()

    def _wait_s(self) -> float | None:
        due = self._function.due_at()
        if due is None:
            return None
        # The simulator's clock may run faster than the real one.
        return min(max(due - self._function.simulator.clock(), SHORT_S), TICK_S)

    def _pump(self) -> None:
        for _ in range(PACKET):
            # What comes in pieces at once travels in one packet.
            self._function.poll()
            if not self._overdue():
                break
        for address, queue in self._queues.items():
            while queue and self._advance(address, queue[0]):
                queue.popleft()
        if self._function.cut and self._function.empty:
            self._leave()

    def _overdue(self) -> bool:
        due = self._function.simulator.due_at()
        return due is not None and due <= self._function.simulator.clock()

    def _advance(self, address: int, urb: Urb) -> bool:
        """Move what can be moved; true when the request is finished."""
        if address in self._halted:
            return _finish(urb, -errno.EPIPE)
        if not address & IN:
            for start in range(0, len(urb.data), PACKET):
                self._function.out_packet(urb.data[start : start + PACKET])
            return _finish(urb, 0)
        return self._fill(address, urb)

    def _fill(self, address: int, urb: Urb) -> bool:
        full = self._function.endpoints[address].packet_size
        while (packet := self._function.in_packet(address)) is not None:
            if len(packet) > urb.length - len(urb.received):
                return _finish(urb, -errno.EOVERFLOW)
            urb.received += packet
            if len(packet) < full or len(urb.received) == urb.length:
                return _finish(urb, 0)
        return False

    def _control(self, urb: Urb, setup: Setup) -> None:
        try:
            answer = (
                self._standard(setup)
                if setup.standard
                else self._function.control(setup, urb.data)
            )
        except StallError:
            _finish(urb, -errno.EPIPE)
            return
        urb.received += answer[: setup.length] if setup.kind & IN else b""
        _finish(urb, 0)

    def _standard(self, setup: Setup) -> bytes:
        match setup.request:
            case _requests.GET_DESCRIPTOR:
                return self._descriptor(setup.value >> 8, setup.value & 0xFF)
            case _requests.GET_STATUS:
                return bytes((int(setup.target in self._halted), 0))
            case _requests.GET_CONFIGURATION:
                return bytes([self._configured])
            case _requests.SET_CONFIGURATION:
                self._configured = setup.value
                self._halted.clear()
                return b""
            case _requests.GET_INTERFACE:
                return b"\0"
            case _requests.SET_ADDRESS | _requests.SET_INTERFACE:
                return b""
            case _requests.CLEAR_FEATURE | _requests.SET_FEATURE:
                return self._feature(setup)
        raise StallError

    def _feature(self, setup: Setup) -> bytes:
        endpoint_halt = setup.kind & 0x1F == 2 and setup.value == 0
        if endpoint_halt and setup.request == CLEAR_FEATURE:
            self._halted.discard(setup.target)
        elif endpoint_halt:
            self._halted.add(setup.target)
        return b""

    def _descriptor(self, kind: int, index: int) -> bytes:
        if kind == DEVICE:
            return self._function.DEVICE
        if kind == CONFIGURATION and index == 0:
            return self._function.CONFIGURATION
        if kind == STRING:
            return string_descriptor(self._function.strings, index)
        raise StallError


def _finish(urb: Urb, status: int) -> bool:
    urb.status = status
    urb.done(urb)
    return True
