"""The paint library: the bundled stand-in, look-up, filters and statistics."""

from paintlink.library.filters import Filter, Range
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
    "Filter",
    "Indices",
    "Range",
    "Statistics",
    "bundled",
    "find",
    "indices",
    "leaves",
    "paint_spec",
    "statistics",
]
