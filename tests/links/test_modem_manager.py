import os
from pathlib import Path

import pytest

from paintlink.links.modem_manager import disturbs


@pytest.fixture
def machine(tmp_path):
    """Return folders that look as /proc and /run/udev/data do with ModemManager."""
    proc, udev = tmp_path / "proc", tmp_path / "udev"
    (proc / "41").mkdir(parents=True)
    (proc / "41" / "comm").write_text("ModemManager\n")
    (proc / "sys").mkdir()
    udev.mkdir()
    return {"proc": proc, "udev": udev}


def udev_file(machine, device):
    number = Path(device).stat().st_rdev
    return machine["udev"] / f"c{os.major(number)}:{os.minor(number)}"


def test_port_that_modem_manager_may_open_is_told(machine, terminal):
    text = disturbs(terminal.path, **machine)

    assert text.startswith(f"ModemManager may talk to {terminal.path}: run `sudo ")


@pytest.mark.parametrize("name", ["ID_MM_PORT_IGNORE", "ID_MM_DEVICE_IGNORE"])
def test_marked_port_is_left_alone(machine, terminal, name):
    udev_file(machine, terminal.path).write_text(f"E:ID_BUS=usb\nE:{name}=1\n")

    assert disturbs(terminal.path, **machine) == ""


def test_without_modem_manager_nothing_is_said(machine, terminal):
    (machine["proc"] / "41" / "comm").write_text("bash\n")

    assert disturbs(terminal.path, **machine) == ""
    assert disturbs(terminal.path, proc=Path("/nowhere"), udev=machine["udev"]) == ""
