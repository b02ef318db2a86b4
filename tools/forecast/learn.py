"""A small network from features of a colour to the chance that it can be made."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from paintlink.model import FloatArray

UNITS = 24
NETWORKS = 3
DECAY = 1.0
STEPS = 400

Weights = tuple[FloatArray, FloatArray, FloatArray, float]


def learn(x: FloatArray, made: NDArray[np.bool_]) -> list[Weights]:
    """Networks of one tanh layer; the mean of their log-odds is the forecast.

    Parameters
    ----------
    x
        Standardised features, shape (n, features).
    made
        Whether each colour can be made.
    """
    return [_network(x, made.astype(float), seed) for seed in range(NETWORKS)]


def log_odds(networks: list[Weights], x: FloatArray) -> FloatArray:
    """Mean log-odds of the networks, shape (n,)."""
    each = [np.tanh(x @ w + b) @ v + c for w, b, v, c in networks]
    return np.mean(each, axis=0)


def _network(x: FloatArray, y: FloatArray, seed: int) -> Weights:
    count = x.shape[1]
    rng = np.random.default_rng(seed)
    start = rng.normal(0.0, 0.5, count * UNITS + 2 * UNITS + 1)

    def _loss(flat: FloatArray) -> tuple[float, FloatArray]:
        w, b, v, c = _unpacked(flat, count)
        hidden = np.tanh(x @ w + b)
        odds = hidden @ v + c
        loss = np.mean(np.logaddexp(0.0, odds) - y * odds)
        slope = (1.0 / (1.0 + np.exp(-odds)) - y) / len(y)
        back = np.outer(slope, v) * (1.0 - hidden * hidden)
        gradient = np.concatenate([
            (x.T @ back).ravel(),
            back.sum(axis=0),
            hidden.T @ slope,
            [slope.sum()],
        ])
        decay = DECAY / len(y)
        return loss + decay * (flat @ flat), gradient + 2.0 * decay * flat

    found = minimize(
        _loss, start, jac=True, method="L-BFGS-B", options={"maxiter": STEPS}
    )
    return _unpacked(found.x, count)


def _unpacked(flat: FloatArray, count: int) -> Weights:
    w = flat[: count * UNITS].reshape(count, UNITS)
    b, v = flat[count * UNITS : -1].reshape(2, UNITS)
    return w, b, v, float(flat[-1])


def area_under_curve(score: FloatArray, made: NDArray[np.bool_]) -> float:
    """Share of pairs of a makeable and another colour that the score orders rightly."""
    ranks = np.empty(len(score))
    ranks[np.argsort(score, kind="stable")] = np.arange(1, len(score) + 1)
    positive = int(made.sum())
    above = ranks[made].sum() - positive * (positive + 1) / 2.0
    return float(above / (positive * (len(made) - positive)))


def calibration_error(
    chance: FloatArray, made: NDArray[np.bool_], bins: int = 10
) -> float:
    """Mean distance of forecast from frequency over bins of equal width."""
    place = np.minimum((chance * bins).astype(int), bins - 1)
    apart = [
        abs(float(chance[place == one].mean() - made[place == one].mean()))
        * float(np.mean(place == one))
        for one in np.unique(place)
    ]
    return float(np.sum(apart))
