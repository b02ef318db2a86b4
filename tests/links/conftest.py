import os
import tty

import pytest


class Terminal:
    """A real pseudo-terminal: ``path`` is the port, ``master`` the instrument's end."""

    def __init__(self):
        self.master, self._slave = os.openpty()
        tty.setraw(self.master)
        tty.setraw(self._slave)
        self.path = os.ttyname(self._slave)
        self._plugged = True

    def unplug(self):
        if self._plugged:
            self._plugged = False
            os.close(self.master)
            os.close(self._slave)


@pytest.fixture
def terminal():
    terminal = Terminal()
    yield terminal
    terminal.unplug()
