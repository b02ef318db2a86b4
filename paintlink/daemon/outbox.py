"""How far each sink has got in the history of the journal, which is the outbox."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

from paintlink.daemon.database import Database

FIRST_RETRY_S = 1.0
LAST_RETRY_S = 300.0


class OutboxEvent(NamedTuple):
    """One event as it is told; ``chain`` is the hash of it and all before it."""

    id: int
    at: str
    job: str
    kind: str
    text: str
    facts: dict[str, Any]
    chain: str


class Outbox:
    """How far each sink has got."""

    def __init__(self, database: Database) -> None:
        self._db = database

    def begin(self, sink: str) -> None:
        """Let a new sink hear what happens from now on."""
        with self._db.transaction():
            self._db.run(
                "INSERT OR IGNORE INTO sinks (name, last_event) "
                "SELECT ?, coalesce(max(id), 0) FROM events",
                sink,
            )

    def next(self, sink: str, now_s: float) -> OutboxEvent | None:
        """The event a sink waits for; None when there is none, or it rests."""
        row = self._db.one(
            "SELECT events.*, jobs.token FROM sinks JOIN events "
            "ON events.id > sinks.last_event "
            "LEFT JOIN jobs ON jobs.id = events.job_id "
            "WHERE sinks.name = ? AND (sinks.retry_at <= ? OR sinks.retry_at > ?) "
            "ORDER BY events.id LIMIT 1",
            sink,
            now_s,
            now_s + 2 * LAST_RETRY_S,
        )
        if row is None:
            return None
        return OutboxEvent(
            row["id"],
            row["at"],
            row["token"] or "",
            row["kind"],
            row["text"],
            json.loads(row["facts"]),
            row["chain"],
        )

    def told(self, sink: str, event_id: int) -> None:
        """The sink has an event, and all before it."""
        with self._db.transaction():
            self._db.run(
                "UPDATE sinks SET last_event = ?, attempts = 0, retry_at = 0, "
                "error = '' WHERE name = ?",
                event_id,
                sink,
            )

    def refused(self, sink: str, error: str, now_s: float) -> float:
        """Seconds after which the sink is tried again."""
        with self._db.transaction():
            row = self._db.one("SELECT attempts FROM sinks WHERE name = ?", sink)
            attempts = int(row["attempts"]) if row else 0
            wait_s = min(FIRST_RETRY_S * 2.0 ** min(attempts, 20), LAST_RETRY_S)
            self._db.run(
                "UPDATE sinks SET attempts = ?, retry_at = ?, error = ? WHERE name = ?",
                attempts + 1,
                now_s + wait_s,
                error,
                sink,
            )
        return wait_s
