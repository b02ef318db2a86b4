import errno
import grp
import os
import termios

import pytest
from serial import SerialException

from paintlink.instrument import SerialSettings
from paintlink.links.advice import cannot_open, lost, no_permission, users_of

LINE = SerialSettings()


def opening(failure, address="/dev/ttyUSB0"):
    return str(cannot_open(address, LINE, failure))


@pytest.mark.parametrize(
    ("code", "text"),
    [
        (errno.ENOENT, "/dev/ttyUSB0 does not exist: plug the instrument in"),
        (errno.EACCES, "run `sudo usermod -aG dialout $USER`, then log out"),
        (errno.EPERM, "no permission to open /dev/ttyUSB0"),
        (errno.EAGAIN, "in use by another program: close it there first"),
        (errno.EBUSY, "in use by another program"),
        (errno.ENOTTY, "not a serial port: write a device such as /dev/ttyUSB0"),
        (errno.EIO, "has no hardware behind it: choose another port"),
        (errno.ENODEV, "has no hardware behind it"),
        (errno.EINVAL, "refuses 9600 8N1: check the settings"),
        (errno.ENOMEM, "cannot be opened (text): plug the adapter out and in again"),
    ],
)
def test_each_system_error_has_its_sentence(code, text):
    assert text in opening(SerialException(code, "text"))


def test_number_hidden_by_pyserial_is_found():
    try:
        try:
            raise termios.error(25, "Inappropriate ioctl for device")
        except termios.error as inner:
            raise SerialException(f"Could not configure port: {inner}") from None
    except SerialException as failure:
        text = opening(failure)

    assert "is not a serial port" in text


def test_unrelated_earlier_failure_is_not_blamed():
    try:
        raise FileNotFoundError(errno.ENOENT, "long ago")
    except FileNotFoundError:
        try:
            try:
                raise PermissionError(errno.EACCES, "now")
            except PermissionError as inner:
                raise SerialException("could not open port") from inner
        except SerialException as failure:
            text = opening(failure)

    assert "no permission" in text


def test_group_of_the_device_is_named(tmp_path):
    device = tmp_path / "tty"
    device.touch()
    group = next(group for group in grp.getgrall() if group.gr_name != "root")
    if os.geteuid() == 0:
        os.chown(device, -1, group.gr_gid)
    name = grp.getgrgid(device.stat().st_gid).gr_name

    assert f"usermod -aG {name} $USER" in no_permission(str(device))


def test_group_root_is_never_recommended(tmp_path):
    if os.geteuid() != 0:
        pytest.skip("only root can make a file of the group root")
    device = tmp_path / "tty"
    device.touch()
    os.chown(device, -1, 0)

    sentence = no_permission(str(device))

    assert "usermod" not in sentence
    assert "ask the administrator for a udev rule" in sentence


def test_holder_of_a_device_is_found(terminal):
    (user,) = users_of(terminal.path)

    assert user.endswith(f"(process {os.getpid()})")
    assert users_of("/dev/no such device") == ()


def test_lost_link_keeps_its_address():
    assert str(lost("/dev/ttyUSB0", OSError(5, "x"))) == (
        "the connection to /dev/ttyUSB0 is lost: check the plug and the cable"
    )
