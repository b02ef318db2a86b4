from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from paintlink.color import LEAVES, NO_LEAF, Leaf, leaf, leaf_indices
from paintlink.color.hierarchy import (
    CHROMA_LIMIT_EFFECT,
    CHROMA_LIMIT_SOLID,
    HUE_STARTS_DEG,
    LIGHT_FROM_L,
    MEDIUM_FROM_L,
)


def at_hue(hue_deg: float, chroma: float = 30.0) -> tuple[float, float, float]:
    hue = np.radians(hue_deg)
    return (50.0, chroma * float(np.cos(hue)), chroma * float(np.sin(hue)))


def test_tree_has_the_fourteen_leaves():
    assert len(LEAVES) == len(set(LEAVES)) == 14
    assert sum(leaf.chromatic for leaf in LEAVES) == 8
    assert sum(leaf.paint_set == "solid" for leaf in LEAVES) == 7


@pytest.mark.parametrize(
    ("hue_deg", "family"),
    [(0, "red"), (25, "red"), (90, "yellow"), (165, "green"), (245, "blue")],
)
def test_elementary_hues_find_their_family(hue_deg, family):
    assert leaf(at_hue(hue_deg), "solid") == Leaf("solid", family)


@pytest.mark.parametrize(("start_deg", "family"), HUE_STARTS_DEG)
def test_hue_limit_belongs_to_next_family(start_deg, family):
    assert leaf(at_hue(start_deg + 1e-6), "pearl").family == family
    assert leaf(at_hue(start_deg - 1e-6), "pearl").family != family


@pytest.mark.parametrize(
    ("finish", "limit"),
    [
        ("solid", CHROMA_LIMIT_SOLID),
        ("metallic", CHROMA_LIMIT_EFFECT),
        ("pearl", CHROMA_LIMIT_EFFECT),
    ],
)
def test_chroma_limit_separates_neutrals(finish, limit):
    assert leaf((50, limit, 0), finish).family == "red"
    assert leaf((50, limit - 0.01, 0), finish).family == "medium"


@pytest.mark.parametrize(
    ("light", "family"),
    [
        (170, "light"),
        (LIGHT_FROM_L, "light"),
        (LIGHT_FROM_L - 0.01, "medium"),
        (MEDIUM_FROM_L, "medium"),
        (MEDIUM_FROM_L - 0.01, "dark"),
        (-1, "dark"),
    ],
)
def test_neutrals_divide_by_value(light, family):
    assert leaf((light, 1, -1), "solid") == Leaf("solid", family)


def test_metallic_and_pearl_share_leaves():
    assert leaf(at_hue(245), "metallic") is leaf(at_hue(245), "pearl")
    assert leaf(at_hue(245), "metallic") == Leaf("effect", "blue")


def test_unknown_finish_has_no_leaf():
    assert leaf(at_hue(245), "unknown") is None
    assert leaf_indices([at_hue(245)], ["unknown"]).tolist() == [NO_LEAF]


@given(
    st.lists(
        st.tuples(
            st.tuples(st.floats(-5, 160), st.floats(-90, 90), st.floats(-90, 90)),
            st.sampled_from(["solid", "metallic", "pearl", "unknown"]),
        ),
        min_size=1,
    )
)
def test_table_form_equals_single_form(rows):
    lab, finishes = zip(*rows, strict=True)

    indices = leaf_indices(lab, finishes)

    leaves = [None if index == NO_LEAF else LEAVES[index] for index in indices]
    assert leaves == [leaf(*row) for row in rows]
