"""The jobs folder at work: files of other programs become orders."""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Sequence

from paintlink.config import TemplateSettings
from paintlink.daemon.journal import Journal
from paintlink.daemon.orders import StoredOrder, resolved
from paintlink.daemon.records import Job
from paintlink.errors import InputError
from paintlink.intake import Inbox, Order, read_order

log = logging.getLogger(__name__)


def label_facts(job: Job, order: StoredOrder | None) -> dict[str, object]:
    """What a label may say about a job."""
    best = job.matches[0] if job.matches else None
    return {
        **(order.order if order else Order("")).document(),
        "job": job.token,
        "sample": job.spec.name if job.spec else job.source,
        "paint": best.code if best else "",
        "total": f"{best.total:.1f}" if best else "",
        "date": job.created_at[:10],
        "simulated": job.origin == "simulated",
    }


class OrderWorker:
    """Takes order files from their folder, each once."""

    def __init__(
        self, journal: Journal, inbox: Inbox, templates: Sequence[TemplateSettings]
    ) -> None:
        self._journal = journal
        self._inbox = inbox
        self._templates = templates

    def step(self) -> bool:
        """Take one file; False when none is ready."""
        try:
            claim = self._inbox.claim()
        except InputError as error:
            log.debug("jobs: %s", error)
            return False
        if claim is None:
            return False
        try:
            data = self._inbox.read(claim.path)
            order = read_order(data, source=claim.path.name)
            digest = hashlib.sha256(data).hexdigest()
            template = resolved(order, self._templates)
            token = self._journal.orders.accept(order, template, digest)
        except InputError as error:
            if not self._inbox.postpone(claim.path):
                log.warning("jobs: %s", error)
                self._inbox.finish(claim.path, "failed", str(error))
            return True
        log.info("%s order for %s", token, order.sample)
        self._inbox.finish(claim.path, "done")
        return True
