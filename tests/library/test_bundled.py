"""What the bundled library promises: the statistics and names the paper prints."""

from __future__ import annotations

import re

import numpy as np
import pytest

from paintlink.color import LEAVES, Leaf, lab_to_lch, leaf
from paintlink.library import bundled, find, indices, leaves, paint_spec, statistics
from paintlink.model import FINISHES

GROUP_LETTERS = {
    "blue": "B",
    "green": "G",
    "yellow": "Y",
    "red": "R",
    "light": "L",
    "medium": "M",
    "dark": "D",
}
PAINT_MAKERS = (
    "akzo axalta basf beckers behr caparol crown cromax debeer diamont dulux dupont "
    "duxone glasurit hempel hecker herberts imron jotun kansai lechler lesonal mipa "
    "nason nexa nippon nobel octoral percotop ppg refinity roberlo salcomix sherwin "
    "sikkens spectramaster spies standohyd standox tikkurila valspar wanda"
)


def test_holds_half_solids_half_effects() -> None:
    found = statistics(bundled())

    assert found.paints == 6000
    assert found.by_finish["solid"] == 3000
    assert found.by_finish["metallic"] + found.by_finish["pearl"] == 3000
    assert found.by_finish["unknown"] == 0


def test_flop_indices_follow_the_paper() -> None:
    found = statistics(bundled())

    assert found.mean_flop_index == pytest.approx(11.38, abs=0.02)
    assert found.usual_flop_share >= 0.96
    assert found.steep_flop_paints > 0


def test_solids_do_not_flop_and_effects_do() -> None:
    table = bundled()
    flop = indices(table).flop
    solid = np.array(table.finishes) == "solid"

    assert np.all(flop[solid] == 0.0)
    assert np.all(flop[~solid] > 0.0)
    assert np.all(table.lab[solid] == table.lab[solid][:, :1])


def test_steepest_flops_are_of_very_dark_paints() -> None:
    table = bundled()
    mid_lightness = table.lab[:, 3, 0]

    assert mid_lightness[indices(table).flop > 25.0].max() < 13.0


@pytest.mark.parametrize(
    ("code", "index", "printed"),
    [
        ("YM144", "hue_shift", "12.6"),
        ("GM027", "hue_shift", "19.8"),
        ("GM044", "chroma", "46"),
        ("BM304", "flop", "16.6"),
        ("BM304", "chroma", "5.6"),
    ],
)
def test_named_paints_have_the_printed_metrics(
    code: str, index: str, printed: str
) -> None:
    table = bundled()
    digits = len(printed.partition(".")[2])

    value = getattr(indices(table), index)[find(table, code)]

    assert f"{value:.{digits}f}" == printed


@pytest.mark.parametrize("code", ["RM209", "RM331"])
def test_named_reds_are_chromatic_effects(code: str) -> None:
    spec = paint_spec(bundled(), find(bundled(), code))

    (lab,) = spec.lab(45.0)

    assert leaf(lab, spec.finish) == Leaf("effect", "red")
    assert lab_to_lch(lab)[1] > 20.0


def test_rm209_is_the_most_chromatic_red_effect() -> None:
    table = bundled()
    reds = leaves(table) == LEAVES.index(Leaf("effect", "red"))

    chroma = np.where(reds, lab_to_lch(table.lab[:, 3])[:, 1], 0.0)

    assert table.codes[int(chroma.argmax())] == "RM209"


def test_no_leaf_is_empty() -> None:
    counts = statistics(bundled()).by_leaf

    assert len(counts) == 14
    assert min(counts.values()) >= 200
    assert sum(counts.values()) == 6000


def test_codes_are_unique_and_tell_the_leaf() -> None:
    table = bundled()
    drawers = [LEAVES[index] for index in leaves(table)]

    assert len(set(table.codes)) == 6000
    for code, drawer in zip(table.codes, drawers, strict=True):
        kind = "S" if drawer.paint_set == "solid" else "M"
        assert re.fullmatch(rf"{GROUP_LETTERS[drawer.family]}{kind}\d{{3}}", code)


def test_names_are_unique_and_belong_to_no_paint_maker() -> None:
    table = bundled()
    used = {word for name in table.names for word in name.casefold().split()}

    assert len(set(table.names)) == 6000
    assert not used & set(PAINT_MAKERS.split())


def test_library_says_that_it_is_invented() -> None:
    table = bundled()

    assert table.synthetic
    assert table.library == "Virtual 6000 (synthetic)"
    assert re.fullmatch(r"[0-9a-f]{12}", table.generation)


def test_every_paint_is_a_valid_specification() -> None:
    table = bundled()

    specs = [paint_spec(table, row) for row in range(len(table))]

    assert {spec.finish for spec in specs} <= set(FINISHES)
    assert all(70.0 < spec.gloss.value_gu < 100.0 for spec in specs if spec.gloss)


@pytest.mark.parametrize(
    ("hue_from", "hue_to", "ceiling"),
    [
        (0, 45, 80),
        (45, 115, 95),
        (115, 240, 55),
        (240, 320, 70),
        (320, 360, 62),
    ],
)
def test_solids_stay_within_what_pigments_reach(
    hue_from: float, hue_to: float, ceiling: float
) -> None:
    table = bundled()
    solids = table.lab[np.array(table.finishes) == "solid"][:, 0]
    lightness, chroma, hue = lab_to_lch(solids).T
    sector = (hue >= hue_from) & (hue < hue_to)

    assert 0.4 * ceiling < chroma[sector].max() <= ceiling
    # Near black and near white there is no room for chroma.
    assert chroma[lightness < 5.0].max() < 12.0
    assert chroma[lightness > 92.0].max() < 30.0


def test_effects_darken_steadily_from_face_to_flop() -> None:
    table = bundled()
    effects = table.lab[np.array(table.finishes) != "solid"]

    assert np.all(np.diff(effects[:, :, 0], axis=1) <= 0.0)
    assert np.all(effects[:, 1, 0] > effects[:, -1, 0])


def test_no_two_paints_have_the_same_colour() -> None:
    lab = bundled().lab.reshape(6000, -1)

    assert len(np.unique(lab, axis=0)) == 6000
