"""Exact nearest-paint search and what its answer says."""
