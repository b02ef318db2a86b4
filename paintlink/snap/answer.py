"""The whole answer of ColorSnap: the list, and how much it can be relied on."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from paintlink.model import ColorSpec, Match, PaintTable
from paintlink.snap.confidence import REPEATABILITY, Confidence, confidence
from paintlink.snap.diagnosis import Finding, Limits, diagnose
from paintlink.snap.grown import Mask
from paintlink.snap.makeable import ANGLES_DEG, Forecast, forecast
from paintlink.snap.search import nearest, nearest_of_all

FEWEST_LOOKED_AT = 50
"""Paints behind the answer, however short the list: for relations and confidence."""

RELATED = 1.0
"""Lab units per angle from which a paint is called lighter, darker, more chromatic."""

SECOND_FORMULA = {"ciede2000": "cie76"}
GROUP_FACETS = ("variant_group", "group")


@dataclass(frozen=True, slots=True)
class Options:
    """What an answer depends on beside target and library."""

    top: int = 20
    formula: str = "cie76"
    angles_deg: tuple[float, ...] | None = None
    repeatability: float = REPEATABILITY
    limits: Limits = field(default_factory=Limits)


@dataclass(frozen=True, slots=True)
class Answer:
    """The nearest paints and what they are worth.

    Parameters
    ----------
    second_ranks
        Rank of each match by the second formula; None for one beyond the paints
        that were looked at.
    relations
        The nearest paint that is lighter, darker, more chromatic or of the same hue
        compared with the target, where there is one among the paints looked at.
    variants
        Ranks of matches that are variants of one paint, in the first match's library.
    findings
        What was looked at, see `Finding.told`.
    forecast
        Whether the virtual paint system can make the colour; None for libraries of
        other paints, and for targets without the angles it needs.
    """

    matches: tuple[Match, ...]
    second_formula: str
    second_ranks: tuple[int | None, ...]
    relations: Mapping[str, Match]
    variants: tuple[tuple[int, ...], ...]
    confidence: Confidence
    findings: tuple[Finding, ...]
    forecast: Forecast | None = None


def answer(
    spec: ColorSpec,
    table: PaintTable,
    options: Options | None = None,
    mask: Mask | None = None,
) -> Answer:
    """The nearest paints of a library, and what they are worth.

    Raises
    ------
    LibraryError
        As `nearest`.
    """
    return answer_of_all(spec, [table], options, [mask])


def answer_of_all(
    spec: ColorSpec,
    tables: Sequence[PaintTable],
    options: Options | None = None,
    masks: Sequence[Mask | None] = (),
) -> Answer:
    """The nearest paints of several libraries in one list, and what they are worth.

    Findings compare with the library of the first match.

    Raises
    ------
    LibraryError
        As `nearest_of_all`.
    """
    options = options or Options()
    masks = masks or [None] * len(tables)
    wide = max(options.top, FEWEST_LOOKED_AT) if options.top > 0 else options.top
    seen = _list(spec, tables, masks, replace(options, top=wide))
    matches = seen[: options.top]
    second = SECOND_FORMULA.get(options.formula, "ciede2000")
    first = next(t for t in tables if t.library == matches[0].library)
    return Answer(
        matches=matches,
        second_formula=second,
        second_ranks=_second_ranks(spec, tables, masks, matches, second),
        relations=dict(_relations(seen)),
        variants=_variants(matches, first),
        confidence=confidence(spec, seen, options.repeatability),
        findings=diagnose(spec, seen, first, options.limits),
        forecast=_forecast(spec, first),
    )


def _list(
    spec: ColorSpec,
    tables: Sequence[PaintTable],
    masks: Sequence[Mask | None],
    options: Options,
) -> tuple[Match, ...]:
    if len(tables) == 1:
        return nearest(
            spec,
            tables[0],
            top=options.top,
            formula=options.formula,
            angles_deg=options.angles_deg,
            mask=masks[0],
        )
    return nearest_of_all(
        spec,
        tables,
        top=options.top,
        formula=options.formula,
        angles_deg=options.angles_deg,
        masks=masks,
    )


def _forecast(spec: ColorSpec, table: PaintTable) -> Forecast | None:
    has_angles = set(ANGLES_DEG) <= set(spec.angles_deg)
    if not (table.synthetic and has_angles and spec.observer == "10"):
        return None
    return forecast(spec)


def _second_ranks(
    spec: ColorSpec,
    tables: Sequence[PaintTable],
    masks: Sequence[Mask | None],
    matches: tuple[Match, ...],
    formula: str,
) -> tuple[int | None, ...]:
    best = matches[0]
    options = Options(
        top=max(4 * len(matches), FEWEST_LOOKED_AT),
        formula=formula,
        angles_deg=None if best.estimated_deg else best.angles_deg,
    )
    listed = _list(spec, tables, masks, options)
    ranks = {(match.library, match.paint_id): match.rank for match in listed}
    return tuple(ranks.get((match.library, match.paint_id)) for match in matches)


def _relations(seen: tuple[Match, ...]) -> Iterator[tuple[str, Match]]:
    """Differences are target minus paint: a lighter paint has a negative dL."""
    tests: dict[str, Callable[[Match], bool]] = {
        "closest": lambda match: match.rank == 1,
        "lighter": lambda match: _mean(match, "dL") < -RELATED,
        "darker": lambda match: _mean(match, "dL") > RELATED,
        "more chromatic": lambda match: _mean(match, "dC") < -RELATED,
        "same hue": lambda match: all(abs(d.dH) < RELATED for d in match.differences),
    }
    for relation, holds in tests.items():
        found = next(filter(holds, seen), None)
        if found is not None:
            yield relation, found


def _mean(match: Match, part: str) -> float:
    return float(np.mean([getattr(one, part) for one in match.differences]))


def _variants(
    matches: tuple[Match, ...], table: PaintTable
) -> tuple[tuple[int, ...], ...]:
    name = next((name for name in GROUP_FACETS if name in table.facets), None)
    if name is None:
        return ()
    facet = table.facets[name]
    own = [match for match in matches if match.library == table.library]
    rows = np.searchsorted(table.ids, [match.paint_id for match in own])
    groups: dict[str, list[int]] = {}
    for match, row in zip(own, rows.tolist(), strict=True):
        group = facet.value(row)
        if group:
            groups.setdefault(group, []).append(match.rank)
    return tuple(tuple(ranks) for ranks in groups.values() if len(ranks) > 1)
