"""What comes into the journal: readings and files, each stored once."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Sequence
from typing import Any

from paintlink.daemon.database import Database
from paintlink.daemon.documents import reading_to_json
from paintlink.daemon.orders import Orders, StoredOrder
from paintlink.daemon.records import JobState
from paintlink.model import ColorSpec, Origin, Reading
from paintlink.spec import write_spec


def reading_key(reading: Reading) -> str:
    """The identity of a reading, in hex.

    An instrument that numbers its readings says itself which are the same one. Of
    others, the same bytes at the same time are.
    """
    measured = reading.measurement
    when = measured.record or reading.taken_at.isoformat()
    text = f"{reading.instrument.serial}\0{when}\0"
    return hashlib.sha256(text.encode() + measured.raw).hexdigest()


def sha256(data: bytes | str) -> str:
    """Hash of bytes or of a text in UTF-8, in hex."""
    raw = data.encode() if isinstance(data, str) else data
    return hashlib.sha256(raw).hexdigest()


class Arrivals:
    """Opens a job for everything that arrives, and none for what is known."""

    def __init__(self, database: Database) -> None:
        self._db = database
        self._orders = Orders(database)

    def reading(self, reading: Reading, source: str) -> str:
        """Token of the job for a reading; a repeat gives the first."""
        with self._db.transaction():
            return self._known(reading) or self._add_reading(reading, source)

    def readings(
        self,
        name: str,
        content_sha256: str,
        colours: Sequence[tuple[Reading, ColorSpec]],
    ) -> tuple[str, ...]:
        """Tokens of the jobs for the readings of a file, all stored or none."""
        with self._db.transaction():
            tokens = [
                self._known(reading) or self._add_reading(reading, name, spec)
                for reading, spec in colours
            ]
            self._db.run(
                "INSERT OR IGNORE INTO files (sha256, name, job_id, accepted_at) "
                "SELECT ?, ?, id, ? FROM jobs WHERE token = ?",
                content_sha256,
                name,
                self._db.stamp(),
                tokens[0],
            )
        return tuple(tokens)

    def file(self, name: str, content_sha256: str, spec: ColorSpec) -> str:
        """Token of the job for a specification that arrived as a file."""
        origin: Origin = spec.provenance.origin if spec.provenance else "real"
        document = write_spec(spec)
        with self._db.transaction():
            job_id, token = self._add_job(
                content_sha256, "specified", name, origin, spec=document
            )
            self._db.insert(
                "files",
                sha256=content_sha256,
                name=name,
                job_id=job_id,
                accepted_at=self._db.stamp(),
            )
            self._db.log(
                job_id,
                "file",
                name,
                file_sha256=content_sha256,
                spec_sha256=sha256(document),
            )
        return token

    def _known(self, reading: Reading) -> str:
        row = self._db.one(
            "SELECT token FROM jobs JOIN readings ON readings.job_id = jobs.id "
            "WHERE readings.key = ?",
            reading_key(reading),
        )
        return str(row["token"]) if row else ""

    def _add_reading(
        self, reading: Reading, source: str, spec: ColorSpec | None = None
    ) -> str:
        key = reading_key(reading)
        document, raw = reading_to_json(reading), reading.measurement.raw
        reading_id = self._db.insert(
            "readings",
            key=key,
            source=source,
            taken_at=reading.taken_at.isoformat(),
            document=document,
            raw=raw,
        )
        xml = write_spec(spec) if spec else None
        state: JobState = "specified" if xml else "received"
        order = None if xml else self._orders.open_for(reading.sample, source)
        job_id, token = self._begun(order) or self._add_job(
            key,
            state,
            source,
            reading.origin,
            reading_id=reading_id,
            spec=xml,
            order_id=order.id if order else None,
        )
        self._db.update("readings", reading_id, job_id=job_id)
        if order is not None:
            self._count(order, job_id)
        self._db.log(
            job_id,
            "reading",
            f"{source}: {reading.instrument.model}",
            reading=reading_id,
            raw_sha256=sha256(raw),
            document_sha256=sha256(document),
        )
        if spec and xml:
            self._db.log(job_id, "specified", spec.name, spec_sha256=sha256(xml))
        return token

    def _begun(self, order: StoredOrder | None) -> tuple[int, str] | None:
        """Id and token of the job that collects the readings of an order."""
        row = order and self._db.one(
            "SELECT id, token FROM jobs WHERE order_id = ? AND state = 'collecting'",
            order.id,
        )
        return (int(row["id"]), str(row["token"])) if row else None

    def _count(self, order: StoredOrder, job_id: int) -> None:
        """Let the job go on once the order has all its readings."""
        row = self._db.one("SELECT count(*) FROM readings WHERE job_id = ?", job_id)
        done = row is not None and row[0] >= order.template.readings
        state: JobState = "received" if done else "collecting"
        self._db.update("jobs", job_id, state=state)
        if done:
            self._db.update("orders", order.id, state="measured")

    def _add_job(
        self, key: str, state: JobState, source: str, origin: Origin, **columns: Any
    ) -> tuple[int, str]:
        digest = hashlib.sha256(key.encode()).digest()
        token = base64.b32encode(digest)[:10].decode().lower()
        job_id = self._db.insert(
            "jobs",
            token=token,
            state=state,
            source=source,
            origin=origin,
            created_at=self._db.stamp(),
            **columns,
        )
        return job_id, token
