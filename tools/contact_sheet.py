"""Draw every object in every light in five paints: docs/images/contact-sheet.jpg.

Run with `python tools/contact_sheet.py [FILE]` after a change of what pictures look
like, and look at it.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from paintlink.model import ColorSpec, Gloss, Lab, Sample
from paintlink.preview import light_names, object_names, render

TILE = 150
HEAD = 22
COLUMNS = 3
PAINTS = {
    "red": ((43, 56, 35), (43, 56, 35), (43, 56, 35)),
    "silver": ((128, -1, -3), (62, -1, -4), (34, -1, -5)),
    "blue": ((62, 6, -52), (24, 12, -38), (8, 10, -22)),
    "colour shift": ((95, -30, 48), (60, 10, 20), (30, 42, -38)),
    "black": ((4, 0, -1), (4, 0, -1), (4, 0, -1)),
}


def paint(name: str) -> ColorSpec:
    """One of the five paints."""
    samples = zip((15.0, 45.0, 110.0), PAINTS[name], strict=True)
    return ColorSpec(
        name,
        tuple(Sample(angle, Lab(*lab)) for angle, lab in samples),
        gloss=Gloss(92.0, 20.0),
    )


def block(shape: str, light: str) -> Image.Image:
    """One object in one light, in every paint."""
    tiles = [
        render([paint(name)], object=shape, light=light, size=TILE, backend="cpu").rgb
        for name in PAINTS
    ]
    picture = Image.new("RGB", (TILE * len(tiles), TILE + HEAD), (246, 246, 245))
    picture.paste(Image.fromarray(np.hstack(tiles)), (0, HEAD))
    words = f"{shape}, {light}"
    font = ImageFont.load_default(13)
    ImageDraw.Draw(picture).text((6, HEAD / 2), words, (38, 38, 40), font, anchor="lm")
    return picture


def main(target: Path) -> None:
    """Write the sheet."""
    blocks = [block(s, light) for light in light_names() for s in object_names()]
    width, height = blocks[0].size
    rows = -(-len(blocks) // COLUMNS)
    sheet = Image.new("RGB", (width * COLUMNS, height * rows), (246, 246, 245))
    for number, picture in enumerate(blocks):
        row, column = divmod(number, COLUMNS)
        sheet.paste(picture, (column * width, row * height))
    sheet.save(target, quality=88)


if __name__ == "__main__":
    here = Path(__file__).parents[1] / "docs/images/contact-sheet.jpg"
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else here)
