"""From the raw bytes of a reading to the delivered file: what happened, and proof."""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from paintlink.daemon.audit import Entry, broken_link
from paintlink.daemon.database import Database
from paintlink.daemon.records import Delivery

PAGE = 10_000
REMOVED = "removed by retention; the history keeps its hash"


class Finding(NamedTuple):
    """One link of the chain: ``fault`` is empty when it holds."""

    job: str
    step: str
    text: str
    fault: str = ""


class Trail:
    """Compares what the journal holds with the hashes of its history."""

    def __init__(self, database: Database) -> None:
        self._db = database

    def faults(self) -> Iterator[Finding]:
        """Everything that does not hold, in the whole journal."""
        broken = self.broken_entry()
        if broken is not None:
            text = f"entry {broken} of the history does not follow from those before it"
            yield Finding(self._token_of_event(broken), "history", text, "was changed")
        for row in self._db.all("SELECT id FROM jobs ORDER BY id"):
            yield from (one for one in self.of_job(row["id"]) if one.fault)

    def broken_entry(self) -> int | None:
        """Id of the first entry of the history whose hash is wrong; None when none."""
        last, start = self._audited_after(), ""
        while True:
            rows = self._db.all(
                "SELECT * FROM events WHERE id > ? ORDER BY id LIMIT ?", last, PAGE
            )
            if not rows:
                return None
            chained = [(row["id"], _entry(row), row["chain"]) for row in rows]
            broken = broken_link(chained, start)
            if broken is not None:
                return broken
            last, start = rows[-1]["id"], rows[-1]["chain"]

    def of_job(self, job_id: int) -> Iterator[Finding]:
        """Every link of one job's chain, from the raw bytes to the files."""
        job = self._db.one("SELECT * FROM jobs WHERE id = ?", job_id)
        if job is None:
            return
        facts = self._facts(job_id)
        token = str(job["token"])
        for row in self._db.all("SELECT * FROM readings WHERE job_id = ?", job_id):
            yield from _reading(token, row, facts)
        if job["spec"] is not None:
            yield _specification(token, job["spec"], facts)
        sql = "SELECT * FROM deliveries WHERE job_id = ? ORDER BY id"
        for row in self._db.all(sql, job_id):
            yield _delivery(token, row, facts)

    def _facts(self, job_id: int) -> list[dict[str, Any]]:
        sql = "SELECT kind, facts FROM events WHERE job_id = ? ORDER BY id"
        rows = self._db.all(sql, job_id)
        return [_parsed(row["facts"]) | {"kind": row["kind"]} for row in rows]

    def _audited_after(self) -> int:
        row = self._db.one("SELECT value FROM meta WHERE key = 'audit_after'")
        return int(row["value"]) if row else 0

    def _token_of_event(self, event_id: int) -> str:
        row = self._db.one(
            "SELECT token FROM jobs JOIN events ON events.job_id = jobs.id "
            "WHERE events.id = ?",
            event_id,
        )
        return str(row["token"]) if row else ""


def _parsed(facts: str) -> dict[str, Any]:
    """The facts of an entry; none when they are damaged, which its hash tells."""
    try:
        found = json.loads(facts)
    except ValueError:
        return {}
    return found if isinstance(found, dict) else {}


def _entry(row: sqlite3.Row) -> Entry:
    return Entry(*(row[name] for name in Entry._fields))


def _reading(
    token: str, row: sqlite3.Row, facts: list[dict[str, Any]]
) -> Iterator[Finding]:
    told = [one for one in facts if one.get("reading") == row["id"]]
    if not told:
        text = f"reading {row['id']} from {row['source']}"
        yield Finding(token, "raw bytes", text, "the history does not know it")
        return
    if any(one["kind"] == "pruned" for one in facts):
        yield Finding(token, "raw bytes", REMOVED)
        return
    for step, name, data in (
        ("raw bytes", "raw_sha256", row["raw"]),
        ("values", "document_sha256", row["document"].encode()),
    ):
        text = f"reading {row['id']} from {row['source']}, {len(data)} bytes"
        yield _compared(Finding(token, step, text), told[-1][name], data)


def _specification(token: str, spec: bytes, facts: list[dict[str, Any]]) -> Finding:
    told = [one["spec_sha256"] for one in facts if "spec_sha256" in one]
    matched = [one for one in facts if one["kind"] == "matched" and "library" in one]
    text = f"{len(spec)} bytes"
    if matched:
        library = f"{matched[-1]['library']} {matched[-1]['generation']}"
        text += f", compared with {library}"
    return _compared(Finding(token, "specification", text), told[-1:], spec)


def _delivery(token: str, row: sqlite3.Row, facts: list[dict[str, Any]]) -> Finding:
    delivery = Delivery(**{name: row[name] for name in Delivery.__slots__})
    text = f"{delivery.route}: {delivery.state} {delivery.folder}/{delivery.name}"
    found = Finding(token, "delivery", text.rstrip("/"))
    if not delivery.sha256:
        return found
    told = [one["sha256"] for one in facts if one.get("delivery") == delivery.id]
    if told[-1:] != [delivery.sha256]:
        return found._replace(fault="its hash differs from the one in the history")
    lying = Path(delivery.folder) / delivery.name
    try:
        data = lying.read_bytes()
    except OSError:
        return found._replace(text=f"{text}, sha256 {delivery.sha256[:16]}")
    if hashlib.sha256(data).hexdigest() != delivery.sha256:
        return found._replace(fault=f"{lying} was changed after it was delivered")
    return found._replace(text=f"{text}, sha256 {delivery.sha256[:16]}, still there")


def _compared(found: Finding, told: str | list[str], data: bytes) -> Finding:
    digest = hashlib.sha256(data).hexdigest()
    if told in ([], ""):
        return found._replace(fault="the history has no hash of it")
    if told not in (digest, [digest]):
        return found._replace(fault="was changed: its hash is not that of the history")
    return found._replace(text=f"{found.text}, sha256 {digest[:16]}")
