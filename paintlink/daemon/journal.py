"""The journal: the only queue, and durable before anything is acknowledged."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from types import TracebackType
from typing import Self

from paintlink.daemon.arrivals import Arrivals, reading_key, sha256
from paintlink.daemon.bench import Bench
from paintlink.daemon.database import Database, utc_now
from paintlink.daemon.deliveries import Deliveries, delivery_from_row
from paintlink.daemon.documents import (
    match_from_json,
    match_to_json,
    reading_from_json,
)
from paintlink.daemon.formulas import Formulas
from paintlink.daemon.keeping import Keeping
from paintlink.daemon.orders import Orders
from paintlink.daemon.outbox import Outbox
from paintlink.daemon.records import Event, InstrumentStatus, Job, JobState, Preview
from paintlink.daemon.specs import restored, stored
from paintlink.daemon.trail import Trail
from paintlink.errors import JournalError
from paintlink.model import ColorSpec, Match, Reading

JOB_ORDER = "SELECT * FROM jobs {where} ORDER BY id {order} LIMIT ?"


class Journal:
    """Readings, jobs, deliveries and pictures in one SQLite file.

    Each thread opens its own; several processes may share the file.

    Parameters
    ----------
    path
        The file; created with its folder when absent.
    now
        The clock events are stamped with.
    """

    def __init__(self, path: Path, *, now: Callable[[], datetime] = utc_now) -> None:
        self.path = path
        self._db = Database(path, now)
        self.deliveries = Deliveries(self._db)
        self.bench = Bench(self._db)
        self._arrivals = Arrivals(self._db)
        self.trail = Trail(self._db)
        self.formulas = Formulas(self._db)
        self.outbox = Outbox(self._db)
        self.orders = Orders(self._db)
        self.keeping = Keeping(self._db)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the file; the journal stays whole without it."""
        self._db.close()

    def transaction(self) -> AbstractContextManager[None]:
        """Everything done inside becomes durable together, or not at all."""
        return self._db.transaction()

    # Intake

    def accept_reading(self, reading: Reading, *, source: str) -> str:
        """Token of the job for a reading, stored durably; a repeat gives the first."""
        return self._arrivals.reading(reading, source)

    def accept_import(
        self,
        name: str,
        content_sha256: str,
        colours: Sequence[tuple[Reading, ColorSpec]],
    ) -> tuple[str, ...]:
        """Tokens of the jobs for the readings of a file, all stored or none.

        A reading that is known already, from whatever file, keeps its first job.
        """
        return self._arrivals.readings(name, content_sha256, colours)

    def knows(self, reading: Reading) -> bool:
        """Whether this very reading was accepted before, alone or in an average."""
        found = self._db.one(
            "SELECT 1 FROM readings WHERE key = ?1 OR (?2 != x'' AND instr(raw, ?2))",
            reading_key(reading),
            reading.measurement.raw,
        )
        return found is not None

    def accept_file(self, name: str, content_sha256: str, spec: ColorSpec) -> str:
        """Token of the job for a specification that arrived as a file."""
        return self._arrivals.file(name, content_sha256, spec)

    def file_name(self, sha256: str) -> str | None:
        """Name under which content was accepted before, if it was."""
        row = self._db.one("SELECT name FROM files WHERE sha256 = ?", sha256)
        return str(row["name"]) if row else None

    def reading(self, reading_id: int) -> Reading:
        """A stored reading, with its raw bytes."""
        row = self._db.one("SELECT * FROM readings WHERE id = ?", reading_id)
        if row is None:
            msg = f"the journal holds no reading {reading_id}"
            raise JournalError(msg)
        return reading_from_json(row["document"], row["raw"])

    def readings_of(self, job_id: int) -> tuple[Reading, ...]:
        """The readings of a job, in the order they were taken."""
        rows = self._db.all(
            "SELECT document, raw FROM readings WHERE job_id = ? ORDER BY id", job_id
        )
        return tuple(reading_from_json(row["document"], row["raw"]) for row in rows)

    # The line

    def waiting(self, state: JobState) -> Job | None:
        """The oldest job in a state."""
        found = self.jobs(state=state, limit=1, newest_first=False)
        return found[0] if found else None

    def oldest(self, states: Sequence[JobState], limit: int) -> tuple[int, ...]:
        """Ids of the oldest jobs in any of some states."""
        marks = ", ".join("?" * len(states))
        sql = f"SELECT id FROM jobs WHERE state IN ({marks}) ORDER BY id LIMIT ?"
        return tuple(int(row["id"]) for row in self._db.all(sql, *states, limit))

    def set_specified(self, job: Job, spec: ColorSpec, *, keep: bool = True) -> None:
        """Keep the specification made from a reading.

        Without ``keep`` it is only noted: the matches come in the same transaction.
        """
        with self._db.transaction():
            if not keep:
                self._db.log(job.id, "specified", spec.name)
                return
            document = stored(spec)
            self._db.update("jobs", job.id, spec=document, state="specified")
            self._db.log(job.id, "specified", spec.name, spec_sha256=sha256(document))

    def set_matched(
        self,
        job: Job,
        spec: ColorSpec,
        matches: Sequence[Match],
        routes: Iterable[tuple[str, str]],
    ) -> None:
        """Keep the ranked list and open one delivery for each (route, folder)."""
        document = stored(spec)
        with self._db.transaction():
            self._db.update("jobs", job.id, spec=document, state="matched")
            self._db.run("DELETE FROM matches WHERE job_id = ?", job.id)
            for match in matches:
                self._db.insert(
                    "matches",
                    job_id=job.id,
                    rank=match.rank,
                    document=match_to_json(match),
                )
            for route, folder in routes:
                self.deliveries.open(job.id, route, folder, copy=1)
            best = matches[0] if matches else None
            self._db.log(
                job.id,
                "matched",
                best.code if best else "nothing",
                spec_sha256=sha256(document),
                **(
                    {
                        "total": best.total,
                        "library": best.library,
                        "generation": best.generation,
                    }
                    if best
                    else {}
                ),
            )

    def finish(self, job: Job, text: str) -> None:
        """Nothing is left to do for the job."""
        with self._db.transaction():
            self._db.update("jobs", job.id, state="done", error="")
            self._db.log(job.id, "done", text)

    def fail(self, job_id: int, error: str) -> None:
        """The job cannot go on by itself; everything it holds is kept."""
        with self._db.transaction():
            self._db.update("jobs", job_id, state="failed", error=error)
            self._db.log(job_id, "failed", error)

    def retry(self, job: Job) -> None:
        """Put a failed job, and what failed of any job, back to work."""
        start = "received" if job.spec is None else "specified"
        with self._db.transaction():
            if job.state == "failed":
                self._db.update("jobs", job.id, state=start, error="")
            self._db.run(
                "UPDATE deliveries SET state = 'pending', retry_at = 0, error = '' "
                "WHERE job_id = ? AND state IN ('pending', 'failed')",
                job.id,
            )
            self._db.run(
                "UPDATE previews SET state = 'pending', note = '' "
                "WHERE job_id = ? AND state = 'failed'",
                job.id,
            )
            self._reopen(job)
            self._db.log(job.id, "retry", "by command")

    def resend(self, job: Job, route: str) -> None:
        """Open one more delivery of a job for a route that already had one."""
        with self._db.transaction():
            last = self._db.one(
                "SELECT folder, copy FROM deliveries WHERE job_id = ? AND route = ? "
                "ORDER BY copy DESC LIMIT 1",
                job.id,
                route,
            )
            if last is None:
                msg = f"job {job.token} has no delivery for the route {route}"
                raise JournalError(msg)
            self.deliveries.open(job.id, route, last["folder"], copy=last["copy"] + 1)
            self._reopen(job)
            self._db.log(job.id, "resend", route)

    # Pictures

    def request_preview(self, job: Job) -> None:
        """Ask the render role for the job's picture."""
        with self._db.transaction():
            self._db.run(
                "INSERT OR IGNORE INTO previews (job_id, state) VALUES (?, 'pending')",
                job.id,
            )

    def waiting_preview(self) -> Job | None:
        """The oldest job whose picture has not been drawn."""
        row = self._db.one(
            "SELECT jobs.* FROM previews JOIN jobs ON jobs.id = previews.job_id "
            "WHERE previews.state = 'pending' ORDER BY jobs.id LIMIT 1"
        )
        return self._job(row) if row else None

    def set_preview(self, preview: Preview) -> None:
        """Record the picture, or why there is none."""
        with self._db.transaction():
            self._db.run(
                "UPDATE previews SET state = ?, path = ?, note = ? WHERE job_id = ?",
                preview.state,
                preview.path,
                preview.note,
                preview.job_id,
            )

    # Instruments

    def set_instrument(self, status: InstrumentStatus) -> None:
        """Keep what an instrument is doing, for whoever asks from another process."""
        with self._db.transaction(durable=False):
            self._db.run(
                "INSERT OR REPLACE INTO instruments VALUES (?, ?, ?, ?, ?)",
                status.name,
                status.state,
                status.text,
                status.identity,
                self._db.stamp(),
            )

    def instruments(self) -> tuple[InstrumentStatus, ...]:
        """What each instrument was last seen doing."""
        rows = self._db.all("SELECT * FROM instruments ORDER BY name")
        return tuple(InstrumentStatus(*row) for row in rows)

    # Looking

    def jobs(
        self,
        *,
        state: JobState | None = None,
        limit: int = 50,
        newest_first: bool = True,
    ) -> tuple[Job, ...]:
        """Jobs with all they hold, newest first unless told otherwise."""
        where, order = ("WHERE state = ?" if state else "", "DESC" * newest_first)
        sql = JOB_ORDER.format(where=where, order=order)
        rows = self._db.all(sql, *([state] if state else []), limit)
        return tuple(self._job(row) for row in rows)

    def job(self, token: str) -> Job | None:
        """The job of a token, or of an unmistakable beginning of one."""
        pattern = token.replace("%", "").replace("_", "") + "%"
        rows = self._db.all("SELECT * FROM jobs WHERE token LIKE ? LIMIT 2", pattern)
        return self._job(rows[0]) if len(rows) == 1 and len(pattern) > 1 else None

    def head(self, job_id: int) -> Job:
        """A job without its matches, deliveries and picture: all a file is made of."""
        row = self._db.one("SELECT * FROM jobs WHERE id = ?", job_id)
        if row is None:
            msg = f"the journal holds no job {job_id}"
            raise JournalError(msg)
        return _head(row)

    def job_by_id(self, job_id: int) -> Job:
        """The job a delivery or a picture belongs to."""
        row = self._db.one("SELECT * FROM jobs WHERE id = ?", job_id)
        if row is None:
            msg = f"the journal holds no job {job_id}"
            raise JournalError(msg)
        return self._job(row)

    def events(self, job: Job) -> tuple[Event, ...]:
        """What happened to a job, oldest first."""
        sql = "SELECT at, kind, text FROM events WHERE job_id = ? ORDER BY id"
        return tuple(Event(*row) for row in self._db.all(sql, job.id))

    def counts(self) -> dict[str, int]:
        """Number of jobs in each state."""
        rows = self._db.all("SELECT state, count(*) FROM jobs GROUP BY state")
        return {row[0]: row[1] for row in rows}

    # Inside

    def _job(self, row: sqlite3.Row) -> Job:
        matches = self._db.all(
            "SELECT document FROM matches WHERE job_id = ? ORDER BY rank", row["id"]
        )
        deliveries = self._db.all(
            "SELECT * FROM deliveries WHERE job_id = ? ORDER BY id", row["id"]
        )
        preview = self._db.one("SELECT * FROM previews WHERE job_id = ?", row["id"])
        return replace(
            _head(row),
            matches=tuple(match_from_json(one["document"]) for one in matches),
            deliveries=tuple(delivery_from_row(one) for one in deliveries),
            preview=Preview(*preview) if preview else None,
        )

    def _reopen(self, job: Job) -> None:
        if job.state == "done":
            self._db.update("jobs", job.id, state="matched")


def _head(row: sqlite3.Row) -> Job:
    return Job(
        id=row["id"],
        token=row["token"],
        reading_id=row["reading_id"],
        source=row["source"],
        origin=row["origin"],
        state=row["state"],
        created_at=row["created_at"],
        spec=restored(row["spec"]) if row["spec"] else None,
        document=row["spec"] or b"",
        error=row["error"],
        order_id=row["order_id"],
        panel_of=row["panel_of"],
        iteration=row["iteration"],
    )
