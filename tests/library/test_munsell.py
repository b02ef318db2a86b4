"""The Munsell colours: real, converted, and said to be so."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from paintlink.color import LEAVES, lab_to_lch, xyz_to_lab
from paintlink.library import Filter, find, leaves, munsell, parse_choices, statistics
from paintlink.library.renotation import MUNSELL_FILE

TOOL = Path(__file__).parents[2] / "tools" / "make_munsell.py"


def test_holds_the_real_colours_as_solids() -> None:
    table = munsell()
    found = statistics(table)

    assert len(table) == len(set(table.codes)) == 2734
    assert found.by_finish == {"solid": 2734, "metallic": 0, "pearl": 0, "unknown": 0}
    assert found.mean_flop_index is None
    assert (table.observer, table.synthetic) == ("10", False)
    assert table.angles_deg == (15.0, 45.0, 110.0)
    assert np.array_equal(table.lab, np.repeat(table.lab[:, :1], 3, axis=1))


def test_conversion_is_said_in_title_and_column() -> None:
    table = munsell()
    adapted = Filter(facets=parse_choices(["conversion=chromatic adaptation"]))

    assert "converted to D65/10" in table.library
    assert 0 < np.count_nonzero(adapted.apply(table)) < 20


@pytest.mark.parametrize("value", range(1, 10))
def test_lightness_is_that_of_the_munsell_value(value: int) -> None:
    """The luminous reflectance of each value by the polynomial of ASTM D1535."""
    table = munsell()
    mild = Filter(facets=parse_choices([f"value={value}", "chroma=2"])).apply(table)
    factors = (1.1914, -0.22533, 0.23352, -0.020484, 0.00081939)
    reflectance = sum(f * value**power for power, f in enumerate(factors, start=1))

    lightness = xyz_to_lab([0.0, reflectance, 0.0], [100.0] * 3)[0]

    assert table.lab[mild, 1, 0].mean() == pytest.approx(lightness, abs=0.15)
    assert table.lab[mild, 1, 0] == pytest.approx(lightness, abs=0.6)


def test_hues_stand_round_the_circle_in_their_order() -> None:
    table = munsell()
    names = [
        f"{step} {hue}".replace(" ", "")
        for hue in ("R", "YR", "Y", "GY", "G", "BG", "B", "PB", "P", "RP")
        for step in ("2.5", "5", "7.5", "10")
    ]

    angles = [lab_to_lch(table.lab[find(table, f"{n} 5/4"), 1])[2] for n in names]

    turns = np.diff([*angles, angles[0]]) % 360.0
    assert np.all((turns > 0.0) & (turns < 30.0))
    assert turns.sum() == pytest.approx(360.0)


def test_chroma_grows_with_the_notation() -> None:
    table = munsell()
    for hue in table.facets["hue"].values:
        row = Filter(facets=parse_choices([f"hue={hue}", "value=5"])).apply(table)
        steps = [float(table.facets["chroma"].value(i)) for i in np.flatnonzero(row)]
        chroma = lab_to_lch(table.lab[row, 1])[:, 1]

        assert np.all(np.diff(chroma[np.argsort(steps)]) > 0.0)


def test_every_drawer_of_solids_is_filled() -> None:
    found = set(np.unique(leaves(munsell())).tolist())

    assert {LEAVES[index].family for index in found} == {
        "blue", "green", "yellow", "red", "light", "medium", "dark",
    }  # fmt: skip


@pytest.mark.proof
def test_tool_writes_the_packaged_colours(tmp_path: Path) -> None:
    pytest.importorskip("colour", reason="colour-science carries the renotation")
    target = tmp_path / "munsell.npz"

    subprocess.run(
        [sys.executable, TOOL, target], check=True, env=os.environ, cwd=tmp_path
    )

    with np.load(target) as made, np.load(MUNSELL_FILE) as packaged:
        assert set(made) == set(packaged)
        step = np.abs(made["lab_hundredths"] - packaged["lab_hundredths"]).max()
        assert step <= 1
        assert np.array_equal(made["codes"], packaged["codes"])


@pytest.mark.proof
def test_conversion_is_nearer_the_truth_than_adaptation() -> None:
    pytest.importorskip("colour", reason="colour-science carries the charts")
    done = subprocess.run(
        [sys.executable, TOOL, "--check"], check=True, capture_output=True, text=True
    )

    _, smoothest, cat16 = done.stdout.splitlines()
    best = [float(value) for value in smoothest.split()[-3:]]
    assert best[0] < 0.8
    assert best[2] < 3.5
    assert float(cat16.split()[-3]) > 4.0 * best[0]
