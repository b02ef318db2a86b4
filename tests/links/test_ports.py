import os
from pathlib import Path

import pytest
from serial.tools.list_ports_common import ListPortInfo

from paintlink.instrument import SerialSettings
from paintlink.links import candidates, is_simulated_path, open_serial
from paintlink.links.ports import describe


def adapter(device):
    port = ListPortInfo(device)
    port.vid, port.pid = 0x0403, 0x6001
    port.serial_number = "SIM0001"
    port.description = "MA5"
    return port


def test_adapter_is_described_with_its_lasting_name(tmp_path, terminal):
    by_id = tmp_path / "by-id"
    by_id.mkdir()
    (by_id / "usb-other").symlink_to("/dev/null")
    (by_id / "usb-paintlink_MA5_SIM0001").symlink_to(terminal.path)

    port = describe(adapter(terminal.path), by_id)

    assert port.device == terminal.path
    assert port.by_id == str(by_id / "usb-paintlink_MA5_SIM0001")
    assert (port.usb_id, port.serial_number) == ("0403:6001", "SIM0001")
    assert port.description == "MA5"


def test_plain_port_leaves_the_unknown_empty(tmp_path):
    port = describe(ListPortInfo("/dev/null"), tmp_path / "none")

    assert (port.by_id, port.usb_id, port.serial_number, port.description) == (
        *("", "", "", ""),
    )


def test_port_in_use_names_its_holder(tmp_path, terminal):
    port = describe(adapter(terminal.path), tmp_path)

    assert "in use by" in port.problem
    assert f"(process {os.getpid()})" in port.problem


def test_free_port_has_no_problem(tmp_path):
    device = tmp_path / "tty"
    device.touch()

    assert describe(adapter(str(device)), tmp_path).problem == ""


def test_closed_port_says_how_to_get_access(tmp_path):
    port = describe(adapter(str(tmp_path / "gone")), tmp_path)

    assert "no permission to open" in port.problem


def test_listing_opens_nothing(terminal, tmp_path):
    held = open_serial(terminal.path, SerialSettings())

    ports = candidates(tmp_path)

    held.close()
    assert [port.device for port in ports] == sorted(port.device for port in ports)


def test_pseudo_terminal_is_simulated_under_any_name(terminal, tmp_path):
    link = tmp_path / "ttyUSB0"
    link.symlink_to(terminal.path)

    assert is_simulated_path(terminal.path)
    assert is_simulated_path(str(link))


def test_pseudo_terminal_stays_simulated_after_unplug(terminal, tmp_path):
    link = tmp_path / "ttyUSB0"
    link.symlink_to(terminal.path)
    terminal.unplug()

    assert is_simulated_path(str(link))


def test_renamed_pseudo_terminal_is_still_one(terminal, tmp_path):
    node = tmp_path / "ttyUSB0"
    try:
        os.mknod(node, 0o020600, Path(terminal.path).stat().st_rdev)
    except PermissionError:
        pytest.skip("only root can make a device node")

    assert is_simulated_path(str(node))


@pytest.mark.parametrize(
    "address",
    [
        "socket://127.0.0.1:7000",
        "rfc2217://localhost:7001?ign_set_control",
        "usb+ip://127.0.0.1:3240/1-2",
        "usb+ip://[::1]/1-2",
    ],
)
def test_this_computers_own_network_address_is_simulated(address):
    assert is_simulated_path(address)


@pytest.mark.parametrize(
    "path",
    [
        *("/dev/null", "/dev/ttyUSB0", "/dev/pts2", "socket://192.168.1.20:4001"),
        *("usb://0765:d020", "usb+ip://lab-bench:3240/1-2", "socket://1.127.0.0:1"),
    ],
)
def test_anything_else_is_not_simulated(path):
    assert not is_simulated_path(path)
