"""Pictures as OpenEXR files: linear light, nothing brought into a screen's gamut."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from paintlink import __version__
from paintlink.errors import PreviewError
from paintlink.preview.picture import WARNING, Picture
from paintlink.spec import spec_id

REC709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
"""Primaries and white of sRGB: x and y of red, green, blue and white."""


def to_exr(picture: Picture) -> bytes:
    """The picture's linear light as half floats, 1.0 being the perfect diffuser.

    Raises
    ------
    PreviewError
        When the picture does not keep its linear light, or OpenEXR is not installed.
    """
    light = picture.required_linear()
    try:
        import OpenEXR
    except ImportError as error:
        msg = "to write OpenEXR, install paintlink with its extra: [exr]"
        raise PreviewError(msg) from error
    header = {
        "compression": OpenEXR.ZIP_COMPRESSION,
        "type": OpenEXR.scanlineimage,
        "chromaticities": REC709,
        "software": f"paintlink {__version__}",
        "comments": "; ".join([*picture.notes, WARNING]),
        "paints": " | ".join(f"{spec_id(s)} {s.name}" for s in picture.specs),
        "scene": picture.setting,
    }
    channels = {"RGB": OpenEXR.Channel("RGB", light.astype(np.float16))}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "picture.exr"
        with OpenEXR.File(header, channels) as file:
            file.write(str(path))
        return path.read_bytes()
