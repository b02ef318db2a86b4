"""Readings and specifications that arrive as files."""
