"""Settings from the environment: ``PAINTLINK__SECTION__KEY=value``."""

from __future__ import annotations

import json
from collections.abc import Mapping

PREFIX = "PAINTLINK__"

Overlay = dict[tuple[str, str], str]


def overlay(environ: Mapping[str, str]) -> Overlay:
    """Texts by section and key, both in lower case."""
    found = {}
    for name, text in environ.items():
        if name.startswith(PREFIX):
            section, _, key = name.removeprefix(PREFIX).lower().partition("__")
            found[section, key] = text
    return found


def variable(section: str, key: str) -> str:
    """Name of the environment variable for a key."""
    return f"{PREFIX}{section}__{key}".upper()


def number_or_flag(text: str) -> object:
    """The number, true or false that is written there, otherwise the text itself."""
    try:
        return json.loads(text)
    except ValueError:
        return text
