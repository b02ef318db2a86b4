"""Turning the cells of a table into paints."""

from __future__ import annotations

import math
import re
from typing import cast

import numpy as np

from paintlink.library.headings import Layout
from paintlink.library.profile import Profile
from paintlink.library.rows import Conditions, RowError, Rows
from paintlink.model import Finish, FloatArray, Observer

Row = list[str]
Column = tuple[str, ...]

SYNTHETIC = "synthetic"
_ORIGINS = {
    "synthetic": True, "simulated": True, "real": False, "measured": False, "": False,
}  # fmt: skip
_OBSERVER = re.compile(r"(?:d65/)?(10|2)\s*(?:°|deg|degrees)?")


class Converter:
    """Makes paints of rows of texts; every row must say the same conditions.

    Parameters
    ----------
    first
        Rows that show how numbers are written and what the conditions are.
    """

    def __init__(self, layout: Layout, profile: Profile, first: list[Row]) -> None:
        self._layout = layout
        self._comma = (profile.decimal or _decimal(layout, first)) == ","
        self._finishes = {
            text.casefold(): finish for text, finish in profile.finishes.items()
        }
        self.conditions = Conditions(
            angles_deg=layout.angles_deg,
            observer=self._first_observer(first) or profile.observer,
            synthetic=self._first_origin(first),
        )

    def __call__(self, rows: list[Row]) -> Rows:
        """The paints of some rows.

        Raises
        ------
        RowError
            When one of the rows is none; the text fits when it is one row.
        """
        columns = self._columns(rows)
        self._check_conditions(columns)
        return Rows(
            codes=self._texts(columns, "code"),
            names=self._texts(columns, "name"),
            finishes=self._known_finishes(columns),
            lab=self._lab(columns),
            gloss_gu=self._gloss(columns),
            extras={
                heading: tuple(map(str.strip, columns[place]))
                for heading, place in self._layout.extras.items()
            },
        )

    def _columns(self, rows: list[Row]) -> list[Column]:
        width = self._layout.width
        if set(map(len, rows)) != {width}:
            msg = f"it has {len(rows[0])} cells where the heading has {width}"
            raise RowError(msg)
        return list(zip(*rows, strict=True))

    def _lab(self, columns: list[Column]) -> FloatArray:
        """Lab of shape (n, angles, 3) in one run for each column of the table."""
        planes = np.array([
            [
                self._numbers(columns[place], f"{letter} at {angle:g} degrees")
                for letter, place in zip("Lab", places, strict=True)
            ]
            for angle, places in zip(
                self._layout.angles_deg, self._layout.lab, strict=True
            )
        ])
        return (planes + 0.0).transpose(2, 0, 1)  # no -0.0

    def _numbers(self, texts: Column, what: str) -> FloatArray:
        if self._comma:
            texts = tuple(text.replace(",", ".") for text in texts)
        try:
            values = np.fromiter(map(float, texts), np.float64, len(texts))
        except ValueError as error:
            raise _no_number(texts, what) from error
        if "_" in "".join(texts):  # which float() takes for a separator
            raise _no_number(texts, what)
        return values

    def _gloss(self, columns: list[Column]) -> FloatArray:
        place = self._layout.texts.get("gloss")
        if place is None:
            return np.full(len(columns[0]), math.nan)
        texts = tuple(text if text.strip() else "nan" for text in columns[place])
        return self._numbers(texts, "the gloss")

    def _texts(self, columns: list[Column], field: str) -> Column:
        place = self._layout.texts.get(field)
        return ("",) * len(columns[0]) if place is None else _stripped(columns[place])

    def _known_finishes(self, columns: list[Column]) -> tuple[Finish, ...]:
        place = self._layout.texts.get("finish")
        texts = ("",) * len(columns[0]) if place is None else columns[place]
        known = {text: self._finish(text.strip()) for text in set(texts)}
        return tuple(map(known.__getitem__, texts))

    def _finish(self, text: str) -> Finish:
        folded = text.casefold()
        # What is no finish at all is refused with the other checks of a paint.
        return self._finishes.get(folded, cast("Finish", folded or "unknown"))

    def _check_conditions(self, columns: list[Column]) -> None:
        wanted = self.conditions
        for text in self._distinct(columns, "observer"):
            if _observer(text) != wanted.observer:
                msg = (
                    f"observer {text!r} among paints for the {wanted.observer} degree "
                    "observer: import them into a library of their own"
                )
                raise RowError(msg)
        for text in self._distinct(columns, "illuminant"):
            if not text.upper().startswith("D65"):
                msg = f"illuminant {text!r}: a library holds Lab for D65 only"
                raise RowError(msg)
        for text in self._distinct(columns, "origin"):
            if _ORIGINS.get(text.casefold()) is not wanted.synthetic:
                kind = SYNTHETIC if wanted.synthetic else "real"
                msg = f"origin {text!r} among {kind} paints: keep them apart"
                raise RowError(msg)

    def _distinct(self, columns: list[Column], field: str) -> set[str]:
        place = self._layout.texts.get(field)
        return set() if place is None else set(map(str.strip, set(columns[place])))

    def _first_observer(self, rows: list[Row]) -> Observer | None:
        return _observer(self._first(rows, "observer"))

    def _first_origin(self, rows: list[Row]) -> bool:
        return _ORIGINS.get(self._first(rows, "origin").casefold(), False)

    def _first(self, rows: list[Row], field: str) -> str:
        place = self._layout.texts.get(field, -1)
        whole = (row for row in rows if 0 <= place < len(row))
        return next((row[place].strip() for row in whole), "")


def _stripped(texts: Column) -> Column:
    return tuple(map(str.strip, texts))


def _observer(text: str) -> Observer | None:
    found = _OBSERVER.fullmatch(text.strip().casefold())
    return cast("Observer", found[1]) if found else None


def _decimal(layout: Layout, rows: list[Row]) -> str:
    """The decimal sign: a comma where L, a or b has one and never a point."""
    places = [place for triple in layout.lab for place in triple]
    whole = [row for row in rows if len(row) == layout.width]
    cells = "".join(row[place] for row in whole for place in places)
    return "," if "," in cells and "." not in cells else "."


def _no_number(texts: Column, what: str) -> RowError:
    text = texts[0].strip()
    if not text:
        return RowError(f"{what} is missing: measure it, or leave the paint out")
    return RowError(f"{what} is no number (found {text!r})")
