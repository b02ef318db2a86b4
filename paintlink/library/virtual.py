"""The bundled book of virtual paints: what its file holds beyond the table.

The paints are invented; see docs/paint-model.md. The table is `bundled`; formulas,
spectra, textures and groups are read when they are first asked for.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink.library.facets import LazyFacets
from paintlink.library.store import BUNDLED, columns, load
from paintlink.model import FloatArray, PaintTable, Spectrum, Texture

ANGLES_DEG = (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)
START_NM, STEP_NM = 400.0, 10.0
ROOT_SCALE = 27_000.0
"""Stored is the square root of a reflectance factor times this: what eyes and Lab do to
light, so that one step is as visible in black as in white."""

PRIME = "prime"


@cache
def bundled() -> PaintTable:
    """The library that comes with paintlink: 6000 virtual paints, invented.

    It is not data of any paint maker, and says so in its name and in ``synthetic``.
    """
    return replace(load(BUNDLED), facets=FACETS)


class Ingredient(NamedTuple):
    """Parts by weight of one toner; those of a formula add up to 100."""

    code: str
    name: str
    parts: float


class Columns(dict[str, NDArray[Any]]):
    """Columns of the file by name, each read when it is first asked for."""

    def __missing__(self, name: str) -> NDArray[Any]:
        """Read one."""
        self.update(columns(BUNDLED, name))
        return self[name]


class Book:
    """The bundled paints with everything known about them, by row of the table."""

    def __init__(self, table: PaintTable) -> None:
        self.table = table
        self._columns = Columns()

    def formula(self, row: int) -> tuple[Ingredient, ...]:
        """Toners of a paint, the largest amount first."""
        ends = self._columns["formula_ends"]
        part = slice(int(ends[row - 1]) if row else 0, int(ends[row]))
        codes, names = self._columns["toner_codes"], self._columns["toner_names"]
        return tuple(
            Ingredient(_text(codes[toner]), _text(names[toner]), int(amount) / 100.0)
            for toner, amount in zip(
                self._columns["formula_toners"][part],
                self._columns["formula_hundredths"][part],
                strict=True,
            )
        )

    def factors(self, row: int) -> FloatArray:
        """Reflectance factors at the angles of the table, shape (angles, 31)."""
        solids = self._columns["solid_roots"]
        if row < len(solids):
            once = decoded(solids[row])
            return np.tile(once, (len(self.table.angles_deg), 1))
        return decoded(self._columns["effect_roots"][row - len(solids)])

    def spectra(self, row: int) -> tuple[Spectrum, ...]:
        """The same as values of a specification."""
        rows = zip(self.table.angles_deg, self.factors(row).tolist(), strict=True)
        return tuple(
            Spectrum(angle, START_NM, STEP_NM, tuple(factors))
            for angle, factors in rows
        )

    def texture(self, row: int) -> tuple[Texture, ...]:
        """Texture numbers; invented, because no public formula exists."""
        names = self._columns["texture_names"]
        angles = self._columns["texture_angles_deg"].tolist()
        values = self._columns["texture_hundredths"][row].tolist()
        return tuple(
            Texture(_text(name), value / 100.0, None if np.isnan(angle) else angle)
            for name, angle, value in zip(names, angles, values, strict=True)
        )

    @property
    def primes(self) -> NDArray[np.integer[Any]]:
        """Row of the prime of every paint, shape (n,)."""
        return self._columns["primes"]

    def prime(self, row: int) -> int:
        """Row of the prime of a paint."""
        return int(self.primes[row])

    def group(self, row: int) -> tuple[int, ...]:
        """Rows of the prime and the variants around it, the prime first."""
        primes = self.primes
        members = np.flatnonzero(primes == primes[row]).tolist()
        return (int(primes[row]), *(one for one in members if one != primes[row]))

    def role(self, row: int) -> str:
        """``prime``, or how the variant looks beside its prime, such as ``redder``."""
        return _text(self._columns["role_names"][self._columns["roles"][row]])


@cache
def book() -> Book:
    """The bundled book; what was read of its file is kept."""
    return Book(bundled())


def _groups() -> list[str]:
    """Code of the prime of every paint."""
    codes = bundled().codes
    return [codes[row] for row in book().primes.tolist()]


def _variants() -> list[str]:
    return [book().role(row) for row in range(len(bundled()))]


def _formulas() -> list[str]:
    return [formula_text(book().formula(row)) for row in range(len(bundled()))]


def formula_of(table: PaintTable, row: int) -> tuple[Ingredient, ...]:
    """Toners of a paint of the bundled library; none for those of others."""
    return book().formula(row) if table is bundled() else ()


def formula_text(formula: tuple[Ingredient, ...]) -> str:
    """A formula in one line: toner codes with their parts by weight."""
    return ", ".join(f"{one.code} {one.parts:.2f}" for one in formula)


FACETS = LazyFacets({"group": _groups, "variant": _variants, "formula": _formulas})
"""Further columns of the bundled paints."""


def encoded(factors: FloatArray) -> NDArray[np.uint16]:
    """Reflectance factors as they are stored, same shape; 0 to 5.8."""
    roots = np.rint(np.sqrt(factors) * ROOT_SCALE)
    return roots.astype(np.uint16)


def decoded(roots: NDArray[np.uint16]) -> FloatArray:
    """Reflectance factors from their stored form, same shape."""
    factors: FloatArray = (roots / ROOT_SCALE) ** 2
    return factors


def _text(value: np.bytes_) -> str:
    return value.decode("utf-8")
