"""Where a simulated USB device is plugged in, and out again."""

from __future__ import annotations

import itertools

from paintlink_simulators.usb.engine import Engine
from paintlink_simulators.usb.function import UsbFunction

_numbers = itertools.count(2)


class UsbSocket:
    """One place on an imaginary bus; hosts look at ``engine``, None when it is empty.

    Attributes
    ----------
    address
        Number of the device on bus 1; another one after each replugging.
    """

    def __init__(self, function: UsbFunction) -> None:
        self.function = function
        self.engine: Engine | None = None
        self.address = 0
        self.replug()

    @property
    def busid(self) -> str:
        """Where it is, as Linux writes it."""
        return f"1-{self.address}"

    @property
    def live(self) -> Engine | None:
        """The engine while the device is there: a fault may have taken it away."""
        return None if self.engine is None or self.engine.gone else self.engine

    def replug(self) -> None:
        """Plug it in; it has forgotten everything owed."""
        self.unplug()
        self.function.reset()
        self.address = next(_numbers)
        self.engine = Engine(self.function)

    def unplug(self) -> None:
        """Pull the cable: every request ends."""
        if self.engine is not None:
            self.engine.unplug()
        self.engine = None

    def press(self) -> None:
        """Press the instrument down."""
        if self.engine is not None:
            self.engine.press()

    def close(self) -> None:
        """Unplug it for good."""
        self.unplug()
