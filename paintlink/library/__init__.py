"""The paint library: bundled data, table, filters."""
