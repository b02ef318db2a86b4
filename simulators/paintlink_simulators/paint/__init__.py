"""The virtual panel an instrument measures, and the noise of measuring it."""

from paintlink_simulators.paint.noise import (
    LABORATORY,
    TYPICAL,
    WORKSHOP,
    Repeatability,
    noisy,
)
from paintlink_simulators.paint.panel import WAVELENGTHS_NM, Panel, panel_from_lab

__all__ = [
    "LABORATORY",
    "TYPICAL",
    "WAVELENGTHS_NM",
    "WORKSHOP",
    "Panel",
    "Repeatability",
    "noisy",
    "panel_from_lab",
]
