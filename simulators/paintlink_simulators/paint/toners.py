"""The mixing bench: every toner of the virtual paint system, in one fixed order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from paintlink.errors import InputError
from paintlink.model import FloatArray
from paintlink_simulators.paint.flakes import FLAKES, Flake
from paintlink_simulators.paint.pigments import PIGMENTS, Pigment

Formula = Mapping[str, float]
"""Parts by weight by toner code; only their ratios matter."""


@dataclass(frozen=True, slots=True)
class FlopControl:
    """A clear additive that tilts flakes and so lowers the flop."""

    code: str
    name: str


Toner = Pigment | Flake | FlopControl

TONERS: tuple[Toner, ...] = (
    *PIGMENTS,
    *FLAKES,
    FlopControl("F90", "flop control"),
)
"""Columns of every array of amounts."""

CODES = tuple(toner.code for toner in TONERS)
NAMES: Mapping[str, str] = MappingProxyType({t.code: t.name for t in TONERS})
FLAKE_COLUMNS = slice(len(PIGMENTS), len(PIGMENTS) + len(FLAKES))
PIGMENT_COLUMNS = slice(0, len(PIGMENTS))
FLOP_CONTROL_COLUMN = len(TONERS) - 1


def amounts(formulas: Sequence[Formula]) -> FloatArray:
    """Formulas as an array of parts, shape (n, toners), for `model.reflect`.

    Raises
    ------
    InputError
        When a formula names a toner that is not on the bench.
    """
    table = np.zeros((len(formulas), len(TONERS)))
    for row, formula in enumerate(formulas):
        for code, parts in formula.items():
            table[row, column(code)] = parts
    return table


def column(code: str) -> int:
    """Column of a toner.

    Raises
    ------
    InputError
        When there is no such toner.
    """
    try:
        return CODES.index(code)
    except ValueError:
        msg = (
            f"the virtual paint system has no toner {code!r}: "
            f"its toners are {', '.join(CODES)}"
        )
        raise InputError(msg) from None


def formula(parts: FloatArray) -> dict[str, float]:
    """One row of amounts as toner codes and parts, the largest first."""
    order = np.argsort(-parts, kind="stable")
    return {CODES[i]: float(parts[i]) for i in order if parts[i] > 0.0}
