"""The only place that opens ports: serial lines, their discovery, captured sessions."""

from paintlink.links.capture import (
    Call,
    Capture,
    CaptureWriter,
    Event,
    Verb,
    read_capture,
)
from paintlink.links.ports import PortInfo, candidates, is_simulated_path
from paintlink.links.replay import Outcome, ReplayStream, replay
from paintlink.links.stream import SerialStream, open_serial

__all__ = [
    "Call",
    "Capture",
    "CaptureWriter",
    "Event",
    "Outcome",
    "PortInfo",
    "ReplayStream",
    "SerialStream",
    "Verb",
    "candidates",
    "is_simulated_path",
    "open_serial",
    "read_capture",
    "replay",
]
