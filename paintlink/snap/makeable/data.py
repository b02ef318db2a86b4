"""What the forecast knows: a cloud of makeable colours, and the learned weights."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from paintlink.errors import LibraryError
from paintlink.model import FloatArray
from paintlink.snap.makeable.features import Single

FOLDER = Path(__file__).parent / "data"
CLOUD, NETWORK, LABELS = "cloud.npy", "network.npz", "labels.npz"
STEP = 0.01
"""Of the coordinates in the cloud's file, which holds 16-bit integers."""


@dataclass(frozen=True, slots=True, eq=False)
class Knowledge:
    """Cloud and network.

    Parameters
    ----------
    cloud
        Colours of virtual paints as `features.place` gives them, shape (n, 9).
    squares
        Their squared lengths, shape (n,).
    mean, scale
        Of the features, shape (features,).
    inner, bias, outer, offset
        Networks of one tanh layer: shapes (networks, features, units),
        (networks, units), (networks, units) and (networks,).
    """

    cloud: Single
    squares: Single
    mean: FloatArray
    scale: FloatArray
    inner: FloatArray
    bias: FloatArray
    outer: FloatArray
    offset: FloatArray

    def log_odds(self, x: FloatArray) -> float:
        """Mean log-odds of the networks for the features of one colour."""
        hidden = np.tanh(((x - self.mean) / self.scale) @ self.inner + self.bias)
        return float(((hidden * self.outer).sum(axis=1) + self.offset).mean())


@cache
def knowledge() -> Knowledge:
    """What comes with paintlink, read once.

    Raises
    ------
    LibraryError
        When the files are missing or damaged.
    """
    try:
        cloud = cloud_of(np.load(FOLDER / CLOUD))
        with np.load(FOLDER / NETWORK) as network:
            weights = {name: network[name] for name in network.files}
        return Knowledge(cloud, (cloud * cloud).sum(axis=1), **weights)
    except (OSError, ValueError, KeyError, TypeError) as error:
        msg = f"the data of the forecast cannot be read ({error}): reinstall paintlink"
        raise LibraryError(msg) from error


def cloud_of(steps: FloatArray) -> Single:
    """The cloud from the integers of its file."""
    return np.multiply(steps, np.float32(STEP), dtype=np.float32)
