"""Orders and verdicts in the journal: readings fulfil them, judges decide."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any, Literal, NamedTuple

from paintlink.config import TemplateSettings
from paintlink.daemon.database import Database
from paintlink.errors import InputError
from paintlink.intake import Order
from paintlink.model import Match

Verdict = Literal["pass", "marginal", "fail"]
Judge = Literal["machine", "human"]


class StoredOrder(NamedTuple):
    """An order with the template as it was when the order came."""

    id: int
    token: str
    state: str
    order: Order
    template: TemplateSettings


class StoredVerdict(NamedTuple):
    """What a judge says about a job; ``angles`` by aspecular degrees."""

    judge: Judge
    verdict: Verdict
    angles: Mapping[str, Verdict]
    note: str
    at: str


class Orders:
    """The journal's ledger of orders and verdicts."""

    def __init__(self, database: Database) -> None:
        self._db = database

    def accept(self, order: Order, template: TemplateSettings, sha256: str) -> str:
        """Token of an order; the same file again gives the first."""
        token = hashlib.sha256(sha256.encode()).hexdigest()[:10]
        document = {"order": order.document(), "template": asdict(template)}
        with self._db.transaction():
            known = self._db.one("SELECT token FROM orders WHERE token = ?", token)
            if known is None:
                self._db.insert(
                    "orders",
                    token=token,
                    sample=order.sample,
                    state="open",
                    document=json.dumps(document),
                    created_at=self._db.stamp(),
                )
        return token

    def open_for(self, sample: str, instrument: str) -> StoredOrder | None:
        """The oldest open order of a sample name that an instrument may fulfil."""
        rows = self._db.all(
            "SELECT * FROM orders WHERE state = 'open' AND sample = ? ORDER BY id",
            sample,
        )
        for one in map(_stored, rows):
            if not one.template.instruments or instrument in one.template.instruments:
                return one
        return None

    def next_for(self, instrument: str) -> StoredOrder | None:
        """The oldest open order whose template names an instrument."""
        for one in self.waiting():
            if instrument in one.template.instruments:
                return one
        return None

    def waiting(self) -> tuple[StoredOrder, ...]:
        """Open orders, oldest first."""
        rows = self._db.all("SELECT * FROM orders WHERE state = 'open' ORDER BY id")
        return tuple(map(_stored, rows))

    def of_job(self, order_id: int | None) -> StoredOrder | None:
        """The order a job fulfils, if it does."""
        rows = self._db.all("SELECT * FROM orders WHERE id = ?", order_id)
        return _stored(rows[0]) if rows else None

    def judge(
        self,
        job_id: int,
        judge: Judge,
        verdict: Verdict,
        *,
        angles: Mapping[str, Verdict] | None = None,
        note: str = "",
    ) -> None:
        """Keep a verdict; each judge has one, and none replaces the other's."""
        document = json.dumps({"angles": dict(angles or {}), "note": note})
        with self._db.transaction():
            self._db.run(
                "INSERT OR REPLACE INTO verdicts VALUES (?, ?, ?, ?, ?)",
                job_id,
                judge,
                verdict,
                document,
                self._db.stamp(),
            )
            text = f"{judge}: {verdict} {note}".rstrip()
            self._db.log(job_id, "verdict", text, angles=dict(angles or {}))

    def verdicts(self, job_id: int) -> tuple[StoredVerdict, ...]:
        """What the judges say about a job."""
        rows = self._db.all(
            "SELECT * FROM verdicts WHERE job_id = ? ORDER BY judge DESC", job_id
        )
        return tuple(
            StoredVerdict(
                row["judge"],
                row["verdict"],
                **json.loads(row["document"]),
                at=row["at"],
            )
            for row in rows
        )


def resolved(order: Order, templates: Sequence[TemplateSettings]) -> TemplateSettings:
    """The template of an order, whose required fields it has.

    Raises
    ------
    InputError
        When there is no such template, or a field is missing.
    """
    named = {one.name: one for one in templates}
    if order.template not in named and order.template:
        known = ", ".join(named) or "none yet"
        msg = f"no template {order.template!r} (there are: {known})"
        raise InputError(msg)
    template = named.get(order.template) or TemplateSettings(name="")
    missing = [name for name in template.required if not order.document()[name]]
    if missing:
        msg = f"template {template.name} requires {', '.join(missing)}"
        raise InputError(msg)
    return template


def machine_verdict(
    match: Match, template: TemplateSettings
) -> tuple[Verdict, dict[str, Verdict]]:
    """The worst verdict and that of each angle, by the tolerances of a template."""
    angles = {
        f"{one.aspecular_deg:g}": _verdict(one.dE, template)
        for one in match.differences
    }
    found = set(angles.values())
    worst: Verdict = "marginal" if "marginal" in found else "pass"
    return "fail" if "fail" in found else worst, angles


def _verdict(difference: float, template: TemplateSettings) -> Verdict:
    if difference <= template.pass_dE:
        return "pass"
    return "marginal" if difference <= template.marginal_dE else "fail"


def _stored(row: Any) -> StoredOrder:
    data = json.loads(row["document"])
    template: dict[str, Any] = {
        name: tuple(value) if isinstance(value, list) else value
        for name, value in data["template"].items()
    }
    return StoredOrder(
        row["id"],
        row["token"],
        row["state"],
        Order(**data["order"]),
        TemplateSettings(**template),
    )
