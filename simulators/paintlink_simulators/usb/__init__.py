"""Simulated instruments as USB devices: functions, the engine, a socket of the bus."""

from paintlink_simulators.usb._requests import Setup, StallError
from paintlink_simulators.usb.engine import Engine, Urb
from paintlink_simulators.usb.function import UsbFunction
from paintlink_simulators.usb.serial import AcmFunction, Ch341Function, FtdiFunction
from paintlink_simulators.usb.socket import UsbSocket
from paintlink_simulators.usb.vendor import RciFunction, VendorFunction

__all__ = [
    "AcmFunction",
    "Ch341Function",
    "Engine",
    "FtdiFunction",
    "RciFunction",
    "Setup",
    "StallError",
    "Urb",
    "UsbFunction",
    "UsbSocket",
    "VendorFunction",
]
