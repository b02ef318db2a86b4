"""Amounts of given toners that come nearest to a target."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink_simulators.colornet.target import Target
from paintlink_simulators.paint import TONERS

Columns = NDArray[np.int64]
"""Which toners, by their place in `TONERS`."""

STEP = 1e-4
TOTAL_WEIGHT = 3.0
"""How hard the fractions are held to a sum of 1; only their ratios matter."""

MOST_EVALUATIONS = 30
TRIED_SHARE = 0.005


def fitted(target: Target, parts: FloatArray, columns: Columns) -> FloatArray:
    """Parts with the amounts of some toners fitted, all others 0, sum 1.

    Bounded least squares from ``parts``; every amount stays between 0 and the whole.
    """
    from scipy.optimize import least_squares

    start = np.clip(parts[columns] / parts[columns].sum(), 1e-6, 1.0)
    found = least_squares(
        lambda x: _residual(target, x, columns),
        start,
        jac=cast("Any", lambda x: jacobian(target, x, columns)),
        bounds=(0.0, 1.0),
        method="trf",
        max_nfev=MOST_EVALUATIONS,
        ftol=1e-5,
        xtol=1e-5,
        gtol=1e-6,
    )
    return spread(found.x / found.x.sum(), columns)


def jacobian(target: Target, x: FloatArray, columns: Columns) -> FloatArray:
    """Derivative of the residual by each fraction, shape (3·m + 1, n).

    All one-sided steps go through the model at once.
    """
    tried = x + STEP * np.vstack([np.zeros(x.size), np.eye(x.size)])
    rows = np.array([spread(one, columns) for one in tried])
    misfit = target.misfit(target.predicted(rows))
    slopes = (misfit[1:] - misfit[0]).T / STEP
    return np.vstack([slopes, np.full(x.size, TOTAL_WEIGHT)])


def helpful(target: Target, parts: FloatArray, columns: Columns) -> FloatArray:
    """What a little of each toner would gain, shape (toners,); 0 where nothing.

    The gain is that part of the effect of 0.5 parts in 100 which the present toners
    cannot have themselves, set against what is left.
    """
    tried = parts + TRIED_SHARE * np.eye(len(TONERS))
    misfit = target.misfit(target.predicted(np.vstack([parts, tried])))
    effects = (misfit[1:] - misfit[0]).T
    basis, _ = np.linalg.qr(jacobian(target, parts[columns], columns)[:-1])
    own = effects - basis @ (basis.T @ effects)
    length = np.maximum((own * own).sum(axis=0), 1e-12)
    wanted = -(misfit[0] @ own)
    gain = np.where(wanted > 0.0, wanted**2 / length, 0.0)
    gain[columns] = 0.0
    return gain


def spread(x: FloatArray, columns: Columns) -> FloatArray:
    """Fractions of some toners among all, shape (toners,)."""
    parts = np.zeros(len(TONERS))
    parts[columns] = x
    return parts


def _residual(target: Target, x: FloatArray, columns: Columns) -> FloatArray:
    lab = target.predicted(spread(x, columns))[0]
    return np.append(target.misfit(lab), TOTAL_WEIGHT * (x.sum() - 1.0))
