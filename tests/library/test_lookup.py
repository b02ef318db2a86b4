from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.errors import LibraryError, SpecError
from paintlink.library import bundled, find, paint_spec
from paintlink.model import Gloss


@pytest.mark.parametrize("code", ["RM209", "rm209", "Rm209"])
def test_code_is_found_in_any_case(code: str) -> None:
    table = bundled()

    assert table.codes[find(table, code)] == "RM209"


def test_exact_code_wins_over_another_case() -> None:
    table = replace(bundled(), codes=("a1", "A1", *bundled().codes[2:]))

    assert (find(table, "a1"), find(table, "A1")) == (0, 1)


def test_code_of_two_paints_but_for_case_is_refused() -> None:
    table = replace(bundled(), codes=("aB1", "AB1", *bundled().codes[2:]))

    with pytest.raises(LibraryError, match="no paint with the code 'ab1'"):
        find(table, "ab1")


def test_unknown_code_names_the_near_ones() -> None:
    with pytest.raises(
        LibraryError, match=r"no paint with the code 'rm2091'; did you mean .*RM209"
    ):
        find(bundled(), "rm2091")


def test_code_unlike_any_other_points_to_the_name() -> None:
    with pytest.raises(LibraryError, match="code '###': look it up by its name"):
        find(bundled(), "###")


def test_paint_becomes_a_specification() -> None:
    table = bundled()
    row = find(table, "BM304")

    spec = paint_spec(table, row)

    assert (spec.code, spec.finish, spec.observer) == ("BM304", "metallic", "10")
    assert spec.angles_deg == (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)
    assert np.array_equal(spec.lab(), table.lab[row])
    assert table.gloss_gu is not None
    assert spec.gloss == Gloss(table.gloss_gu[row], 60.0)


@pytest.mark.parametrize(
    "angles", [(15.0, 45.0, 110.0), (15.0, 25.0, 45.0, 75.0, 110.0)]
)
def test_specification_takes_the_wanted_angles(angles: tuple[float, ...]) -> None:
    spec = paint_spec(bundled(), 0, angles_deg=angles)

    assert spec.angles_deg == angles


def test_invented_paint_says_so_in_its_name() -> None:
    invented = bundled()
    measured = replace(invented, synthetic=False)

    assert paint_spec(invented, 0).name == f"{invented.names[0]} (synthetic)"
    assert paint_spec(measured, 0).name == invented.names[0]


def test_library_without_gloss_gives_none() -> None:
    assert paint_spec(replace(bundled(), gloss_gu=None), 0).gloss is None


def test_angle_that_was_not_measured_is_refused() -> None:
    with pytest.raises(LibraryError, match="no Lab at 30 degrees, only at -15, 15, 25"):
        paint_spec(bundled(), 0, angles_deg=(15.0, 30.0, 110.0))


def test_number_of_angles_is_that_of_a_specification() -> None:
    with pytest.raises(SpecError, match="3, 5 or 6 aspecular angles"):
        paint_spec(bundled(), 0, angles_deg=(15.0, 110.0))
