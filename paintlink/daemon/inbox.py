"""The inbox at work: specifications that arrive as files become jobs."""

from __future__ import annotations

import hashlib
import logging
from datetime import UTC, datetime

from paintlink.daemon.imports import store, summary
from paintlink.daemon.journal import Journal
from paintlink.errors import InputError
from paintlink.intake import BusyFileError, Claim, Inbox, Options, Profile, read_any
from paintlink.model import Finish

log = logging.getLogger(__name__)

BUSY_LIMIT_S = 300.0


class InboxWorker:
    """Takes ready files, stores each durably, and puts it where its fate belongs.

    Parameters
    ----------
    finish
        Taken for a colour that does not know its own.
    profiles
        Mappings of the tables other programs drop.
    """

    def __init__(
        self,
        journal: Journal,
        inbox: Inbox,
        *,
        finish: Finish = "unknown",
        profiles: tuple[Profile, ...] = (),
    ) -> None:
        self._journal = journal
        self._inbox = inbox
        self._finish: Finish = finish
        self._profiles = profiles
        self._name = inbox.folders.inbox.name
        self._trouble = ""

    def step(self) -> bool:
        """Take one file; False when none is ready."""
        claim = self._claim()
        if claim is None:
            return False
        try:
            self._accept(claim)
        except InputError as error:
            patience_s = BUSY_LIMIT_S if isinstance(error, BusyFileError) else None
            if not self._inbox.postpone(claim.path, patience_s=patience_s):
                log.warning("%s: %s", self._name, error)
                self._inbox.finish(claim.path, "failed", str(error))
        return True

    def _claim(self) -> Claim | None:
        """The next file; a folder that is away is told once, not at every look."""
        try:
            claim = self._inbox.claim()
        except InputError as error:
            if str(error) != self._trouble:
                log.warning("%s: %s", self._name, error)
            self._trouble = str(error)
            return None
        self._trouble = ""
        return claim

    def _accept(self, claim: Claim) -> None:
        data = self._inbox.read(claim.path)
        known = self._journal.file_name(hashlib.sha256(data).hexdigest())
        if known is not None and not claim.left_over:
            reason = f"the same content was accepted before as {known}"
            self._inbox.finish(claim.path, "duplicate", reason)
            return
        note = "" if known else self._store(claim, data)
        self._inbox.finish(claim.path, "done", note)

    def _store(self, claim: Claim, data: bytes) -> str:
        name = claim.path.name
        options = Options(
            finish=self._finish,
            received_at=datetime.fromtimestamp(claim.path.stat().st_mtime, UTC),
            profiles=self._profiles,
        )
        found = read_any(data, name=name, options=options)
        tokens = store(self._journal, found, name)
        log.info("%s accepted %s", " ".join(tokens), name)
        return summary(found)
