"""Every event of the journal told to other programs, in order, until they have it.

The history of the journal is the outbox: an event is written in the transaction of what
it tells of, and a sink remembers the last one it got. A sink may hear an event twice,
after a crash between its answer and our note; the number of the event tells.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import logging
from collections.abc import Callable
from http.client import HTTPException
from typing import Any
from urllib import request
from urllib.error import HTTPError

from paintlink.config import SinkSettings
from paintlink.daemon.journal import Journal
from paintlink.daemon.outbox import OutboxEvent

log = logging.getLogger(__name__)

TIMEOUT_S = 10.0


class SinkWorker:
    """Posts events to one address, one after another.

    Parameters
    ----------
    clock
        Seconds since 1970.
    """

    def __init__(
        self, journal: Journal, sink: SinkSettings, clock: Callable[[], float]
    ) -> None:
        self._outbox = journal.outbox
        self._sink = sink
        self._clock = clock
        self._outbox.begin(sink.name)

    def step(self) -> bool:
        """Tell one event; False when there is none to tell now."""
        event = self._outbox.next(self._sink.name, self._clock())
        if event is None:
            return False
        if self._sink.kinds and event.kind not in self._sink.kinds:
            self._outbox.told(self._sink.name, event.id)
            return True
        try:
            post(self._sink, event)
        except (OSError, HTTPException, ValueError) as error:
            wait_s = self._outbox.refused(self._sink.name, str(error), self._clock())
            log.warning(
                "%s: event %d: %s; again in %g s", self._sink.name, event.id, error,
                wait_s,
            )  # fmt: skip
            return False
        self._outbox.told(self._sink.name, event.id)
        return True


def post(sink: SinkSettings, event: OutboxEvent) -> None:
    """Return when the sink has answered that it has the event.

    Raises
    ------
    OSError
        When it cannot be reached, or answers anything but success; a redirection is
        not followed.
    """
    body = json.dumps(event._asdict(), ensure_ascii=False).encode()
    headers = {"Content-Type": "application/json", "X-Paintlink-Event": str(event.id)}
    if sink.secret:
        digest = hmac.new(sink.secret.encode(), body, hashlib.sha256).hexdigest()
        headers["X-Paintlink-Signature"] = f"sha256={digest}"
    asked = request.Request(sink.url, body, headers, method="POST")
    try:
        with _opener().open(asked, timeout=TIMEOUT_S) as answer:
            answer.read(1024)
    except HTTPError as error:
        error.close()
        msg = f"{sink.url} answered {error.code} {error.reason}"
        raise OSError(msg) from error


class _Stay(request.HTTPRedirectHandler):
    """Follows no redirection: events go where the administrator said."""

    def redirect_request(self, *args: Any, **kwargs: Any) -> None:
        return None


def _opener() -> request.OpenerDirector:
    return request.build_opener(_Stay)
