"""The panel of the exam, for lists that need no driver."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import paintlink_simulators
from paintlink.conformance import exam

SEED = exam.SEED


def panel() -> paintlink_simulators.Panel:
    """The panel every driver is examined on."""
    return exam.panel(paintlink_simulators)


def simulator_module(name: str) -> Any:
    """The module of a simulated instrument."""
    return import_module(f"paintlink_simulators.{name}")
