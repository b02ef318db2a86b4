"""The Munsell colours: a library of real solids, converted to D65/10.

Made by tools/make_munsell.py; docs/library.md says how, and how far it can be trusted.
"""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from pathlib import Path

from paintlink.library.facets import facet
from paintlink.library.store import columns, load
from paintlink.model import PaintTable

MUNSELL_FILE = Path(__file__).parent / "data" / "munsell.npz"
RECONSTRUCTED, ADAPTED = "smoothest reflectance", "chromatic adaptation"
_NOTATION = re.compile(r"(.+) (.+)/(.+)")


@cache
def munsell() -> PaintTable:
    """The 2734 real Munsell colours of 1943, the same at every angle like any solid.

    Further columns: the parts of the notation, and the ``conversion`` from C/2.
    """
    table = load(MUNSELL_FILE)
    adapted = columns(MUNSELL_FILE, "adapted")["adapted"]
    parts = [_parts(code) for code in table.codes]
    further = {
        name: facet([part[place] for part in parts])
        for place, name in enumerate(("hue", "value", "chroma"))
    }
    ways = [ADAPTED if one else RECONSTRUCTED for one in adapted]
    further["conversion"] = facet(ways)
    return replace(table, gloss_gu=None, facets=further)


def _parts(code: str) -> tuple[str, ...]:
    found = _NOTATION.fullmatch(code)
    return found.groups() if found else ("", "", "")
