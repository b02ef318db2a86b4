"""The journal's ledger of files on their way into other programs' folders."""

from __future__ import annotations

import sqlite3
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from paintlink.daemon.database import Database
from paintlink.daemon.records import Delivery, DeliveryState

FARTHEST_RETRY_S = 60.0  # a later one was set by a clock that has been put back


class Waiting(NamedTuple):
    """Deliveries of one route that are not in its folder yet; one of their errors."""

    number: int
    since: str
    error: str


class Deliveries:
    """State of every delivery; see `paintlink.daemon.records.DeliveryState`."""

    def __init__(self, database: Database) -> None:
        self._db = database

    def open(self, job_id: int, route: str, folder: str, *, copy: int) -> None:
        """Add a delivery inside the caller's transaction; a repeat changes nothing."""
        self._db.run(
            "INSERT OR IGNORE INTO deliveries (job_id, route, copy, folder, state, "
            "opened_at) VALUES (?, ?, ?, ?, 'pending', ?)",
            job_id,
            route,
            copy,
            folder,
            self._db.stamp(),
        )

    def due(
        self, now_s: float, *, route: str | None = None, without: Sequence[str] = ()
    ) -> Delivery | None:
        """The delivery to work on next: interrupted ones first."""
        found = self.due_together(now_s, 1, route=route, without=without)
        return found[0] if found else None

    def due_together(
        self,
        now_s: float,
        limit: int,
        *,
        route: str | None = None,
        without: Sequence[str] = (),
    ) -> tuple[Delivery, ...]:
        """Deliveries to work on next, of one route and state: interrupted ones first.

        None is staged into a folder where another one is still being published:
        staging would make a lost staging folder anew and hide the loss.

        Parameters
        ----------
        route, without
            Only those of this route; none of these routes.
        """
        marks = ", ".join("?" * len(without))
        rows = self._db.all(
            "SELECT * FROM deliveries AS d WHERE state IN ('pending', 'publishing') "
            "AND (retry_at <= ? OR retry_at > ?) AND (? IS NULL OR route = ?) "
            f"AND route NOT IN ({marks}) "
            "AND (state = 'publishing' OR NOT EXISTS ("
            "SELECT 1 FROM deliveries WHERE state = 'publishing' "
            "AND folder = d.folder)) ORDER BY state DESC, retry_at, id LIMIT ?",
            now_s,
            now_s + FARTHEST_RETRY_S,
            route,
            route,
            *without,
            limit,
        )
        found = [delivery_from_row(row) for row in rows]
        return tuple(
            one
            for one in found
            if (one.state, one.route, one.folder)
            == (found[0].state, found[0].route, found[0].folder)
        )

    def state_of(self, delivery_id: int) -> DeliveryState | None:
        """State of a delivery as it is now."""
        row = self._db.one("SELECT state FROM deliveries WHERE id = ?", delivery_id)
        return row["state"] if row else None

    def next_retry_s(self) -> float | None:
        """When the next postponed delivery becomes due, in seconds since 1970."""
        row = self._db.one(
            "SELECT min(retry_at) FROM deliveries "
            "WHERE state IN ('pending', 'publishing')"
        )
        return None if row is None or row[0] is None else float(row[0])

    def lying(self, route: str | None = None) -> tuple[Delivery, ...]:
        """Files that lay in their folder when last looked at."""
        sql = (
            "SELECT * FROM deliveries WHERE state IN ('written', 'stale') "
            "AND (? IS NULL OR route = ?)"
        )
        rows = self._db.all(sql, route, route)
        return tuple(delivery_from_row(row) for row in rows)

    def waiting(self) -> dict[str, Waiting]:
        """What waits in each route, those with nothing left out."""
        rows = self._db.all(
            "SELECT route, count(*), min(opened_at), max(error) FROM deliveries "
            "WHERE state IN ('pending', 'publishing') GROUP BY route"
        )
        return {row[0]: Waiting(row[1], row[2], row[3]) for row in rows}

    def last_written_at(self, route: str) -> str:
        """When a file of the route was last seen to be whole; empty when never."""
        row = self._db.one(
            "SELECT max(written_at) FROM deliveries WHERE route = ?", route
        )
        return str(row[0] or "") if row else ""

    def set_publishing(self, delivery: Delivery, name: str, sha256: str) -> Delivery:
        """The delivery, its staged file on disk, which from here on is the token."""
        with self._db.transaction():
            self._db.update(
                "deliveries", delivery.id, state="publishing", name=name, sha256=sha256
            )
            self._db.log(
                delivery.job_id,
                "staged",
                f"{delivery.route} {name}",
                delivery=delivery.id,
                sha256=sha256,
            )
        return replace(delivery, state="publishing", name=name, sha256=sha256)

    def settle(self, delivery: Delivery, state: DeliveryState, note: str = "") -> None:
        """Move a delivery to a state after ``publishing``; a note says why."""
        columns = {"written_at": self._db.stamp()} if state == "written" else {}
        columns["error"] = note if state in {"stale", "unknown", "failed"} else ""
        with self._db.transaction():
            self._db.update("deliveries", delivery.id, state=state, **columns)
            self._db.log(
                delivery.job_id,
                state,
                f"{delivery.route} {note}".strip(),
                delivery=delivery.id,
                path=f"{delivery.folder}/{delivery.name}",
                sha256=delivery.sha256,
            )
            self._finish_job(delivery.job_id)

    def postpone(self, delivery: Delivery, retry_at_s: float, error: str) -> None:
        """Try again later, from the same state.

        A staged file may already have been published when the error came: going back
        to ``pending`` would write it twice.
        """
        with self._db.transaction():
            self._db.update(
                "deliveries",
                delivery.id,
                retry_at=retry_at_s,
                attempts=delivery.attempts + 1,
                error=error,
            )
            if delivery.attempts == 0:
                self._db.log(delivery.job_id, "postponed", f"{delivery.route}: {error}")

    def _finish_job(self, job_id: int) -> None:
        """Close a job in the same transaction as the last of its deliveries."""
        row = self._db.one(
            "SELECT state, (SELECT count(*) FROM deliveries WHERE job_id = jobs.id "
            "AND state IN ('pending', 'publishing')) AS left, (SELECT count(*) FROM "
            "deliveries WHERE job_id = jobs.id AND state IN ('failed', 'unknown')) "
            "AS bad FROM jobs WHERE id = ?",
            job_id,
        )
        if row and row["state"] == "matched" and row["left"] == row["bad"] == 0:
            self._db.update("jobs", job_id, state="done", error="")
            self._db.log(job_id, "done", "every route served")


def delivery_from_row(row: sqlite3.Row) -> Delivery:
    """A row of the table as the rest of the program sees it."""
    return Delivery(**{name: row[name] for name in Delivery.__slots__})
