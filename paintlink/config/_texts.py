"""The words that every fault of the configuration is told in."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from difflib import get_close_matches
from pathlib import Path

from paintlink.config._keys import allowed, choices
from paintlink.config._toml import toml
from paintlink.errors import ConfigError

SHOWN_LENGTH = 60


def refusal(lines: Iterable[str]) -> ConfigError:
    """One error that tells every fault, a line each."""
    return ConfigError("\n".join(lines))


def source_name(source: Path | None) -> str:
    """What stands in front of each fault: the file."""
    return str(source or "built-in settings")


def block(section: str, index: int, name: object = None) -> str:
    """Head of a repeated section: its number, from 1, and its name if it has one."""
    named = f' "{name}"' if isinstance(name, str) and name else ""
    return f"[[{section}]] {index + 1}{named}"


def unknown(kind: str, word: str, known: Collection[str]) -> str:
    """A word that is not known here, with the nearest one that is."""
    hint = (
        did_you_mean(word, known) or f"known are {', '.join(sorted(known)) or 'none'}"
    )
    return f'unknown {kind} "{word}": {hint}'


def wrong(key: str, value: object, hint: object) -> str:
    """A value that its key cannot have, with what the key can have."""
    near = did_you_mean(value, choices(hint))
    advice = f"; {near}" if near else ""
    return f"{key} = {shown(value)}: must be {allowed(hint)}{advice}"


def missing(key: str, hint: object) -> str:
    """A key that has to be there, with what it can have."""
    return f'key "{key}" is missing: it must be {allowed(hint)}'


def shown(value: object) -> str:
    """A value as the file has it, shortened when long."""
    text = toml(value)
    return text if len(text) <= SHOWN_LENGTH else f"{text[:SHOWN_LENGTH]}..."


def did_you_mean(word: object, known: Iterable[str | int]) -> str:
    """A question with the nearest known word; empty when none is near."""
    words = {str(one): one for one in known}
    near = get_close_matches(str(word), words, n=1)
    return f"did you mean {toml(words[near[0]])}?" if near else ""
