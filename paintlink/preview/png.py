"""Pictures as PNG files; the same picture always gives the same bytes."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from paintlink import __version__
from paintlink.preview.picture import WARNING, Picture
from paintlink.spec import spec_id

SIGNATURE = b"\x89PNG\r\n\x1a\n"
TRUE_COLOUR = 2
PERCEPTUAL = 0
GAMMA = 45455
CICP = (1, 13, 0, 1)
"""BT.709 primaries, sRGB transfer, RGB, full range."""

FILTER_UP = 2
EFFORT = 6


def to_png(picture: Picture, *, deep: bool = False) -> bytes:
    """The picture as a PNG file, sRGB, with what it shows as text.

    Parameters
    ----------
    deep
        Whether to write 16 bits for each colour instead of 8; needs a picture that
        keeps its linear light.

    Raises
    ------
    PreviewError
        When ``deep`` is wanted of a picture that was drawn with 8 bits only.
    """
    rgb = picture.deep_rgb() if deep else picture.rgb
    return encoded(rgb, _words(picture))


def encoded(
    rgb: NDArray[np.uint8] | NDArray[np.uint16],
    words: Iterable[tuple[str, str]],
    effort: int = EFFORT,
) -> bytes:
    """A PNG file of sRGB colours, shape (height, width, 3), with texts by keyword.

    References
    ----------
    W3C, Portable Network Graphics (PNG) Specification, Third Edition.
    """
    height, width, _ = rgb.shape
    bits = 8 * rgb.itemsize
    header = struct.pack(">IIBBBBB", width, height, bits, TRUE_COLOUR, 0, 0, 0)
    chunks = [
        _chunk(b"IHDR", header),
        _chunk(b"cICP", bytes(CICP)),
        _chunk(b"sRGB", bytes([PERCEPTUAL])),
        _chunk(b"gAMA", struct.pack(">I", GAMMA)),
        *(_text(keyword, text) for keyword, text in words),
        _chunk(b"IDAT", zlib.compress(_scanlines(rgb), effort)),
        _chunk(b"IEND", b""),
    ]
    return SIGNATURE + b"".join(chunks)


def _words(picture: Picture) -> Iterator[tuple[str, str]]:
    yield "Software", f"paintlink {__version__}"
    for spec in picture.specs:
        yield "Paint", f"{spec_id(spec)} {spec.name}"
    yield "Object", picture.object
    yield "Light", picture.light
    yield "Renderer", f"{picture.backend}: {picture.reason}"
    yield "Too chromatic for sRGB", f"{picture.too_chromatic:.4f} of the object"
    yield "Too bright for sRGB", f"{picture.too_bright:.4f} of the object"
    yield "Comment", "; ".join([*picture.notes, WARNING])


def _scanlines(rgb: NDArray[np.uint8] | NDArray[np.uint16]) -> bytes:
    """Each row as its difference to the row above, which compresses well."""
    big_endian = rgb.astype(rgb.dtype.newbyteorder(">"))
    rows = np.ascontiguousarray(big_endian).view(np.uint8).reshape(len(rgb), -1)
    above = np.zeros_like(rows)
    above[1:] = rows[:-1]
    kind = np.full((len(rows), 1), FILTER_UP, dtype=np.uint8)
    return np.hstack([kind, rows - above]).tobytes()


def _text(keyword: str, text: str) -> bytes:
    """Uncompressed international text."""
    return _chunk(b"iTXt", keyword.encode() + b"\0\0\0\0\0" + text.encode())


def _chunk(kind: bytes, data: bytes) -> bytes:
    checksum = zlib.crc32(kind + data)
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", checksum)
