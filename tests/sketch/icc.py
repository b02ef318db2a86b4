"""Colour profiles made byte by byte, for the RGB spaces artists meet."""

from __future__ import annotations

import struct

import numpy as np

D65, D50 = (0.3127, 0.3290), (0.9642, 1.0, 0.8249)
BRADFORD = np.array([
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
])
SRGB_PRIMARIES = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
ADOBE_PRIMARIES = ((0.64, 0.33), (0.21, 0.71), (0.15, 0.06))
P3_PRIMARIES = ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060))


def gamma(value: float) -> bytes:
    """A curve that is one power."""
    return struct.pack(">4sIIH", b"curv", 0, 1, round(256 * value)) + b"\0\0"


def table(numbers: np.ndarray) -> bytes:
    """A curve of sampled values, 0 to 1."""
    codes = np.rint(65535.0 * numbers).astype(">u2").tobytes()
    return struct.pack(">4sII", b"curv", 0, len(numbers)) + codes


def parametric(kind: int, *numbers: float) -> bytes:
    """A parametric curve of a function type."""
    fixed = [round(65536 * one) for one in numbers]
    return struct.pack(f">4sIHH{len(fixed)}i", b"para", 0, kind, 0, *fixed)


SRGB_CURVE = parametric(3, 2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045)
ADOBE_CURVE = gamma(563 / 256)


def matrix_profile(
    primaries: tuple[tuple[float, float], ...],
    curve: bytes,
    *,
    name: str = "test",
    space: bytes = b"RGB ",
) -> bytes:
    """A display profile of version 4 under D65."""
    colorants = to_xyz_d50(primaries).T
    text = name.encode("utf-16-be")
    tags = {
        b"desc": struct.pack(">4sIII2s2sII", b"mluc", 0, 1, 12, b"en", b"US",
                             len(text), 28) + text,
        b"wtpt": _xyz(D50),
        b"rXYZ": _xyz(colorants[0]),
        b"gXYZ": _xyz(colorants[1]),
        b"bXYZ": _xyz(colorants[2]),
        b"rTRC": curve,
        b"gTRC": curve,
        b"bTRC": curve,
    }  # fmt: skip
    return _assembled(tags, space)


def to_xyz_d50(primaries: tuple[tuple[float, float], ...]) -> np.ndarray:
    """Matrix from linear values (as a column) to XYZ adapted to D50."""
    columns = np.array([[x / y, 1.0, (1 - x - y) / y] for x, y in primaries]).T
    white = np.array([D65[0] / D65[1], 1.0, (1 - sum(D65)) / D65[1]])
    matrix = columns * np.linalg.solve(columns, white)
    gain = (BRADFORD @ np.array(D50)) / (BRADFORD @ white)
    return np.linalg.solve(BRADFORD, gain[:, None] * BRADFORD) @ matrix


def _xyz(numbers: object) -> bytes:
    fixed = [round(65536 * float(one)) for one in numbers]
    return struct.pack(">4sI3i", b"XYZ ", 0, *fixed)


def _assembled(tags: dict[bytes, bytes], space: bytes) -> bytes:
    offset, places, bodies = 132 + 12 * len(tags), b"", b""
    for name, body in tags.items():
        padded = body + b"\0" * (-len(body) % 4)
        places += struct.pack(">4sII", name, offset + len(bodies), len(body))
        bodies += padded
    data = struct.pack(">I", len(tags)) + places + bodies
    header = struct.pack(
        ">I4sI4s4s4s12s4s4sIIIQI3i48s",
        128 + len(data), b"\0" * 4, 0x04300000, b"mntr", space, b"XYZ ",
        b"\x07\xe8\0\1\0\1" + b"\0" * 6, b"acsp", b"\0" * 4, 0, 0, 0, 0, 0,
        *(round(65536 * one) for one in D50), b"\0" * 48,
    )  # fmt: skip
    return header + data
