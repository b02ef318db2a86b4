"""Values and a journal for the tests of the daemon."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from paintlink.daemon.journal import Journal
from paintlink.model import (
    Calibration,
    ColorSpec,
    Geometry,
    Gloss,
    Instrument,
    Lab,
    Measurement,
    Reading,
    Sample,
    Spectra,
    Texture,
)

NOON = datetime(2026, 11, 22, 12, 0, 0, 123456, tzinfo=UTC)
ANGLES = (15.0, 25.0, 45.0, 75.0, 110.0)


def make_reading(*, raw: bytes = b"\x00raw", origin: str = "real") -> Reading:
    """A five-angle reading of a paint that darkens towards the flop."""
    levels = np.linspace(0.9, 0.1, 5)[:, None] * np.linspace(0.8, 1.2, 31)
    measurement = Measurement(
        geometries=tuple(Geometry(a, code=f"45as{a:g}") for a in ANGLES),
        spectra=Spectra(np.arange(400.0, 701.0, 10.0), levels),
        gloss=Gloss(92.5, 60.0),
        texture=(Texture("sparkle intensity", 3.25, 15.0),),
        averaged=3,
        data_mode="native",
        raw=raw,
    )
    return Reading(
        measurement,
        Instrument("X-Rite", "MA68II", "4711", "3.02"),
        NOON,
        origin,  # type: ignore[arg-type]
        Calibration("valid", NOON),
        "bonnet",
    )


def make_spec(name: str = "bonnet") -> ColorSpec:
    """A three-angle specification without provenance."""
    labs = {15.0: (80.1, 2.0, -3.5), 45.0: (50.0, 1.0, -2.0), 110.0: (30.0, 0.5, -1.0)}
    return ColorSpec(name, tuple(Sample(a, Lab(*lab)) for a, lab in labs.items()))


@pytest.fixture
def journal(tmp_path: Path) -> Iterator[Journal]:
    """An empty journal whose clock stands still."""
    with Journal(tmp_path / "journal.db", now=lambda: NOON) as opened:
        yield opened
