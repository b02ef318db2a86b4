from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import LibraryError
from paintlink.snap import nearest
from tests.snap.conftest import SIX, make_table, make_target


def flat(angles: int) -> np.ndarray:
    return np.full((angles, 3), 50.0)


def compared(
    target: tuple[float, ...],
    library: tuple[float, ...],
    wanted: tuple[float, ...] | None = None,
) -> tuple[float, ...]:
    spec = make_target(flat(len(target)), angles_deg=target)
    table = make_table([flat(len(library))], angles_deg=library)
    return nearest(spec, table, angles_deg=wanted)[0].angles_deg


@pytest.mark.parametrize(
    ("target", "library", "expected"),
    [
        ((15.0, 45.0, 110.0), SIX, (15.0, 45.0, 110.0)),
        (SIX, (15.0, 45.0, 110.0), (15.0, 45.0, 110.0)),
        (SIX, SIX, (15.0, 45.0, 110.0)),
        ((25.0, 45.0, 75.0), SIX, (25.0, 45.0, 75.0)),
        ((-15.0, 15.0, 25.0, 45.0, 75.0), SIX, (-15.0, 15.0, 25.0, 45.0, 75.0)),
    ],
)
def test_angles_are_those_of_the_paper_or_all_common(
    target: tuple[float, ...],
    library: tuple[float, ...],
    expected: tuple[float, ...],
) -> None:
    assert compared(target, library) == expected


def test_wanted_angles_are_compared_in_ascending_order() -> None:
    assert compared(SIX, SIX, (45, 15)) == (15.0, 45.0)


@pytest.mark.parametrize(
    ("target", "library", "wanted"),
    [
        ((15.0, 45.0, 110.5), (15.0, 45.0, 110.0), None),
        ((15.0, 45.0, 110.0), SIX, (15.0, 25.0)),
        (SIX, (15.0, 45.0, 110.0), (15.0, 25.0)),
        (SIX, SIX, ()),
    ],
)
def test_refuses_angles_that_are_not_on_both_sides(
    target: tuple[float, ...],
    library: tuple[float, ...],
    wanted: tuple[float, ...] | None,
) -> None:
    with pytest.raises(LibraryError, match="cannot compare") as refusal:
        compared(target, library, wanted)

    text = str(refusal.value)
    assert f"target has Lab at {'/'.join(f'{a:g}' for a in target)} degrees" in text
    assert f"Test book at {'/'.join(f'{a:g}' for a in library)}" in text


def test_refuses_another_observer() -> None:
    spec = make_target(flat(3), observer="2")

    with pytest.raises(
        LibraryError,
        match=r"2 degree observer, Test book for the 10 .* from its spectra",
    ):
        nearest(spec, make_table([flat(3)]))


def test_refuses_an_unknown_formula() -> None:
    with pytest.raises(
        LibraryError, match="unknown difference formula 'cie1976': take cie76 or cie94"
    ):
        nearest(make_target(flat(3)), make_table([flat(3)]), formula="cie1976")


def test_library_is_interpolated_for_instruments_with_other_angles() -> None:
    paint = [[80.0, 4.0, 0.0], [50.0, 4.0, 0.0], [30.0, 4.0, 0.0]]
    target = make_target([[70.0, 4.0, 0.0]] * 3, angles_deg=(25.0, 45.0, 75.0))

    (match,) = nearest(target, make_table([paint]))

    assert match.angles_deg == (25.0, 45.0, 75.0)
    assert match.estimated_deg == (25.0, 75.0)
    at_25, at_45, at_75 = match.differences
    assert 0.0 < abs(at_25.dL) < 10.0
    assert at_45.dL == 20.0
    assert 20.0 < at_75.dL < 40.0
    assert (at_25.da, at_75.da) == (0.0, 0.0)


def test_measured_angles_are_never_called_estimated() -> None:
    (match,) = nearest(make_target(flat(3)), make_table([flat(3)]))

    assert match.estimated_deg == ()


def test_paint_without_lab_at_an_angle_is_left_out() -> None:
    holed = flat(3)
    holed[1] = np.nan
    table = make_table([holed, flat(3) + 5.0])
    mask = np.array([True, True])

    for allowed in (None, mask):
        (match,) = nearest(make_target(flat(3)), table, mask=allowed)

        assert match.code == "C1"


def test_refuses_a_library_without_one_complete_paint() -> None:
    holed = flat(3)
    holed[1] = np.nan

    with pytest.raises(
        LibraryError, match="no paint of Test book has Lab at all of 15"
    ):
        nearest(make_target(flat(3)), make_table([holed]))


def test_refuses_when_the_filter_passes_only_incomplete_paints() -> None:
    holed = flat(3)
    holed[1] = np.nan
    table = make_table([holed, flat(3)])

    with pytest.raises(LibraryError, match="no paint of Test book can be compared"):
        nearest(make_target(flat(3)), table, mask=np.array([True, False]))
