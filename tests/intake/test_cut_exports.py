"""An export cut anywhere is refused, or read as what the whole file says."""

from __future__ import annotations

import pytest

from paintlink.errors import InputError
from paintlink.intake import Import, importers, read_any
from tests.intake.test_fuzz import document

CUTS = 150
LAST_LINE = "the last line has no end"


def colours(found: Import) -> set[tuple[object, ...]]:
    """Name, angle and colour of everything that was read, to a printed digit."""
    return {
        (spec.name, one.aspecular_deg, *(round(value, 1) for value in one.lab))
        for spec in found.specs
        for one in spec.samples
        if one.lab
    }


@pytest.mark.parametrize("format_id", sorted(importers()))
def test_cut_export_never_gives_another_colour(format_id: str) -> None:
    data = document(format_id)
    whole = colours(read_any(data, name="export", format_id=format_id))

    for cut in range(1, len(data), max(1, len(data) // CUTS)):
        try:
            found = read_any(data[:cut], name="export", format_id=format_id)
        except InputError:
            continue
        assert colours(found) <= whole or told(found), f"cut at {cut}"


def told(found: Import) -> bool:
    return any(LAST_LINE in note for note in found.notes)


def test_table_that_ends_within_a_row_is_refused() -> None:
    data = document("csv_table")[:-20]

    with pytest.raises(InputError, match="ends within this row, after 16 of 26 cells"):
        read_any(data, name="shop.csv")


def test_table_without_its_last_line_end_is_read_and_told() -> None:
    data = document("csv_table")

    assert told(read_any(data.rstrip(), name="shop.csv"))
    assert not told(read_any(data, name="shop.csv"))
