"""What must agree before a target and a library may be compared."""

from __future__ import annotations

from dataclasses import dataclass

from paintlink.color import FORMULAS, Formula
from paintlink.errors import LibraryError
from paintlink.model import ColorSpec, FloatArray, PaintTable

STANDARD_ANGLES_DEG = (15.0, 45.0, 110.0)
"""Where the paper compares colours."""

FEWEST_ANGLES = 3


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """What is compared: the target at the angles, shape (angles, 3), and by what."""

    target: FloatArray
    angles_deg: tuple[float, ...]
    formula: Formula


def agree(
    spec: ColorSpec,
    table: PaintTable,
    formula: str,
    angles_deg: tuple[float, ...] | None,
) -> Comparison:
    """The comparison that target and library allow.

    Raises
    ------
    LibraryError
        When they do not share formula, observer or angles.
    """
    if formula not in FORMULAS:
        msg = f"unknown difference formula {formula!r}: take {' or '.join(FORMULAS)}"
        raise LibraryError(msg)
    if spec.observer != table.observer:
        msg = (
            f"the target is for the {spec.observer} degree observer, {table.library} "
            f"for the {table.observer} degree observer: Lab cannot be converted, "
            f"compute the target anew from its spectra"
        )
        raise LibraryError(msg)
    angles = _common_angles(spec, table, angles_deg)
    return Comparison(spec.lab(*angles), angles, FORMULAS[formula])


def _common_angles(
    spec: ColorSpec, table: PaintTable, wanted: tuple[float, ...] | None
) -> tuple[float, ...]:
    """Angles measured on both sides, ascending; never an interpolated one."""
    common = set(spec.angles_deg) & set(table.angles_deg)
    if wanted is not None:
        angles, fewest = tuple(sorted({float(angle) for angle in wanted})), 1
    elif common.issuperset(STANDARD_ANGLES_DEG):
        angles, fewest = STANDARD_ANGLES_DEG, FEWEST_ANGLES
    else:
        angles, fewest = tuple(sorted(common)), FEWEST_ANGLES
    if len(angles) < fewest or not common.issuperset(angles):
        asked = "" if wanted is None else f" at {_listed(angles)}"
        msg = (
            f"cannot compare{asked}: the target has Lab at {_listed(spec.angles_deg)} "
            f"degrees, {table.library} at {_listed(table.angles_deg)}; at least "
            f"{fewest} must be the same, measure the target with another set of angles"
        )
        raise LibraryError(msg)
    return angles


def _listed(angles_deg: tuple[float, ...]) -> str:
    return "/".join(f"{angle:g}" for angle in angles_deg) or "no angle"
