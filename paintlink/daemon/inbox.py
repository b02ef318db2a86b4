"""The inbox at work: specifications that arrive as files become jobs."""

from __future__ import annotations

import hashlib
import logging
from dataclasses import replace

from paintlink.daemon.journal import Journal
from paintlink.errors import InputError
from paintlink.intake import Claim, Inbox
from paintlink.model import Finish
from paintlink.spec import read_spec

log = logging.getLogger(__name__)


class InboxWorker:
    """Takes ready files, stores each durably, and puts it where its fate belongs.

    Parameters
    ----------
    finish
        Taken for a specification that does not know its own.
    """

    def __init__(
        self, journal: Journal, inbox: Inbox, *, finish: Finish = "unknown"
    ) -> None:
        self._journal = journal
        self._inbox = inbox
        self._finish = finish

    def step(self) -> bool:
        """Take one file; False when none is ready."""
        claim = self._inbox.claim()
        if claim is None:
            return False
        try:
            self._accept(claim)
        except InputError as error:
            log.warning("inbox: %s", error)
            self._inbox.finish(claim.path, "failed", str(error))
        return True

    def _accept(self, claim: Claim) -> None:
        data = self._inbox.read(claim.path)
        digest = hashlib.sha256(data).hexdigest()
        known = self._journal.file_name(digest)
        if known is None:
            spec = read_spec(data, source=claim.path.name)
            if spec.finish == "unknown":
                spec = replace(spec, finish=self._finish)
            token = self._journal.accept_file(claim.path.name, digest, spec)
            log.info("%s accepted %s", token, claim.path.name)
        elif not claim.left_over:
            reason = f"the same content was accepted before as {known}"
            self._inbox.finish(claim.path, "duplicate", reason)
            return
        self._inbox.finish(claim.path, "done")
