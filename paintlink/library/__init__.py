"""The paint library: the bundled virtual paints, look-up, filters and statistics."""

from paintlink.library.facets import FacetChoice, facet_of, parse_choices
from paintlink.library.filters import INDEX_NAMES, Filter, IndexName, Range
from paintlink.library.histogram import Histogram, histogram
from paintlink.library.lookup import find, paint_spec
from paintlink.library.measures import (
    Indices,
    Statistics,
    indices,
    leaves,
    statistics,
)
from paintlink.library.munsell import munsell
from paintlink.library.shelf import MUNSELL, VIRTUAL, Entry, Shelf
from paintlink.library.store import bundled
from paintlink.library.virtual import Book, Ingredient, book

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
