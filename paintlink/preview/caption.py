"""A strip of words below a picture."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from paintlink.errors import PreviewError
from paintlink.model import ColorSpec
from paintlink.preview.picture import WARNING, Picture

if TYPE_CHECKING:
    from PIL.ImageDraw import ImageDraw

LEAST_WIDTH = 128
"""Pixels; a narrower picture has no room for legible words."""

LEAST_SIZE = 8
WORTH_A_WORD = 0.01
PAPER = (246, 246, 245)
INK = (38, 38, 40)
PALE_INK = (112, 112, 114)


def with_caption(picture: Picture) -> Picture:
    """The picture with the paints' names and how they were drawn below it.

    Raises
    ------
    PreviewError
        When the picture is too small for legible words.
    """
    from PIL import Image, ImageDraw

    width = picture.rgb.shape[1]
    if width < LEAST_WIDTH:
        msg = f"a caption needs a picture {LEAST_WIDTH} pixels wide, this has {width}"
        raise PreviewError(msg)
    size = max(LEAST_SIZE + 1, round(width / 34))
    strip = Image.new("RGB", (width, round(5.4 * size)), PAPER)
    pencil = ImageDraw.Draw(strip)
    share = width / len(picture.specs)
    for number, spec in enumerate(picture.specs):
        middle = (share * (number + 0.5), 1.3 * size)
        _write(pencil, _title(spec), middle, INK, size=size, room=0.94 * share)
    for number, line in enumerate(_small_print(picture)):
        middle = (width / 2.0, (2.9 + 1.25 * number) * size)
        _write(pencil, line, middle, PALE_INK, size=0.8 * size, room=0.94 * width)
    return replace(picture, rgb=np.vstack([picture.rgb, np.asarray(strip)]))


def _title(spec: ColorSpec) -> str:
    return f"{spec.name} ({spec.code})" if spec.code else spec.name


def _small_print(picture: Picture) -> Iterator[str]:
    angles = dict.fromkeys(
        ", ".join(f"{angle:g}°" for angle in spec.angles_deg) for spec in picture.specs
    )
    observers = dict.fromkeys(f"D65/{spec.observer}°" for spec in picture.specs)
    about = f"aspecular {' | '.join(angles)} · {', '.join(observers)}"
    yield f"{about} · {picture.setting}"
    yield " · ".join([*picture.notes, *_gamut(picture), WARNING])


def _gamut(picture: Picture) -> Iterator[str]:
    """How much of the object the screen has no colour for, when it is worth a word."""
    if picture.too_chromatic >= WORTH_A_WORD:
        yield f"{picture.too_chromatic:.0%} too chromatic for sRGB"


def _write(
    pencil: ImageDraw,
    text: str,
    middle: tuple[float, float],
    ink: tuple[int, int, int],
    *,
    size: float,
    room: float,
) -> None:
    """Draw a line about its middle, smaller or shortened where room is short."""
    from PIL import ImageFont

    font = ImageFont.load_default(size)
    font = ImageFont.load_default(
        max(LEAST_SIZE, size * min(1.0, room / max(font.getlength(text), 1.0)))
    )
    while font.getlength(text) > room and len(text) > 1:
        text = text[:-2] + "…"
    pencil.text(middle, text, fill=ink, font=font, anchor="mm")
