"""Set-ups for the tests, and pictures in and out of Pillow."""

from __future__ import annotations

import io
import struct
import zlib
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from PIL import Image

from paintlink.model import ColorSpec
from paintlink.sketch.geometry import pixel_geometry
from paintlink.sketch.pose import Pose, light_for
from paintlink.sketch.setup import SetUp, set_up
from paintlink.sketch.start import start_codes
from tests.preview.truth import SILVER, paint

BLUE = paint((62, -6, -28), (31, 2, -34), (14, 4, -22))
BROWN = paint((55, 45, 30), (35, 38, 25), (20, 25, 14))
GREEN = paint((70, -20, 30), (45, -16, 25), (25, -9, 14))
OBJECTS = ("cylinder", "panel", "sphere")
GREY_CODE = 118


@cache
def made(name: str = "sphere", size: int = 512, bits: int = 8) -> SetUp:
    """A silver set up on an object in the light that suits it."""
    return set_up(SILVER, Pose(name, light_for(name), size), bits=bits)


def start_image(name: str = "sphere", size: int = 512) -> Image.Image:
    """The start picture as a program opens it."""
    return image_of(made(name, size).files["start.png"])


def image_of(data: bytes) -> Image.Image:
    image = Image.open(io.BytesIO(data))
    image.load()
    return image


def values(image: Image.Image) -> np.ndarray:
    """Samples of an 8-bit picture, 0 to 1."""
    return np.asarray(image.convert("RGB")).astype(np.float32) / np.float32(255.0)


def stored(image: Image.Image, path: Path, **options: object) -> Path:
    """The path, after the picture was saved there."""
    image.save(path, **options)
    return path


def png16(codes: np.ndarray, path: Path, *chunks: bytes) -> Path:
    """A PNG of 16 bits a channel, every row filtered another way."""
    height, width, channels = codes.shape
    kind = {3: 2, 4: 6}[channels]
    header = struct.pack(">IIBBBBB", width, height, 16, kind, 0, 0, 0)
    rows = np.frombuffer(codes.astype(">u2").tobytes(), np.uint8).reshape(height, -1)
    lines = b"".join(
        bytes([index % 3]) + _filtered(rows, index, 2 * channels).tobytes()
        for index in range(height)
    )
    parts = [
        chunk(b"IHDR", header),
        *chunks,
        chunk(b"IDAT", zlib.compress(lines)),
        chunk(b"IEND", b""),
    ]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(parts))
    return path


def _filtered(rows: np.ndarray, index: int, across: int) -> np.ndarray:
    row, above = rows[index], rows[index - 1] if index else np.zeros_like(rows[0])
    before = np.concatenate([np.zeros(across, np.uint8), row[:-across]])
    return row - (np.zeros_like(row), before, above)[index % 3]


def chunk(kind: bytes, data: bytes) -> bytes:
    checksum = zlib.crc32(kind + data)
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", checksum)


def tiff16(codes: np.ndarray, path: Path, *, order: str = "<", deflate: bool) -> Path:
    """A TIFF of 16 bits a channel in one strip, plain or deflated."""
    height, width, channels = codes.shape
    strip = codes.astype(order + "u2").tobytes()
    strip = zlib.compress(strip) if deflate else strip
    depths = 8 + 2 + 12 * 9 + 4
    entries = [
        (256, 4, 1, width),
        (257, 4, 1, height),
        (258, 3, channels, depths),
        (259, 4, 1, 8 if deflate else 1),
        (262, 4, 1, 2),
        (273, 4, 1, depths + 2 * channels),
        (277, 4, 1, channels),
        (278, 4, 1, height),
        (279, 4, 1, len(strip)),
    ]
    mark = b"II" if order == "<" else b"MM"
    parts = [struct.pack(order + "2sHIH", mark, 42, 8, len(entries))]
    parts += [struct.pack(order + "HHII", *entry) for entry in entries]
    parts += [struct.pack(order + f"I{channels}H", 0, *[16] * channels), strip]
    path.write_bytes(b"".join(parts))
    return path


def painted(
    name: str = "sphere", size: int = 512, bits: int = 8, paint: ColorSpec = BLUE
) -> np.ndarray:
    """Samples of the start picture after an artist changed the paint."""
    recipe = made(name, size, bits).recipe
    geometry = pixel_geometry(recipe.pose)
    return start_codes(replace(recipe, start=paint), geometry)
