from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.errors import ConfigError, LibraryError
from paintlink.library import FacetChoice, Filter, bundled, facet_of, parse_choices
from paintlink.library.facets import LazyFacets, facet
from paintlink.model import PaintTable


def with_brands() -> PaintTable:
    table = bundled()
    brands = [("Alpha", "Beta", "")[row % 3] for row in range(len(table))]
    years = [str(1990 + row % 30) for row in range(len(table))]
    return replace(table, facets={"Brand": facet(brands), "year": facet(years)})


def test_values_are_sorted_and_empty_ones_are_missing() -> None:
    found = facet(["b", "", "a", "b"])

    assert found.values == ("a", "b")
    assert found.codes.tolist() == [1, -1, 0, 1]
    assert [found.value(row) for row in range(4)] == ["b", "", "a", "b"]


def test_asking_for_a_column_by_name_does_not_read_it() -> None:
    read: list[str] = []
    facets = LazyFacets({"group": lambda: read.append("group") or ["a"]})

    assert "group" in facets
    assert "brand" not in facets
    assert read == []
    assert (facets["group"].values, read) == (("a",), ["group"])


def test_column_without_any_value_has_no_values() -> None:
    found = facet(["", ""])

    assert (found.values, found.codes.tolist()) == ((), [-1, -1])


def test_conditions_on_one_column_widen_and_on_two_narrow() -> None:
    chosen = parse_choices(["brand=alpha", "BRAND=x", "year=2001..2002"])

    mask = Filter(facets=chosen).apply(with_brands())

    assert mask.tolist() == [
        row % 3 == 0 and row % 30 in {11, 12} for row in range(6000)
    ]


@pytest.mark.parametrize(
    ("text", "years"),
    [("..1991", {"1990", "1991"}), ("2019..", {"2019"}), ("2000..2000", {"2000"})],
)
def test_range_may_lack_an_end(text: str, years: set[str]) -> None:
    table = with_brands()

    mask = FacetChoice("year", (text,)).mask(table)

    assert {table.facets["year"].value(row) for row in np.flatnonzero(mask)} == years


def test_points_between_words_are_no_range() -> None:
    table = replace(with_brands(), facets={"a": facet(["x..y"] * 6000)})

    assert FacetChoice("a", ("X..Y",)).mask(table).all()


@pytest.mark.parametrize("text", ["brand", "=alpha", ""])
def test_condition_without_a_column_is_refused(text: str) -> None:
    with pytest.raises(ConfigError, match="write a condition as column=value"):
        parse_choices([text])


def test_unknown_column_names_the_known_ones() -> None:
    with pytest.raises(LibraryError, match="no column 'make'; it has Brand, year"):
        facet_of(with_brands(), "make")
    plain = replace(bundled(), facets={})
    with pytest.raises(LibraryError, match="it has none beside code, name and finish"):
        Filter(facets=(FacetChoice("make", ("x",)),)).apply(plain)


def test_condition_nobody_meets_is_named() -> None:
    with pytest.raises(LibraryError, match="passes the filter Brand Gamma or x: widen"):
        Filter(facets=(FacetChoice("Brand", ("Gamma", "x")),)).apply(with_brands())
