"""The jobs folder at work: files of other programs become orders."""

from __future__ import annotations

import logging
from collections.abc import Sequence

from paintlink.config import TemplateSettings
from paintlink.daemon.folder_worker import FolderWorker
from paintlink.daemon.journal import Journal
from paintlink.daemon.orders import StoredOrder, resolved
from paintlink.daemon.records import Job
from paintlink.intake import Claim, Inbox, Order, read_order

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


class OrderWorker(FolderWorker):
    """Takes order files; the same order twice is one."""

    def __init__(
        self, journal: Journal, inbox: Inbox, templates: Sequence[TemplateSettings]
    ) -> None:
        super().__init__(inbox)
        self._orders = journal.orders
        self._templates = templates

    def _known(self, digest: str) -> None:
        del digest  # the journal gives the first order again

    def _store(self, claim: Claim, data: bytes, digest: str) -> str:
        order = read_order(data, source=claim.path.name)
        template = resolved(order, self._templates)
        token = self._orders.accept(order, template, digest)
        log.info("%s order for %s", token, order.sample)
        return ""
