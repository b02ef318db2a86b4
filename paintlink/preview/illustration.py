"""What is drawn for the impression only: nothing of it was measured."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import PreviewError
from paintlink.preview.arrays import Float32Array
from paintlink.preview.surface import Surface

PEEL_WAVES = 24
PEEL_STEEPEST = 0.05
PEEL_LENGTH = 0.035
GLINT_SHARE = 0.04


@dataclass(frozen=True)
class Illustration:
    """Layers a picture can have on top of what is known of the paint.

    Parameters
    ----------
    orange_peel
        Waviness of the clearcoat, 0 for none to 1.
    sparkle
        Brightness of single flakes, 0 for none to 1.
    graininess
        Cloudiness of the flakes, 0 for none to 1.
    """

    orange_peel: float = 0.0
    sparkle: float = 0.0
    graininess: float = 0.0

    def __post_init__(self) -> None:
        for name in ("orange_peel", "sparkle", "graininess"):
            value = getattr(self, name)
            if not 0.0 <= value <= 1.0:
                msg = f"{name} runs from 0 (none) to 1, not {value:g}"
                raise PreviewError(msg)

    def notes(self) -> Iterator[str]:
        """Words for each layer that is on."""
        for name in ("orange_peel", "sparkle", "graininess"):
            if getattr(self, name):
                yield f"{name.replace('_', ' ')} is an illustration, not measured"


PLAIN = Illustration()


def with_orange_peel(surface: Surface, layers: Illustration, columns: int) -> Surface:
    """The surface with the normals of a wavy coat."""
    if not layers.orange_peel:
        return surface
    place = np.repeat(_places(surface, columns), _samples(surface), axis=0)
    random = np.random.default_rng(1)
    normals = surface.normals.copy()
    for turn, phase in random.uniform(0.0, 2.0 * np.pi, (PEEL_WAVES, 2)):
        wave = 2.0 * np.pi / (PEEL_LENGTH * random.uniform(0.6, 1.8))
        along = np.array([np.cos(turn), np.sin(turn)])
        slope = np.cos(wave * (place @ along) + phase)
        steep = layers.orange_peel * PEEL_STEEPEST / np.sqrt(PEEL_WAVES)
        normals[:, :2] += np.outer(slope * steep, along)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return replace(surface, normals=normals)


def grain(surface: Surface, layers: Illustration, columns: int) -> Float32Array:
    """Factor of the light in each pixel, (n,); its mean is 1."""
    random = np.random.default_rng(2)
    rows = surface.behind.shape[0]
    gain = np.ones(rows * columns, dtype=np.float32)
    if layers.graininess:
        clouds = random.normal(size=(rows, columns))
        clouds = (clouds + np.roll(clouds, 1, 0) + np.roll(clouds, 1, 1)) / 1.7
        gain *= np.exp(0.25 * layers.graininess * clouds.ravel()).astype(np.float32)
    if layers.sparkle:
        glints = random.random(rows * columns) < GLINT_SHARE
        gain[glints] *= 1.0 + np.float32(4.0 * layers.sparkle)
    seen: Float32Array = gain[surface.pixels]
    seen /= np.float32(seen.mean() if len(seen) else 1.0)
    return seen


def _places(surface: Surface, columns: int) -> Float32Array:
    """Column and row of each pixel as shares of the width, shape (n, 2)."""
    row, column = np.divmod(surface.pixels, columns)
    return (np.stack([column, row], axis=1) / columns).astype(np.float32)


def _samples(surface: Surface) -> NDArray[np.intp]:
    samples: NDArray[np.intp] = np.diff(np.append(surface.first, len(surface.normals)))
    return samples
