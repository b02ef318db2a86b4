"""Serial lines of the kernel's own drivers: what pyserial sees, and what the device."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path

import serial
from serial.tools import list_ports

from paintlink_simulators import xrite_ma
from paintlink_simulators.usb import AcmFunction, FtdiFunction, UsbSocket
from paintlink_simulators.usb.serial import SerialFunction
from tests.conformance.bench import SEED, panel
from tests.lab.vhci import Plug, serial_node, wait_for

KINDS: dict[str, type[SerialFunction]] = {"ttyACM": AcmFunction, "ttyUSB": FtdiFunction}
IDENTITY = b"X-RITE MA68II 3.02\r\n"
EVEN_7 = {"bytesize": serial.SEVENBITS, "parity": serial.PARITY_EVEN}
SETTINGS = {
    "115200 8N1": {"baudrate": 115200},
    "250000 8N1": {"baudrate": 250000},
    "9600 7E1": {"baudrate": 9600, **EVEN_7},
    "9600 8N2": {"baudrate": 9600, "stopbits": serial.STOPBITS_TWO},
}
SAME = {
    "identity": repr(IDENTITY),
    "250000 8N1": "250000 8N1",
    "9600 7E1": "9600 7E1",
    "9600 8N2": "9600 8N2",
    "DTR off": "DTR False, RTS True",
    "break": "1",
    "unplugged while reading": "SerialException",
    "node when unplugged": "False",
}
EXPECTED = {
    "ttyACM": {
        "listed": "1209:0002 SIMLINE MA5",
        "115200 8N1": "115200 8N1",
        "CTS DSR RI CD": "True False False False",
        **SAME,
    },
    "ttyUSB": {
        "listed": "0403:6001 SIMLINE MA5",
        # 3 MHz divided by the nearest eighth of 26
        "115200 8N1": "115385 8N1",
        "CTS DSR RI CD": "True True False False",
        **SAME,
    },
}
SOON_S, PATIENCE_S = 0.1, 5.0


def compare_lines() -> list[str]:
    """A line for each check in which a serial line differs; prints all."""
    lines = []
    for kind, expected in EXPECTED.items():
        seen = _observe(kind)
        for check, wanted in expected.items():
            got = seen.get(check, "not reached")
            print(f"{kind} {check:24} {got}", flush=True)
            if got != wanted:
                lines.append(f"{kind} {check}: {got}, expected {wanted}")
    return lines


def _observe(kind: str) -> dict[str, str]:
    simulator = xrite_ma.create(panel(), clock=time.monotonic, seed=SEED)
    function = KINDS[kind](simulator, serial="SIMLINE")
    plug = Plug(UsbSocket(function), 0)
    node = wait_for(lambda: serial_node(plug.place), f"the {kind}")
    seen = {"listed": _listed(node)}
    with serial.Serial(str(node), timeout=PATIENCE_S) as port:
        seen |= _talk(port) | _settings(port, function) | _modem(port, function)
        seen["unplugged while reading"] = _unplugged(port, plug.unplug)
        # Still open: a node that stayed would lead to the wrong instrument.
        wait_for(lambda: not node.exists(), f"the end of {node}")
        seen["node when unplugged"] = str(node.exists())
    plug.forget()
    return seen


def _listed(node: Path) -> str:
    found = next(one for one in list_ports.comports() if one.device == str(node))
    return f"{found.vid:04x}:{found.pid:04x} {found.serial_number} {found.product}"


def _talk(port: serial.Serial) -> dict[str, str]:
    port.write(b"v\r")
    return {"identity": repr(port.read_until(b"\n"))}


def _settings(port: serial.Serial, function: SerialFunction) -> dict[str, str]:
    seen = {}
    plain = port.get_settings()
    for name, changed in SETTINGS.items():
        port.apply_settings({**plain, **changed})
        line = function.host_line
        form = f"{line.bytesize}{line.parity}{line.stopbits:g}"
        seen[name] = f"{line.baudrate:.0f} {form}"
    port.apply_settings(plain)
    return seen


def _modem(port: serial.Serial, function: SerialFunction) -> dict[str, str]:
    inputs = f"{port.cts} {port.dsr} {port.ri} {port.cd}"
    port.dtr = False
    outputs = f"DTR {function.dtr}, RTS {function.rts}"
    before = function.breaks
    port.send_break(0.05)
    breaks = str(function.breaks - before)
    return {"CTS DSR RI CD": inputs, "DTR off": outputs, "break": breaks}


def _unplugged(port: serial.Serial, unplug: Callable[[], None]) -> str:
    timer = threading.Timer(SOON_S, unplug)
    timer.start()
    try:
        return repr(port.read(1))
    except serial.SerialException as error:
        return type(error).__name__
    finally:
        timer.join()
