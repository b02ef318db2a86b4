"""What the journal keeps of each instrument: calibrations, check tiles."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from paintlink.color import cie76
from paintlink.daemon.database import Database
from paintlink.model import Lab

WARN_dE, ALARM_dE = 0.5, 1.0
Verdict = Literal["first", "steady", "warning", "alarm"]


@dataclass(frozen=True, slots=True)
class TileCheck:
    """One reading of a check tile.

    ``drift`` is its CIE76 difference to the first one of the same tile on the same
    instrument, by the angles both have; empty for the first one.
    """

    tile: str
    at: datetime
    angles_deg: tuple[float, ...]
    lab: tuple[Lab, ...]
    drift: Mapping[float, float]

    @property
    def verdict(self) -> Verdict:
        """What the largest difference means."""
        if not self.drift:
            return "first"
        largest = max(self.drift.values())
        if largest >= ALARM_dE:
            return "alarm"
        return "warning" if largest >= WARN_dE else "steady"


class Bench:
    """Calibrations and tile checks, by the instrument's identity."""

    def __init__(self, db: Database) -> None:
        self._db = db

    def calibrated(self, instrument: str, how: str) -> None:
        """Keep that an instrument was calibrated just now."""
        with self._db.transaction():
            self._db.insert(
                "calibrations", instrument=instrument, at=self._db.stamp(), how=how
            )

    def last_calibration(self, instrument: str) -> datetime | None:
        """When an instrument was calibrated last; None when that is not known."""
        row = self._db.one(
            "SELECT at FROM calibrations WHERE instrument = ? ORDER BY id DESC LIMIT 1",
            instrument,
        )
        return datetime.fromisoformat(row["at"]) if row else None

    def check_tile(
        self, instrument: str, tile: str, angles_deg: tuple[float, ...], lab: list[Lab]
    ) -> TileCheck:
        """Keep a reading of a check tile, and compare it with the first one."""
        document = json.dumps({"angles_deg": angles_deg, "lab": lab})
        with self._db.transaction():
            self._db.insert(
                "tile_checks",
                instrument=instrument,
                tile=tile,
                at=self._db.stamp(),
                document=document,
            )
        return self.tile_checks(instrument, tile)[-1]

    def tile_checks(self, instrument: str, tile: str = "") -> tuple[TileCheck, ...]:
        """The readings of one tile, or of all of them, oldest first."""
        rows = self._db.all(
            "SELECT * FROM tile_checks WHERE instrument = ? "
            "AND tile = coalesce(?, tile) ORDER BY id",
            instrument,
            tile or None,
        )
        first: dict[str, TileCheck] = {}
        checks = []
        for row in rows:
            check = _check_from(row, first.get(row["tile"]))
            first.setdefault(row["tile"], check)
            checks.append(check)
        return tuple(checks)


def _check_from(row: sqlite3.Row, first: TileCheck | None) -> TileCheck:
    data = json.loads(row["document"])
    angles = tuple(data["angles_deg"])
    lab = tuple(Lab(*one) for one in data["lab"])
    at = datetime.fromisoformat(row["at"])
    drift = _drift(first, angles, lab) if first else {}
    return TileCheck(row["tile"], at, angles, lab, drift)


def _drift(
    first: TileCheck, angles: tuple[float, ...], lab: tuple[Lab, ...]
) -> dict[float, float]:
    """Differences at the angles that the first reading has as well."""
    then = dict(zip(first.angles_deg, first.lab, strict=True))
    return {
        angle: float(cie76(then[angle], now))
        for angle, now in zip(angles, lab, strict=True)
        if angle in then
    }
