"""Draw paints of the bundled library on one sheet: docs/images/library.png.

Usage: ``python tools/contact_sheet.py [FILE]``. The first row holds the paints the
paper names; below it every leaf has one row from the whole length of its page.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from paintlink.color import LEAVES
from paintlink.library import bundled, find, leaves, paint_spec
from paintlink.model import PaintTable
from paintlink.preview import render

TARGET = Path(__file__).resolve().parents[1] / "docs" / "images" / "library.png"
NAMED = ("YM144", "GM027", "GM044", "BM304", "RM209", "RM331")
COLUMNS, SIZE, GAP, TEXT = 9, 96, 4, 14
EFFECTS = range(7, len(LEAVES))
PAPER, INK = (255, 255, 255), (40, 40, 40)


def main() -> None:
    """Draw the sheet."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET
    table = bundled()
    rows = [[find(table, code) for code in NAMED], *(page(table, i) for i in EFFECTS)]
    rows += [page(table, leaf) for leaf in (0, 3)]
    width = GAP + COLUMNS * (SIZE + GAP)
    sheet = Image.new("RGB", (width, len(rows) * (SIZE + TEXT + GAP) + GAP), PAPER)
    draw = ImageDraw.Draw(sheet)
    for line, paints in enumerate(rows):
        top = GAP + line * (SIZE + TEXT + GAP)
        for place, row in enumerate(paints):
            left = GAP + place * (SIZE + GAP)
            sheet.paste(thumbnail(table, row), (left, top))
            draw.text((left, top + SIZE + 1), table.codes[row], INK)
    target.parent.mkdir(parents=True, exist_ok=True)
    sheet.quantize(256, Image.Quantize.MEDIANCUT).save(target, optimize=True)


def page(table: PaintTable, leaf: int) -> list[int]:
    """Rows from the whole length of a leaf."""
    members = np.flatnonzero(leaves(table) == leaf)
    return members[np.linspace(0, len(members) - 1, COLUMNS).astype(int)].tolist()


def thumbnail(table: PaintTable, row: int) -> Image.Image:
    """One paint on a sphere."""
    picture = render([paint_spec(table, row)], object="sphere", size=2 * SIZE)
    return Image.fromarray(picture.rgb).resize((SIZE, SIZE), Image.Resampling.LANCZOS)


if __name__ == "__main__":
    main()
