"""Colours from foreign files on their way into the journal."""

from __future__ import annotations

from dataclasses import replace

from paintlink.color import normalise
from paintlink.daemon.averaging import average
from paintlink.daemon.journal import Journal
from paintlink.errors import InputError
from paintlink.intake import Import, Item
from paintlink.model import Reading


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


def averaged(found: Import) -> Import:
    """The same file with one colour for all readings of a name: their mean.

    Readings that do not fit together are refused under their name.
    """
    groups: dict[str, list[Item]] = {}
    for item in found.items:
        groups.setdefault(item.name, []).append(item)
    items = [_averaged(group) for group in groups.values()]
    return replace(found, items=tuple(items))


def _averaged(group: list[Item]) -> Item:
    readings = [one.reading for one in group if one.reading is not None]
    if len(group) == 1 or len(readings) < len(group):
        return group[0]
    first = group[0].spec
    finish = first.finish if first is not None else "unknown"
    try:
        reading = _mean(readings)
        spec = normalise(reading, finish=finish)
    except InputError as error:
        return Item(group[0].name, readings[0], refused=str(error))
    return Item(group[0].name, reading, replace(spec, code=first.code if first else ""))


def _mean(readings: list[Reading]) -> Reading:
    first = readings[0]
    if any(one.instrument != first.instrument for one in readings):
        msg = "readings of one name come from several instruments: import them apart"
        raise InputError(msg)
    if any(one.origin != first.origin for one in readings):
        msg = "simulated and real readings have one name: import them apart"
        raise InputError(msg)
    return replace(first, measurement=average([one.measurement for one in readings]))


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
