"""The inbox at work: specifications that arrive as files become jobs."""

from __future__ import annotations

import logging
from datetime import UTC, datetime

from paintlink.daemon.folder_worker import FolderWorker
from paintlink.daemon.imports import store, summary
from paintlink.daemon.journal import Journal
from paintlink.intake import Claim, Inbox, Options, Profile, read_any
from paintlink.model import Finish

log = logging.getLogger(__name__)


class InboxWorker(FolderWorker):
    """Takes colour files, each content once.

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
        super().__init__(inbox)
        self._journal = journal
        self._finish: Finish = finish
        self._profiles = profiles

    def _known(self, digest: str) -> str | None:
        return self._journal.file_name(digest)

    def _store(self, claim: Claim, data: bytes, digest: str) -> str:
        del digest  # the import has its own
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
