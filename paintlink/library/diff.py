"""What changed from one state of a library to another."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from paintlink.color import cie76
from paintlink.library.blocks import Block
from paintlink.library.rows import Rows


@dataclass(frozen=True, slots=True)
class PaintChange:
    """One paint that is new, gone or different.

    Parameters
    ----------
    code, name
        As they are now, or were at the end.
    fields
        What is different: each field with its old and its new text.
    differences
        CIE76 at each aspecular angle, new minus old; empty where the colour stayed.
    """

    paint_id: int
    code: str
    name: str
    fields: tuple[tuple[str, str, str], ...] = ()
    differences: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Difference:
    """All changes from one state of a library to another, by paint id."""

    angles_deg: tuple[float, ...]
    added: tuple[PaintChange, ...]
    removed: tuple[PaintChange, ...]
    changed: tuple[PaintChange, ...]

    def __len__(self) -> int:
        return len(self.added) + len(self.removed) + len(self.changed)


def difference(
    old: Iterable[Block], new: Iterable[Block], angles_deg: tuple[float, ...]
) -> Difference:
    """What changed between two sets of blocks; paints are told by their id.

    Blocks that both states share can be left out.
    """
    before, after = _by_id(old), _by_id(new)
    both = sorted(before.keys() & after.keys())
    changes = (
        _change(paint_id, before[paint_id], after[paint_id]) for paint_id in both
    )
    return Difference(
        angles_deg,
        added=_named(after, after.keys() - before.keys()),
        removed=_named(before, before.keys() - after.keys()),
        changed=tuple(one for one in changes if one.fields or one.differences),
    )


_Place = tuple[Rows, int]


def _by_id(blocks: Iterable[Block]) -> dict[int, _Place]:
    return {
        int(paint_id): (block.rows, place)
        for block in blocks
        for place, paint_id in enumerate(block.ids)
    }


def _named(paints: dict[int, _Place], wanted: set[int]) -> tuple[PaintChange, ...]:
    found = ((paint_id, *paints[paint_id]) for paint_id in sorted(wanted))
    return tuple(
        PaintChange(paint_id, rows.codes[place], rows.names[place])
        for paint_id, rows, place in found
    )


def _change(paint_id: int, old: _Place, new: _Place) -> PaintChange:
    before, after = _fields(*old), _fields(*new)
    names = list(dict.fromkeys([*before, *after]))
    texts = ((name, before.get(name, ""), after.get(name, "")) for name in names)
    labs = old[0].lab[old[1]], new[0].lab[new[1]]
    same = np.array_equal(*labs)
    return PaintChange(
        paint_id,
        code=new[0].codes[new[1]],
        name=new[0].names[new[1]],
        fields=tuple(one for one in texts if one[1] != one[2]),
        differences=() if same else tuple(cie76(*labs).tolist()),
    )


def _fields(rows: Rows, place: int) -> dict[str, str]:
    gloss = rows.gloss_gu[place]
    return {
        "code": rows.codes[place],
        "name": rows.names[place],
        "finish": rows.finishes[place],
        "gloss": "" if np.isnan(gloss) else f"{gloss:g}",
        **{name: texts[place] for name, texts in rows.extras.items()},
    }
