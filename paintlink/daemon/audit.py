"""The history of all jobs as a chain: each entry holds the hash of those before it.

Who changes, removes or inserts an entry has to write all that follow anew; a backup, or
a sink that was told the hash, then shows another one.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple


class Entry(NamedTuple):
    """One thing that happened; ``facts`` is a JSON object with sorted keys."""

    at: str
    job_id: int | None
    kind: str
    text: str
    facts: str


def facts_text(facts: Mapping[str, Any]) -> str:
    """Facts as the journal writes them."""
    return json.dumps(facts, sort_keys=True, ensure_ascii=False)


def link(previous: str, entry: Entry) -> str:
    """Hash of an entry and all before it, in hex."""
    text = json.dumps([previous, *entry], ensure_ascii=False)
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def broken_link(chained: Iterable[tuple[int, Entry, str]], start: str) -> int | None:
    """Id of the first entry whose hash does not follow; None when all do."""
    previous = start
    for event_id, entry, chain in chained:
        if link(previous, entry) != chain:
            return event_id
        previous = chain
    return None
