"""paintlink: from multi-angle spectrophotometer to paint formula."""

__version__ = "0.1.0"
