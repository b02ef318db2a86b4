"""Random changes of a library against a plain dictionary of paints."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import ImportRefusedError, LibraryError
from paintlink.library import Shelf
from paintlink.library.incoming import Incoming
from paintlink.library.merging import MODES, Mode
from paintlink.library.rows import Conditions, Rows
from paintlink.model import PaintTable

CODES = [f"C{number}" for number in range(40)]
CONDITIONS = Conditions(angles_deg=(15.0, 45.0, 110.0))

Paint = tuple[str, float, str]  # name, L at every angle, brand
Model = dict[str, tuple[int, Paint]]  # code: id, paint


def incoming(paints: dict[str, Paint], rng: random.Random) -> Incoming:
    """Some paints in blocks of random sizes."""
    blocks = []
    left = list(paints.items())
    while left:
        size = rng.randrange(1, 6)
        blocks.append(_rows(left[:size]))
        left = left[size:]
    return Incoming("source.csv", CONDITIONS, tuple(blocks))


def _rows(paints: list[tuple[str, Paint]]) -> Rows:
    return Rows(
        codes=tuple(code for code, _ in paints),
        names=tuple(name for _, (name, _, _) in paints),
        finishes=("solid",) * len(paints),
        lab=np.array([[[L, 0.0, 0.0]] * 3 for _, (_, L, _) in paints]),
        gloss_gu=np.full(len(paints), np.nan),
        extras={"brand": tuple(brand for _, (_, _, brand) in paints)},
        places=range(1, len(paints) + 1),
    )


def content(table: PaintTable) -> Model:
    brands = table.facets["brand"]
    return {
        code: (
            int(table.ids[row]),
            (table.names[row], float(table.lab[row, 0, 0]), brands.value(row)),
        )
        for row, code in enumerate(table.codes)
    }


def imported(
    before: Model, paints: dict[str, Paint], mode: Mode, next_id: int
) -> Model | None:
    """What an import leaves, by its definition; None where it is refused."""
    if mode == "add" and before.keys() & paints.keys():
        return None
    after = {} if mode == "replace" else dict(before)
    for code, paint in paints.items():
        if code in before:
            after[code] = (before[code][0], paint)
    for code, paint in paints.items():
        if code not in before:
            after[code] = (next_id, paint)
            next_id += 1
    return after


def some_paints(rng: random.Random) -> dict[str, Paint]:
    codes = rng.sample(CODES, rng.randrange(1, 25))
    return {
        code: (
            f"name {rng.randrange(3)}",
            float(rng.randrange(3)),
            f"b{rng.randrange(3)}",
        )
        for code in codes
    }


@pytest.mark.parametrize("seed", range(12))
def test_library_does_what_the_definitions_say(tmp_path: Path, seed: int) -> None:
    rng = random.Random(seed)
    shelf = Shelf(tmp_path / "library.db")
    first = shelf.editor.import_paints("L", incoming({"C0": ("n", 1.0, "b0")}, rng))
    model: Model = {"C0": (1, ("n", 1.0, "b0"))}
    states = {first.key: model}
    next_id = 2
    for _ in range(25):
        change = rng.choice([*MODES, *MODES, "drop", "recode", "restore"])
        if change in MODES:
            paints = some_paints(rng)
            after = imported(model, paints, change, next_id)
            if after is None:
                with pytest.raises(ImportRefusedError):
                    shelf.editor.import_paints("L", incoming(paints, rng), change)
                continue
            made = shelf.editor.import_paints("L", incoming(paints, rng), change)
        elif change == "drop":
            gone = rng.sample(sorted(model), rng.randrange(1, len(model) + 1))
            after = {code: one for code, one in model.items() if code not in gone}
            if not after:
                with pytest.raises(LibraryError, match="nothing would be left"):
                    shelf.editor.remove_paints("L", gone)
                continue
            made = shelf.editor.remove_paints("L", gone)
        elif change == "recode":
            code, new = rng.choice(sorted(model)), f"X{rng.randrange(10**6)}"
            after = {new if c == code else c: one for c, one in model.items()}
            made = shelf.editor.rename_paint("L", code, new_code=new)
        else:
            key = rng.choice(sorted(states))
            after = states[key]
            made = shelf.editor.restore(key)
        model = after
        next_id = max([next_id, *(one + 1 for one, _ in model.values())])
        states[made.key] = model
        assert content(shelf.table("L")) == model

    for key, state in states.items():
        assert content(shelf.generation(key)) == state
        assert np.all(np.diff(shelf.generation(key).ids) > 0)
