"""What must agree before a target and a library may be compared."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from paintlink.color import FORMULAS, Formula
from paintlink.errors import LibraryError
from paintlink.model import ColorSpec, FloatArray, PaintTable

STANDARD_ANGLES_DEG = (15.0, 45.0, 110.0)
"""Where the paper compares colours."""

FEWEST_ANGLES = 3


@dataclass(frozen=True, slots=True)
class Conditions:
    """Angles a library is compared at, and which of them it was not measured at."""

    angles_deg: tuple[float, ...]
    estimated_deg: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """What is compared: the target at the angles, shape (angles, 3), and by what."""

    target: FloatArray
    angles_deg: tuple[float, ...]
    formula: Formula


def agree(
    spec: ColorSpec,
    tables: Sequence[PaintTable],
    angles_deg: tuple[float, ...] | None = None,
) -> tuple[Conditions, ...]:
    """The conditions for each library, all at the same angles.

    Raises
    ------
    LibraryError
        When target and libraries do not share observer or angles.
    """
    for table in tables:
        _require_observer(spec, table)
    angles = _angles(spec, tables, angles_deg)
    if angles is None:
        asked = "" if angles_deg is None else f" at {listed(sorted(set(angles_deg)))}"
        fewest = FEWEST_ANGLES if angles_deg is None else 1
        libraries = ", ".join(
            f"{table.library} at {listed(table.angles_deg)}" for table in tables
        )
        msg = (
            f"cannot compare{asked}: the target has Lab at {listed(spec.angles_deg)} "
            f"degrees, {libraries}; at least {fewest} must be the same, measure the "
            f"target with another set of angles"
        )
        raise LibraryError(msg)
    return tuple(
        Conditions(angles, tuple(a for a in angles if a not in table.angles_deg))
        for table in tables
    )


def formula_of(formula: str) -> Formula:
    """The formula of an id.

    Raises
    ------
    LibraryError
        When there is none.
    """
    if formula not in FORMULAS:
        msg = f"unknown difference formula {formula!r}: take {' or '.join(FORMULAS)}"
        raise LibraryError(msg)
    return FORMULAS[formula]


def listed(angles_deg: Iterable[float]) -> str:
    """Angles as people write them: 15/45/110."""
    return "/".join(f"{angle:g}" for angle in angles_deg) or "no angle"


def _require_observer(spec: ColorSpec, table: PaintTable) -> None:
    if spec.observer != table.observer:
        msg = (
            f"the target is for the {spec.observer} degree observer, {table.library} "
            f"for the {table.observer} degree observer: Lab cannot be converted, "
            f"compute the target anew from its spectra"
        )
        raise LibraryError(msg)


def _angles(
    spec: ColorSpec, tables: Sequence[PaintTable], wanted: tuple[float, ...] | None
) -> tuple[float, ...] | None:
    common = set(spec.angles_deg).intersection(*(table.angles_deg for table in tables))
    if wanted is not None:
        angles = tuple(sorted({float(angle) for angle in wanted}))
        return angles if angles and common.issuperset(angles) else None
    if common.issuperset(STANDARD_ANGLES_DEG):
        return STANDARD_ANGLES_DEG
    if len(common) >= FEWEST_ANGLES:
        return tuple(sorted(common))
    return _between_measured(spec, tables)


def _between_measured(
    spec: ColorSpec, tables: Sequence[PaintTable]
) -> tuple[float, ...] | None:
    """The target's angles within those of each library, which is interpolated there.

    The library, not the target: a curve that is extrapolated misses by more. It needs
    three angles on the near side of the mirror direction.
    """
    near_side = [[a for a in table.angles_deg if a > 0.0] for table in tables]
    if min(map(len, near_side)) < FEWEST_ANGLES:
        return None
    low, high = max(a[0] for a in near_side), min(a[-1] for a in near_side)
    angles = tuple(angle for angle in spec.angles_deg if low <= angle <= high)
    return angles if len(angles) >= FEWEST_ANGLES else None
