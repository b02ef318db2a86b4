"""The panel of the exam, for lists that need no driver."""

from __future__ import annotations

import paintlink_simulators
from paintlink.conformance import exam

SEED = exam.SEED


def panel() -> paintlink_simulators.Panel:
    """The panel every driver is examined on."""
    return exam.panel(paintlink_simulators)
