"""The paint library: the bundled stand-in, look-up, filters and statistics."""

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
from paintlink.library.store import bundled

__all__ = [
    "INDEX_NAMES",
    "FacetChoice",
    "Filter",
    "Histogram",
    "IndexName",
    "Indices",
    "Range",
    "Statistics",
    "bundled",
    "facet_of",
    "find",
    "histogram",
    "indices",
    "leaves",
    "paint_spec",
    "parse_choices",
    "statistics",
]
