"""Colour profiles embedded in pictures: matrix profiles to sRGB, in full precision."""

from __future__ import annotations

import struct
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from paintlink.color.display import BRADFORD, XYZ_TO_SRGB, encode_srgb
from paintlink.errors import InputError
from paintlink.model import FloatArray
from paintlink.sketch.transfer import decode_srgb

HEADER_BYTES = 128
MOST_TAGS = 100
D50 = np.array([0.9642, 1.0, 0.8249])
TABLE_STEPS = 1 << 16
STEPS = np.linspace(0.0, 1.0, TABLE_STEPS)

WAY_OUT = "convert the picture to sRGB in your program and save it again"

_PARAMETERS = {0: "g", 1: "gab", 2: "gabc", 3: "gabcd", 4: "gabcdef"}


@dataclass(frozen=True, slots=True, eq=False)
class Profile:
    """A matrix profile of an RGB space.

    Parameters
    ----------
    name
        What it calls itself.
    curves
        Linear value of each of 65536 even steps of a channel, shape (3, 65536).
    to_srgb
        Matrix from linear values (as a row) to linear sRGB.
    """

    name: str
    curves: FloatArray
    to_srgb: FloatArray

    def convert(self, encoded: FloatArray) -> FloatArray:
        """Encoded sRGB, shape (..., 3), not yet limited to 0 to 1."""
        curves = ((STEPS, curve) for curve in self.curves)
        return encode_srgb(_each_channel(encoded, curves) @ self.to_srgb)

    def from_srgb(self, encoded: FloatArray) -> FloatArray:
        """Values of this space, 0 to 1, that show encoded sRGB, shape (..., 3)."""
        linear = decode_srgb(encoded) @ np.linalg.inv(self.to_srgb)
        return _each_channel(linear, ((curve, STEPS) for curve in self.curves))


def _each_channel(
    values: FloatArray, tables: Iterable[tuple[FloatArray, FloatArray]]
) -> FloatArray:
    """Values through one table a channel, pairs of x (ascending) and y."""
    channels = zip(np.moveaxis(values, -1, 0), tables, strict=True)
    return np.stack([np.interp(one, x, y) for one, (x, y) in channels], axis=-1)


def read_profile(data: bytes) -> Profile:
    """The matrix profile in ``data``.

    Raises
    ------
    InputError
        When it is damaged, or of a kind other than RGB with matrix and curves.

    References
    ----------
    ICC.1:2022, sections 7.2, 9.2 and 10.
    """
    try:
        tags = _tags(data)
        _require_rgb(data, tags)
        curves = np.stack([_curve(tags[name]) for name in (b"rTRC", b"gTRC", b"bTRC")])
        colorants = [_xyz(tags[name]) for name in (b"rXYZ", b"gXYZ", b"bXYZ")]
        matrix = np.array(colorants) @ _from_d50()
    except (struct.error, ValueError, KeyError, IndexError) as error:
        msg = f"its colour profile is damaged ({error}): {WAY_OUT}"
        raise InputError(msg) from error
    if not (np.isfinite(curves).all() and np.abs(matrix.sum(axis=0) - 1.0).max() < 0.1):
        msg = f"its colour profile turns white into a colour: {WAY_OUT}"
        raise InputError(msg)
    return Profile(_name(tags), curves, matrix)


def _tags(data: bytes) -> dict[bytes, bytes]:
    if data[36:40] != b"acsp":
        msg = "no ICC profile"
        raise ValueError(msg)
    (count,) = struct.unpack_from(">I", data, HEADER_BYTES)
    tags = {}
    for index in range(min(count, MOST_TAGS)):
        name, offset, size = struct.unpack_from(">4sII", data, 132 + 12 * index)
        if offset + size > len(data):
            msg = f"cut off within {name.decode('latin-1')}"
            raise ValueError(msg)
        tags[name] = data[offset : offset + size]
    return tags


def _require_rgb(data: bytes, tags: dict[bytes, bytes]) -> None:
    space, connection = data[16:20].decode("latin-1").strip(), data[20:24]
    if space != "RGB":
        msg = f"its colour profile is of {space} colours, not of RGB: {WAY_OUT}"
        raise InputError(msg)
    if b"rXYZ" not in tags or connection != b"XYZ ":
        msg = f"its colour profile holds tables instead of a matrix: {WAY_OUT}"
        raise InputError(msg)


def _from_d50() -> FloatArray:
    """Matrix from XYZ under D50 (as a row, Y = 1) to linear sRGB."""
    white = np.linalg.solve(XYZ_TO_SRGB, np.ones(3))
    gain = (BRADFORD @ white) / (BRADFORD @ D50)
    adaptation = np.linalg.solve(BRADFORD, gain[:, np.newaxis] * BRADFORD)
    matrix: FloatArray = (XYZ_TO_SRGB @ adaptation).T
    return matrix


def _xyz(tag: bytes) -> FloatArray:
    return np.array(struct.unpack_from(">3i", tag, 8), dtype=np.float64) / 65536.0


def _curve(tag: bytes) -> FloatArray:
    """Linear values of a curve tag at even steps."""
    x = STEPS
    if tag[:4] == b"para":
        return _parametric(tag, x)
    if tag[:4] != b"curv":
        msg = f"curve of type {tag[:4]!r}"
        raise ValueError(msg)
    (count,) = struct.unpack_from(">I", tag, 8)
    if count == 0:
        return x
    table = np.frombuffer(tag, dtype=">u2", count=count, offset=12)
    if count == 1:
        powered: FloatArray = x ** (float(table[0]) / 256.0)
        return powered
    return np.interp(x, np.linspace(0.0, 1.0, count), table / 65535.0)


def _parametric(tag: bytes, x: FloatArray) -> FloatArray:
    """Values of Y = (a·X + b)^g + e above d, c·X + f below."""
    (kind,) = struct.unpack_from(">H", tag, 8)
    letters = _PARAMETERS[kind]
    numbers = struct.unpack_from(f">{len(letters)}i", tag, 12)
    given = dict(zip(letters, (one / 65536.0 for one in numbers), strict=True))
    g, a, b = given["g"], given.get("a", 1.0), given.get("b", 0.0)
    c, f = given.get("c", 0.0), given.get("f", 0.0)
    d, e = given.get("d", 0.0), given.get("e", 0.0)
    if kind in {1, 2}:
        d, e, f = -b / a, given.get("c", 0.0), given.get("c", 0.0)
        c = 0.0
    power = np.maximum(a * x + b, 0.0) ** g + e
    curve: FloatArray = np.where(x >= d, power, c * x + f)
    return curve


def _name(tags: dict[bytes, bytes]) -> str:
    """Description of the profile, of version 2 or 4."""
    tag = tags.get(b"desc", b"")
    if tag[:4] == b"desc":
        (length,) = struct.unpack_from(">I", tag, 8)
        return tag[12 : 12 + length].split(b"\0")[0].decode("latin-1")
    if tag[:4] == b"mluc":
        length, offset = struct.unpack_from(">II", tag, 20)
        return tag[offset : offset + length].decode("utf-16-be", "replace")
    return "without a name"
