"""Painted pictures in files: opened with care, read at full depth, brought to sRGB."""

from __future__ import annotations

import io
import sys
import warnings
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from paintlink.errors import InputError
from paintlink.preview.arrays import Float32Array
from paintlink.sketch.geometry import bands
from paintlink.sketch.png import Codes, to_values
from paintlink.sketch.profiles import Profile, read_profile
from paintlink.sketch.storage import Compressed, Rounded, Storage
from paintlink.sketch.values import Painting

if TYPE_CHECKING:
    from PIL.ImageFile import ImageFile

FORMATS = ("PNG", "TIFF", "JPEG")
MOST_PIXELS = 40_000_000
MOST_BYTES = 1 << 29
PNG_END = b"IEND\xaeB\x60\x82"
USUAL_GAMMA = 1.0 / 2.2
UPRIGHT = 1
UNUSUAL = -1
"""Pillow's number for a subsampling it cannot write."""

ORIENTATION = 0x0112

EXPORT = "export the flattened picture as PNG, TIFF or JPEG in RGB"
REFUSED_MODES = {
    "CMYK": "it is in CMYK",
    "LAB": "it is in Lab",
    "YCbCr": "it is in YCbCr",
    "1": "it has one black and white channel",
    "L": "it has one grey channel",
    "LA": "it has one grey channel",
    "I;16": "it has one grey channel",
    "I": "it has one grey channel",
    "F": "it has one grey channel",
}
LOSSY_NOTE = "compressed with loss (JPEG): save as PNG to keep more"
PALETTE_NOTE = "at most 256 colours (palette): save as RGB to keep more"

_OTHER_HALF = {"L": "B", "B": "L", "N": "B" if sys.byteorder == "little" else "L"}

Opened = Callable[[], AbstractContextManager["ImageFile"]]


def read_picture(path: Path) -> Painting:
    """The picture in a PNG, TIFF or JPEG file, as encoded sRGB.

    Sixteen bits a channel are read in full; an embedded profile is applied.

    Raises
    ------
    InputError
        When it cannot be read or is not one flat RGB picture, naming the file, the
        reason and the way out.
    """
    from PIL import Image, UnidentifiedImageError

    data = _content(path)

    def opened() -> AbstractContextManager[ImageFile]:
        return Image.open(io.BytesIO(data), formats=FORMATS)

    try:
        with warnings.catch_warnings():
            # Odd metadata, as editors write it; samples that are missing raise anyway.
            warnings.simplefilter("ignore", UserWarning)
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            return _read(opened, data)
    except InputError as error:
        msg = f"{path}: {error}"
        raise InputError(msg) from error
    except UnidentifiedImageError as error:
        msg = f"{path}: not a picture this program reads: {EXPORT}"
        raise InputError(msg) from error
    except (Image.DecompressionBombError, Image.DecompressionBombWarning) as error:
        msg = f"{path}: more than {MOST_PIXELS} pixels: save it smaller"
        raise InputError(msg) from error
    except (OSError, SyntaxError, ValueError, EOFError, IndexError) as error:
        msg = f"{path}: damaged or cut off ({error}): {EXPORT} again"
        raise InputError(msg) from error


def _content(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            data = file.read(MOST_BYTES + 1)
    except OSError as error:
        msg = f"{path}: cannot be read ({error.strerror}): name the painted picture"
        raise InputError(msg) from error
    if len(data) > MOST_BYTES:
        msg = f"{path}: larger than {MOST_BYTES >> 20} MiB: {EXPORT}"
        raise InputError(msg)
    return data


def _read(opened: Opened, data: bytes) -> Painting:
    with opened() as image:
        _require_usable(image, data)
        profile = _profile(image)
        lossy, palette = image.format == "JPEG", image.mode == "P"
        storage = _storage(image, profile)
        codes = _codes(image, opened)
        _require_unmarked(image)
    notes = [LOSSY_NOTE] * lossy + [PALETTE_NOTE] * palette
    values = to_values(codes)
    alpha = values[..., 3].copy() if values.shape[2] == 4 else None
    encoded = np.ascontiguousarray(values[..., :3])
    if profile is not None:
        notes.append(_converted(encoded, profile))
    bits = 8 * codes.dtype.itemsize
    kept = storage if bits == 8 else None
    return Painting(encoded, alpha, bits, tuple(notes), lossy, kept)


def _require_usable(image: ImageFile, data: bytes) -> None:
    """Refuse by the header alone what is too large, layered or not RGB."""
    width, height = image.size
    if width * height > MOST_PIXELS:
        msg = (
            f"{width} x {height} pixels, more than {MOST_PIXELS}: save it at the size "
            "of the start picture"
        )
        raise InputError(msg)
    if image.mode in REFUSED_MODES:
        msg = f"{REFUSED_MODES[image.mode]}: {EXPORT}"
        raise InputError(msg)
    if getattr(image, "n_frames", 1) > 1:
        msg = f"it has several layers or pages: {EXPORT}"
        raise InputError(msg)
    if image.format == "PNG" and PNG_END not in data[-4096:]:
        msg = f"the end of the file is missing: {EXPORT} again"
        raise InputError(msg)


def _require_unmarked(image: ImageFile) -> None:
    """Refuse a mark that lets some programs turn the picture; Pillow has to load it."""
    if image.getexif().get(ORIENTATION, UPRIGHT) != UPRIGHT:
        msg = f"it is marked as turned or mirrored: {EXPORT}, upright"
        raise InputError(msg)


def _profile(image: ImageFile) -> Profile | None:
    """Profile to convert from; None for sRGB, said or assumed."""
    embedded = image.info.get("icc_profile")
    if embedded:
        return read_profile(embedded)
    gamma = image.info.get("gamma", USUAL_GAMMA)
    if "srgb" not in image.info and abs(gamma - USUAL_GAMMA) > 0.01:
        msg = f"its samples are marked with gamma {gamma:g}: save it as sRGB"
        raise InputError(msg)
    return None


def _storage(image: ImageFile, profile: Profile | None) -> Storage | None:
    """How eight bits a channel were kept; None where that cannot be done again."""
    if image.mode == "P":
        return None
    if image.format != "JPEG":
        return Rounded(profile)
    from PIL.JpegImagePlugin import JpegImageFile, get_sampling

    if not isinstance(image, JpegImageFile):
        return None
    subsampling = get_sampling(image)
    if subsampling == UNUSUAL:
        return None
    return Compressed(image.quantization, subsampling, profile)


def _codes(image: ImageFile, opened: Opened) -> Codes:
    """Samples of red, green, blue and perhaps opacity."""
    if image.mode == "P":
        opaque = "transparency" not in image.info
        return np.asarray(image.convert("RGB" if opaque else "RGBA"))
    if image.mode not in {"RGB", "RGBA"}:
        msg = f"it is in mode {image.mode}: {EXPORT}"
        raise InputError(msg)
    half = _other_half(image)
    high = np.asarray(image)
    if half is None:
        return high
    with opened() as again:
        again.tile = [
            tile._replace(args=_with_rawmode(tile.args, half)) for tile in again.tile
        ]
        low = np.asarray(again)
    codes: Codes = high.astype(np.uint16) << 8 | low
    return codes


def _other_half(image: ImageFile) -> str | None:
    """Raw mode under which Pillow keeps the low bytes; None for 8 bits a channel.

    Pillow keeps the high byte of 16 bits without a word. Told that the samples are in
    the other byte order, it keeps the low one.
    """
    rawmodes = {_rawmode(tile.args) for tile in image.tile}
    deep = [rawmode for rawmode in rawmodes if ";16" in rawmode]
    if not deep:
        return None
    if len(rawmodes) > 1:
        msg = f"its channels are stored apart (planar): {EXPORT}, interleaved"
        raise InputError(msg)
    return deep[0][:-1] + _OTHER_HALF[deep[0][-1]]


def _rawmode(args: object) -> str:
    first = args[0] if isinstance(args, tuple) else args
    return str(first)


def _with_rawmode(args: Any, rawmode: str) -> Any:
    return (rawmode, *args[1:]) if isinstance(args, tuple) else rawmode


def _converted(encoded: Float32Array, profile: Profile) -> str:
    """What was done to ``encoded``, which is changed in place to sRGB."""
    outside = 0
    for rows in bands(len(encoded)):
        values = profile.convert(encoded[rows].astype(np.float64))
        outside += int(np.count_nonzero(((values < -0.01) | (values > 1.01)).any(-1)))
        encoded[rows] = np.clip(values, 0.0, 1.0)
    lost = f"; {outside} pixels are beyond sRGB and were clipped" if outside else ""
    return f"converted from its profile {profile.name!r} to sRGB{lost}"
