"""Words for messages: what a device sent, and what the user may have meant."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

QUOTE_LIMIT = 64


def quoted(text: str | bytes) -> str:
    """Return what a device sent, fit for one log line: escaped, 64 characters of it."""
    if isinstance(text, bytes):
        text = text.decode("latin-1")
    return ascii(text if len(text) <= QUOTE_LIMIT else text[: QUOTE_LIMIT - 3] + "...")


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return a hint at the nearest known name, empty when none is near."""
    near = difflib.get_close_matches(name, list(known), n=1)
    return f", did you mean {near[0]!r}?" if near else ""
