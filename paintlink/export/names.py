"""File names that any program on any system can open and that never collide."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from string import Formatter

FIELDS = ("date", "time", "name", "code", "paint", "format", "copy", "id6")
MAX_NAME_BYTES = 120
SIMULATED_PREFIX = "SIM-"

_HASH_DIGITS = 16
_REFUSED = re.compile(r"[^A-Za-z0-9_-]+")
_REPEATED = re.compile(r"([_-])[_-]+")


def job_hash(key: str) -> str:
    """Sixteen hexadecimal digits that stand for a key, whatever it is made of."""
    return hashlib.sha256(key.encode("utf-8", "surrogatepass")).hexdigest()[
        :_HASH_DIGITS
    ]


def safe_name(text: str, *, suffix: str, key: str) -> str:
    """File name that shows ``text`` and belongs to ``key`` alone.

    ASCII letters, digits, ``_`` and ``-`` only, one dot before the suffix, at most 120
    bytes: no path, no device name of Windows, no leading dot or dash. Different keys
    give names that differ after case folding and Unicode normalisation too. The text is
    a label for people: letters lose their accents, other characters become ``_``.
    """
    end = f"{job_hash(key)}.{suffix}"
    room = MAX_NAME_BYTES - len(end) - 1
    stem = _plain(text)[:room]
    return f"{stem}-{end}" if stem else end


def pattern_problem(pattern: str) -> str | None:
    """What is wrong with a file-name pattern; None when nothing."""
    allowed = ", ".join(f"{{{field}}}" for field in FIELDS)
    try:
        parts = list(Formatter().parse(pattern))
    except ValueError as error:
        return f"file-name pattern {pattern!r}: {error}; write fields as in {allowed}"
    for _, field, spec, conversion in parts:
        if field is not None and (field not in FIELDS or spec or conversion):
            return f"file-name pattern {pattern!r}: no field {field!r}; use {allowed}"
    return None


def _plain(text: str) -> str:
    letters = unicodedata.normalize("NFKD", text)
    bare = "".join(letter for letter in letters if not unicodedata.combining(letter))
    return _REPEATED.sub(r"\1", _REFUSED.sub("_", bare)).strip("_-")
