"""From colour specifications to a picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import get_args

import numpy as np

from paintlink.errors import PreviewError
from paintlink.model import ColorSpec
from paintlink.preview import backends
from paintlink.preview.arrays import Float32Array
from paintlink.preview.basis import coefficients
from paintlink.preview.environment import load
from paintlink.preview.forms import form
from paintlink.preview.gloss import assumption, roughness_of
from paintlink.preview.illustration import PLAIN, Illustration
from paintlink.preview.layout import MOST, Layout, Pattern
from paintlink.preview.names import require
from paintlink.preview.picture import Backend, Picture
from paintlink.preview.scene import Scene

SIZES = range(16, 4097)


def render(
    specs: Sequence[ColorSpec],
    *,
    object: str = "panel",
    light: str = "studio",
    size: int = 512,
    backend: Backend = "auto",
    cache_dir: Path | None = None,
    pattern: Pattern = "columns",
    turn_deg: float = 0.0,
    perspective: bool = False,
    illustration: Illustration = PLAIN,
    linear: bool = False,
) -> Picture:
    """Picture of one paint, or of two to four that share the object.

    The exposure is fixed, so pictures of the same object in the same light compare.
    The first picture of a light takes about a second longer; ``cache_dir`` keeps what
    was baked for later processes.

    Parameters
    ----------
    size
        Width and height in pixels, 16 to 4096.
    backend
        ``auto`` draws with OpenGL where hardware does it, else with numpy; the two
        agree within one step of 255.
    pattern
        How several paints share the object.
    turn_deg, perspective
        See `camera.Camera`; only meshes can be turned.
    linear
        Whether to keep the light for 16-bit and OpenEXR files; numpy computes it.

    Raises
    ------
    PreviewError
        When object, light, size, backend or number of paints cannot be had, or when
        ``backend`` is ``gl`` and OpenGL fails.
    """
    _require_drawable(specs, size)
    require(backend, get_args(Backend), "backend")
    require(pattern, get_args(Pattern), "pattern")
    shown = form(object, turn_deg=turn_deg, perspective=perspective)
    coats = [roughness_of(spec.gloss) for spec in specs]
    kinds = tuple(sorted(set(coats)))
    scene = Scene(
        shown,
        load(light),
        size,
        kinds,
        cache_dir,
        Layout(pattern, len(specs)),
        illustration,
    )
    inks = _inks(specs, coats, kinds)
    drawn = backends.draw(scene, inks, backend)
    assumptions = dict.fromkeys(assumption(spec.gloss) for spec in specs)
    return Picture(
        drawn.rgb,
        drawn.backend,
        drawn.reason,
        object=shown.name,
        light=scene.light.name,
        setting=f"{shown.label}, light: {scene.light.label}".lower(),
        specs=tuple(specs),
        flags=tuple(drawn.flags.tolist()),
        linear=backends.linear(scene, inks) if linear else None,
        notes=(*filter(None, assumptions), *illustration.notes()),
    )


def _inks(
    specs: Sequence[ColorSpec], coats: Sequence[float], kinds: Sequence[float]
) -> Float32Array:
    """Coefficients of each paint, then 1 for the kind of coat it has."""
    has = np.equal.outer(coats, kinds)
    white = np.repeat(has[..., np.newaxis], 3, axis=2)
    return np.concatenate([coefficients(specs), white], axis=1).astype(np.float32)


def _require_drawable(specs: Sequence[ColorSpec], size: int) -> None:
    if not 1 <= len(specs) <= MOST:
        msg = f"a picture shows 1 to {MOST} paints, not {len(specs)}"
        raise PreviewError(msg)
    if size not in SIZES:
        msg = f"a picture is {SIZES[0]} to {SIZES[-1]} pixels wide, not {size}"
        raise PreviewError(msg)
