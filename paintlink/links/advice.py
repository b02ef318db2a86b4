"""What went wrong with a port, said so that the operator can put it right."""

from __future__ import annotations

import errno
import grp
import termios
from collections.abc import Callable, Iterator
from pathlib import Path

from serial import SerialTimeoutException
from serial.tools import list_ports

from paintlink.errors import LinkError, LinkTimeoutError
from paintlink.instrument import SerialSettings

# termios.error is no OSError, and pyserial lets it through in places.
FAILURES = (OSError, ValueError, termios.error)


def cannot_open(
    address: str, settings: SerialSettings, failure: Exception
) -> LinkError:
    """Return the error to raise when opening failed."""
    code, reason = _system_error(failure)
    if isinstance(failure, ValueError):
        msg = f"{address} is no address of a port: {FORMS}"
    elif "option 'control'" in str(failure):
        msg = (
            f"{address} cannot set the DTR and RTS lines: write "
            f"{address}?ign_set_control"
        )
    elif "://" in address:
        msg = (
            f"{address} cannot be reached ({reason}): check host and port, and that "
            "the serial server runs"
        )
    elif code == errno.EINVAL:
        msg = (
            f"{address} refuses {settings.summary}: check the settings of this "
            "instrument; a pseudo-terminal carries 8 data bits without parity only"
        )
    elif code in _OPENING:
        msg = _OPENING[code](address)
    else:
        msg = (
            f"{address} cannot be opened ({reason}): plug the adapter out and in again"
        )
    return LinkError(msg)


def lost(address: str, failure: Exception) -> LinkError:
    """Return the error to raise when an open port stopped working."""
    if isinstance(failure, SerialTimeoutException):
        msg = f"{address} takes no more bytes: switch the instrument off and on"
        return LinkTimeoutError(msg)
    msg = f"the connection to {address} is lost: check the plug and the cable"
    return LinkError(msg)


def no_permission(address: str) -> str:
    """Return how to get access to a device."""
    group = _group(address)
    if group == "root":
        return (
            f"no permission to open {address}, only root may: ask the administrator "
            "for a udev rule that gives it to the group dialout"
        )
    return (
        f"no permission to open {address}: run `sudo usermod -aG {group} $USER`, then "
        "log out and in again"
    )


def in_use(address: str, users: tuple[str, ...]) -> str:
    """Return who keeps a device from us."""
    names = " and ".join(users) or "another program"
    return f"{address} is in use by {names}: close it there first"


def users_of(device: str) -> tuple[str, ...]:
    """Return the programs that have a device open, as far as /proc shows them to us."""
    target = str(Path(device).resolve())
    processes = [path for path in Path("/proc").iterdir() if path.name.isdigit()]
    return tuple(
        f"{_text(process / 'comm') or 'a program'} (process {process.name})"
        for process in processes
        if target in _open_files(process)
    )


def _open_files(process: Path) -> Iterator[str]:
    try:
        links = list((process / "fd").iterdir())
    except OSError:
        return
    for link in links:
        try:
            yield str(link.readlink())
        except OSError:
            continue


def _text(path: Path) -> str:
    try:
        return path.read_text().strip()
    except OSError:
        return ""


def _group(address: str) -> str:
    try:
        return grp.getgrgid(Path(address).stat().st_gid).gr_name
    except (KeyError, OSError):
        return "dialout"


def _system_error(failure: BaseException) -> tuple[int | None, str]:
    """Return the system's error number and text; pyserial may hide them one deeper."""
    for cause in (failure, failure.__cause__ or failure.__context__):
        if cause and cause.args and isinstance(cause.args[0], int):
            return cause.args[0], str(cause.args[-1])
    return None, str(failure)


FORMS = (
    "write a device such as /dev/ttyUSB0, socket://host:port, rfc2217://host:port, "
    "usb://VID:PID/SERIAL or usb+ip://host:port/busid"
)


def _missing(address: str) -> str:
    ports = ", ".join(sorted(port.device for port in list_ports.comports()))
    choice = f"choose one of {ports}" if ports else "no serial port is present now"
    return f"{address} does not exist: plug the instrument in; {choice}"


def _busy(address: str) -> str:
    return in_use(address, users_of(address))


def _no_port(address: str) -> str:
    return f"{address} is not a serial port: {FORMS}"


def _no_hardware(address: str) -> str:
    return f"{address} has no hardware behind it: choose another port"


_OPENING: dict[int | None, Callable[[str], str]] = {
    errno.ENOENT: _missing,
    errno.EACCES: no_permission,
    errno.EPERM: no_permission,
    errno.EAGAIN: _busy,
    errno.EBUSY: _busy,
    errno.ENOTTY: _no_port,
    errno.EISDIR: _no_port,
    errno.EIO: _no_hardware,
    errno.ENXIO: _no_hardware,
    errno.ENODEV: _no_hardware,
}
