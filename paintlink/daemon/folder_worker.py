"""A folder at work: every file that other programs drop is taken once, and settled."""

from __future__ import annotations

import hashlib
import logging
from abc import ABC, abstractmethod
from functools import partial

from paintlink.daemon.faults import put_aside
from paintlink.errors import InputError
from paintlink.intake import BusyFileError, Claim, Inbox

log = logging.getLogger(__name__)

BUSY_LIMIT_S = 300.0


class FolderWorker(ABC):
    """Takes ready files, stores each durably, and puts it where its fate belongs."""

    def __init__(self, inbox: Inbox) -> None:
        self._inbox = inbox
        self._name = inbox.folders.inbox.name
        self._trouble = ""

    @abstractmethod
    def _known(self, digest: str) -> str | None:
        """Name under which the same content was taken before, if it was."""

    @abstractmethod
    def _store(self, claim: Claim, data: bytes, digest: str) -> str:
        """Store a file durably; what is to be told beside it, or nothing.

        Raises
        ------
        InputError
            When it cannot be used.
        """

    def step(self) -> bool:
        """Take one file; False when none is ready."""
        claim = self._claim()
        if claim is None:
            return False
        with put_aside(f"{self._name}: {claim.path.name}", partial(self._blame, claim)):
            self._settle(claim)
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

    def _settle(self, claim: Claim) -> None:
        try:
            self._accept(claim)
        except InputError as error:
            patience_s = BUSY_LIMIT_S if isinstance(error, BusyFileError) else None
            if not self._inbox.postpone(claim.path, patience_s=patience_s):
                log.warning("%s: %s", self._name, error)
                self._inbox.finish(claim.path, "failed", str(error))

    def _accept(self, claim: Claim) -> None:
        data = self._inbox.read(claim.path)
        digest = hashlib.sha256(data).hexdigest()
        known = self._known(digest)
        if known is not None and not claim.left_over:
            reason = f"the same content was accepted before as {known}"
            self._inbox.finish(claim.path, "duplicate", reason)
            return
        note = "" if known else self._store(claim, data, digest)
        self._inbox.finish(claim.path, "done", note)

    def _blame(self, claim: Claim, fault: str) -> None:
        reason = f"{fault}; report it with this file, then drop it in again"
        self._inbox.finish(claim.path, "failed", reason)
