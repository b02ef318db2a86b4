"""How the bundled library of virtual paints is made; see ``tools/make_library.py``."""
