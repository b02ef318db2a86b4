"""What is kept of the journal, where, and for how long."""

from __future__ import annotations

import logging
import sqlite3
from datetime import datetime, timedelta
from pathlib import Path

from paintlink.daemon.database import Database

log = logging.getLogger(__name__)


class Keeping:
    """Copies of the journal, and what is taken out of it."""

    def __init__(self, database: Database) -> None:
        self._db = database

    def copy_to(self, target: sqlite3.Connection) -> None:
        """Write a consistent copy of the journal, while others go on."""
        self._db.copy_to(target)

    def forget_unsettled(self, reason: str) -> int:
        """Number of deliveries whose fate is not known any more, and which wait."""
        with self._db.transaction():
            rows = self._db.all(
                "SELECT * FROM deliveries WHERE state IN ('pending', 'publishing')"
            )
            for row in rows:
                note = f"{reason}: look whether it arrived, then resend it or leave it"
                self._db.update("deliveries", row["id"], state="unknown", error=note)
                self._db.log(row["job_id"], "unknown", f"{row['route']} {note}")
        return len(rows)

    def prune(self, before: str) -> list[str]:
        """Pictures of closed jobs older than a time, whose bulky parts are removed.

        The jobs, their specifications and their whole history stay.
        """
        with self._db.transaction():
            rows = self._db.all(
                "SELECT id FROM jobs WHERE created_at < ? AND state IN ('done', "
                "'failed') AND id NOT IN (SELECT job_id FROM events WHERE kind = "
                "'pruned') AND id NOT IN (SELECT job_id FROM deliveries WHERE state "
                "IN ('pending', 'publishing', 'unknown')) ORDER BY id LIMIT 500",
                before,
            )
            pictures = []
            for (job_id,) in rows:
                row = self._db.one("SELECT path FROM previews WHERE job_id = ?", job_id)
                pictures += [row["path"]] if row and row["path"] else []
                self._db.run("DELETE FROM matches WHERE job_id = ?", job_id)
                self._db.run("DELETE FROM previews WHERE job_id = ?", job_id)
                self._db.run("UPDATE readings SET raw = x'' WHERE job_id = ?", job_id)
                self._db.log(job_id, "pruned", f"older than {before}")
        return pictures


def clear_out(keeping: Keeping, keep_days: int, now: datetime) -> bool:
    """Whether there may be more to remove; with 0 days everything is kept."""
    if keep_days == 0:
        return False
    before = (now - timedelta(days=keep_days)).isoformat()
    pictures = keeping.prune(before)
    for picture in pictures:
        try:
            Path(picture).unlink(missing_ok=True)
            Path(picture).with_suffix(".json").unlink(missing_ok=True)
        except OSError as error:
            log.warning("%s: %s; remove it by hand", picture, error.strerror)
    return bool(pictures)
