"""The only place that opens ports: serial lines, USB, discovery, captured sessions."""

from paintlink.links.addresses import Kind, kind_of
from paintlink.links.capture import (
    Call,
    Capture,
    CaptureWriter,
    Event,
    Verb,
    read_capture,
)
from paintlink.links.dial import open_link
from paintlink.links.hotplug import Hotplug, matches
from paintlink.links.ports import PortInfo, candidates, is_simulated_path
from paintlink.links.replay import Outcome, ReplayStream, replay
from paintlink.links.stream import SerialStream, open_serial

__all__ = [
    "Call",
    "Capture",
    "CaptureWriter",
    "Event",
    "Hotplug",
    "Kind",
    "Outcome",
    "PortInfo",
    "ReplayStream",
    "SerialStream",
    "Verb",
    "candidates",
    "is_simulated_path",
    "kind_of",
    "matches",
    "open_link",
    "open_serial",
    "read_capture",
    "replay",
]
