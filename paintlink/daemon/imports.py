"""Colours from foreign files on their way into the journal."""

from __future__ import annotations

from paintlink.daemon.journal import Journal
from paintlink.errors import InputError
from paintlink.intake import Import


def store(journal: Journal, found: Import, name: str) -> tuple[str, ...]:
    """Tokens of the jobs for everything usable in a file, stored durably.

    Raises
    ------
    InputError
        When nothing in it is usable, with the reasons.
    """
    if not found.specs:
        raise InputError(f"{found.source}: {_reasons(found)}")
    readings = [
        (one.reading, one.spec)
        for one in found.items
        if one.reading is not None and one.spec is not None
    ]
    if readings:
        return journal.accept_import(name, found.sha256, readings)
    return (journal.accept_file(name, found.sha256, found.specs[0]),)


def summary(found: Import) -> str:
    """What a person should know about a file that was taken; often nothing."""
    lines = [*found.notes]
    refused = [one for one in found.items if one.refused]
    if refused:
        lines.append(
            f"{len(refused)} of {len(found.items)} colours left out: {_reasons(found)}"
        )
    return "\n".join(lines)


def _reasons(found: Import) -> str:
    refused = [one for one in found.items if one.refused]
    named = len(found.items) > 1
    return "\n".join(
        f"{one.name}: {one.refused}" if named else one.refused for one in refused
    )
