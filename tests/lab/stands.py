"""Ways to connect a driver with its simulator through the kernel."""

from __future__ import annotations

import queue
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from paintlink.conformance import Subject
from paintlink.conformance.stands import Build, Hurried, Stand, hurried
from paintlink.links import open_link
from paintlink_simulators.usb import AcmFunction, UsbFunction, UsbSocket
from tests.lab.vhci import Plug, serial_node, wait_for

Make = Callable[[Subject, object, str], UsbFunction]


class Bay:
    """One plugged device; each case puts another simulator into it."""

    def __init__(self, subject: Subject, make: Make, port: int) -> None:
        idle = subject.simulator.create(_any_panel(subject), clock=hurried)
        self.serial = f"SIMLAB{port}"
        self._function = make(subject, idle, self.serial)
        self._usb = subject.driver.INFO.usb
        self._port = port
        self._plug = Plug(UsbSocket(self._function), port)

    def put(self, simulator: object) -> str:
        """The address at which the simulator can now be reached."""
        if self._plug.device.live is None:
            self._plug.replug()
        self._function.simulator = simulator  # type: ignore[assignment]
        self._function.reset()
        return wait_for(self._address, f"the device in port {self._port}")

    def forget(self) -> None:
        self._plug.forget()

    def _address(self) -> str | None:
        place = self._plug.place
        if not (place / "bDeviceClass").exists():
            return None
        if self._usb is not None and not list(place.glob("1-*/tty*")):
            return f"usb://{self._usb.usb_id}/{self.serial}"
        node = serial_node(place)
        return str(node) if node else None


class Bays:
    """Some devices of one kind; a case takes the next free one."""

    def __init__(self, subject: Subject, make: Make, ports: range) -> None:
        self._all = [Bay(subject, make, port) for port in ports]
        self._free: queue.Queue[Bay] = queue.Queue()
        for bay in self._all:
            self._free.put(bay)

    @contextmanager
    def stand(self, subject: Subject, build: Build, chunk: int) -> Iterator[Stand]:
        bay = self._free.get()
        try:
            info = subject.driver.INFO
            stream = open_link(bay.put(build(hurried)), info.serial, info.usb)
            try:
                yield Stand(Hurried(stream, chunk), hurried)
            finally:
                stream.close()
        finally:
            self._free.put(bay)

    def close(self) -> None:
        for bay in self._all:
            bay.forget()


def adapter(subject: Subject, simulator: object, serial: str) -> UsbFunction:
    """The instrument as it appears on USB: FTDI, CH34x, or a protocol of its own."""
    function = subject.simulator.usb_function(simulator)
    function.strings = (*function.strings[:-1], serial)
    return function


def acm(_subject: Subject, simulator: object, serial: str) -> UsbFunction:
    """The instrument behind a CDC-ACM device."""
    return AcmFunction(simulator, serial=serial)  # type: ignore[arg-type]


def _any_panel(subject: Subject) -> object:
    from paintlink.conformance.exam import panel

    return panel(subject.kit)
