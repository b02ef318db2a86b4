"""A context of libusb ends after its devices, whatever pyusb drops first."""

from __future__ import annotations

import ctypes
import gc
from collections.abc import Callable
from typing import Any

import pytest
import usb.backend.libusb1
import usb.core

from paintlink.links.libusb_backend import OrderlyBackend

DEVICES = (ctypes.c_void_p * 2)(0x1000, 0x2000)


class Recorder:
    """A libusb that knows two devices and writes down what ends when."""

    def __init__(self) -> None:
        self.ended: list[str] = []

    def libusb_get_device_list(self, _context: object, place: Any) -> int:
        ctypes.memmove(
            ctypes.addressof(place._obj),
            ctypes.byref(ctypes.c_void_p(ctypes.addressof(DEVICES))),
            ctypes.sizeof(ctypes.c_void_p),
        )
        return len(DEVICES)

    def libusb_init(self, context: Any) -> int:
        context._obj.value = 0x3000
        return 0

    def libusb_ref_device(self, device: int) -> int:
        return device

    def libusb_unref_device(self, device: int) -> None:
        self.ended.append(f"device {device:x}")

    def libusb_exit(self, _context: object) -> None:
        self.ended.append("context")

    def libusb_get_device_descriptor(self, _device: int, place: Any) -> int:
        place._obj.idVendor = 0x0765
        return 0

    def __getattr__(self, _name: str) -> Callable[..., int]:
        return lambda *_arguments: 0


@pytest.fixture
def recorder(monkeypatch: pytest.MonkeyPatch) -> Recorder:
    recorder = Recorder()
    monkeypatch.setattr(usb.backend.libusb1, "_lib", recorder)
    return recorder


def test_context_ends_after_its_devices(recorder: Recorder) -> None:
    found = usb.core.find(backend=OrderlyBackend(recorder), idVendor=0x0765)
    assert not recorder.ended

    del found
    gc.collect()

    assert recorder.ended == ["device 1000", "device 2000", "context"]


def test_pyusb_alone_still_ends_the_context_first(recorder: Recorder) -> None:
    """Once this fails, `OrderlyBackend` is no longer needed."""
    backend = usb.backend.libusb1._LibUSB(recorder)
    found = usb.core.find(backend=backend, idVendor=0x0765)
    del backend

    del found
    gc.collect()

    assert recorder.ended.index("context") < recorder.ended.index("device 1000")
