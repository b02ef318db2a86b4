"""The paint library: the bundled virtual paints, look-up, filters and statistics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from paintlink.late import late

if TYPE_CHECKING:
    from paintlink.library.facets import FacetChoice, facet_of, parse_choices
    from paintlink.library.filters import INDEX_NAMES, Filter, IndexName, Range
    from paintlink.library.histograms import Histogram, histogram
    from paintlink.library.lookup import find, paint_spec
    from paintlink.library.measures import (
        Indices,
        Statistics,
        indices,
        leaves,
        statistics,
    )
    from paintlink.library.renotation import munsell
    from paintlink.library.shelf import MUNSELL, VIRTUAL, Entry, Shelf
    from paintlink.library.virtual import Book, Ingredient, book, bundled

__all__ = [
    "INDEX_NAMES",
    "MUNSELL",
    "VIRTUAL",
    "Book",
    "Entry",
    "FacetChoice",
    "Filter",
    "Histogram",
    "IndexName",
    "Indices",
    "Ingredient",
    "Range",
    "Shelf",
    "Statistics",
    "book",
    "bundled",
    "facet_of",
    "find",
    "histogram",
    "indices",
    "leaves",
    "munsell",
    "paint_spec",
    "parse_choices",
    "statistics",
]

_HOMES = {
    "INDEX_NAMES": "filters",
    "MUNSELL": "shelf",
    "VIRTUAL": "shelf",
    "Book": "virtual",
    "Entry": "shelf",
    "FacetChoice": "facets",
    "Filter": "filters",
    "Histogram": "histograms",
    "IndexName": "filters",
    "Indices": "measures",
    "Ingredient": "virtual",
    "Range": "filters",
    "Shelf": "shelf",
    "Statistics": "measures",
    "book": "virtual",
    "bundled": "virtual",
    "facet_of": "facets",
    "find": "lookup",
    "histogram": "histograms",
    "indices": "measures",
    "leaves": "measures",
    "munsell": "renotation",
    "paint_spec": "lookup",
    "parse_choices": "facets",
    "statistics": "measures",
}
"""Module of each name, imported when it is first asked for: a search needs one."""

__getattr__ = late(__name__, _HOMES)
