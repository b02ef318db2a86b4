"""One paint of a library: found by its code, shown as a colour specification."""

from __future__ import annotations

import numpy as np

from paintlink.errors import LibraryError
from paintlink.model import ColorSpec, Gloss, Lab, PaintTable, Sample

GLOSS_ANGLE_DEG = 60.0
"""Angle of the gloss column of every library."""

SYNTHETIC_MARK = " (synthetic)"
"""Ends the name of every invented paint once it leaves its library."""


def find(table: PaintTable, code: str) -> int:
    """Row of the paint with this code, in any case.

    Raises
    ------
    LibraryError
        When there is none; names the codes that come near.
    """
    if code in table.codes:
        return table.codes.index(code)
    folded = [known.casefold() for known in table.codes]
    if folded.count(code.casefold()) == 1:
        return folded.index(code.casefold())
    msg = f"{table.library} has no paint with the code {code!r}{_near(code, table)}"
    raise LibraryError(msg)


def _near(code: str, table: PaintTable) -> str:
    from difflib import get_close_matches

    near = get_close_matches(code.upper(), table.codes, n=3)
    return f"; did you mean {', '.join(near)}?" if near else ": look it up by its name"


def paint_spec(
    table: PaintTable, row: int, *, angles_deg: tuple[float, ...] | None = None
) -> ColorSpec:
    """One paint as a specification, at all angles of the library or at some.

    The name of an invented paint ends in "(synthetic)", so that no file and no
    picture made from it can pass for a real one.
    """
    wanted = table.angles_deg if angles_deg is None else angles_deg
    name = table.names[row]
    return ColorSpec(
        name=f"{name}{SYNTHETIC_MARK}" if table.synthetic else name,
        code=table.codes[row],
        finish=table.finishes[row],
        observer=table.observer,
        samples=tuple(_sample(table, row, angle) for angle in wanted),
        gloss=_gloss(table, row),
    )


def column(library: str, angles_deg: tuple[float, ...], angle_deg: float) -> int:
    """Index of an aspecular angle on the second axis of the Lab of a library.

    Raises
    ------
    LibraryError
        When the library was not measured there.
    """
    if angle_deg not in angles_deg:
        known = ", ".join(f"{angle:g}" for angle in angles_deg)
        msg = (
            f"{library} has no Lab at {angle_deg:g} degrees, only at {known}: "
            "ask for one of these, or take a library that has it"
        )
        raise LibraryError(msg)
    return angles_deg.index(angle_deg)


def _sample(table: PaintTable, row: int, angle_deg: float) -> Sample:
    place = column(table.library, table.angles_deg, angle_deg)
    return Sample(angle_deg, Lab(*table.lab[row, place].tolist()))


def _gloss(table: PaintTable, row: int) -> Gloss | None:
    if table.gloss_gu is None or np.isnan(table.gloss_gu[row]):
        return None
    return Gloss(float(table.gloss_gu[row]), GLOSS_ANGLE_DEG)
