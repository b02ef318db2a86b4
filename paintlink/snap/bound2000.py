"""A provable lower bound of CIEDE2000 over boxes of colours.

Derived step by step in docs/snap.md. The target is colour 1, any point of the box
colour 2; kL = kC = kH = 1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from paintlink.snap.boxes import Box, Numbers, ab_gaps, neutral_corners

POW_25_7 = 25.0**7

T_MOST = 1.5725714342875683
"""Above the largest T of the hue weight, 1.5724717 at 234.4 degrees."""

MONOTONE_FROM_L = -9.65
MONOTONE_UP_TO = 122.4
"""|ΔL|/S_L grows with |ΔL| up to here, and everywhere if no lightness is below."""

CERTIFICATES = tuple(
    (
        float(np.sin(np.radians(60.0 * np.exp(-((apart / 25.0) ** 2))))),
        (np.cos(np.radians(5.0 + apart)), np.sin(np.radians(5.0 + apart))),
        (np.cos(np.radians(185.0 - apart)), np.sin(np.radians(185.0 - apart))),
    )
    for apart in (25.0, 40.0, 60.0)
)
"""Hues at least so far from 275 degrees: the rotation left, two half planes of hues."""

ROTATION_MOST = float(np.sin(np.radians(60.0)))
CLEAR = 1e-6


class _Chroma(NamedTuple):
    """Ranges of the adjusted chroma of both colours, and of 1 + G."""

    g_low: Numbers
    g_high: Numbers
    q_low: Numbers
    q_high: Numbers
    x_low: Numbers
    x_high: Numbers


def ciede2000_bound(q: Numbers, box: Box, angles_deg: Numbers) -> Numbers:
    """What no CIEDE2000 difference of the target from a point of the box is below."""
    x_L = _lightness(q[:, 0], box)
    ranges = _chroma(q, box)
    d_a, d_b = ab_gaps(q, box)
    d_a *= ranges.g_low
    D2 = d_a * d_a + d_b * d_b
    mean_most = 0.5 * (ranges.q_high + ranges.x_high)
    y2 = _chroma_and_hue(D2, ranges, mean_most)
    rotation = 2.0 * _rho(mean_most) * _rotation_left(q, box, ranges)
    bound: Numbers = np.sqrt(x_L * x_L + (1.0 - 0.5 * rotation) * y2)
    return bound


def _lightness(L: Numbers, box: Box) -> Numbers:
    """|ΔL|/S_L at the nearest edge, where it is least."""
    low, high = box.low[:, 0], box.high[:, 0]
    edge = np.minimum(np.maximum(L, low), high)
    d = np.abs(edge - L)
    weight = _lightness_weight(0.5 * (L + edge))
    if min(float(L.min()), float(low.min())) < MONOTONE_FROM_L:
        far = np.where(np.abs(low - L) > np.abs(high - L), low, high)
        beyond = np.abs(far - L) > MONOTONE_UP_TO
        most = np.maximum(weight, _lightness_weight(0.5 * (L + far)))
        weight = np.where(beyond, most, weight)
    return d / weight


def _lightness_weight(mean_L: Numbers) -> Numbers:
    t2 = (mean_L - 50.0) * (mean_L - 50.0)
    weight: Numbers = 1.0 + 0.015 * t2 / np.sqrt(20.0 + t2)
    return weight


def _chroma(q: Numbers, box: Box) -> _Chroma:
    n_a, n_b, f_a, f_b = neutral_corners(box)
    a2, b2 = q[:, 1] ** 2, q[:, 2] ** 2
    C = np.sqrt(a2 + b2)
    g_low = _g(0.5 * (C + np.sqrt(f_a * f_a + f_b * f_b)))
    g_high = _g(0.5 * (C + np.sqrt(n_a * n_a + n_b * n_b)))
    low2, high2 = g_low * g_low, g_high * g_high
    return _Chroma(
        g_low,
        g_high,
        np.sqrt(low2 * a2 + b2),
        np.sqrt(high2 * a2 + b2),
        np.sqrt(low2 * n_a * n_a + n_b * n_b),
        np.sqrt(high2 * f_a * f_a + f_b * f_b),
    )


def _chroma_and_hue(D2: Numbers, ranges: _Chroma, mean_most: Numbers) -> Numbers:
    """(ΔC'/S_C)² + (ΔH'/S_H)² at least, given ΔC'² + ΔH'² >= D²."""
    SC, SH = 1.0 + 0.045 * mean_most, 1.0 + 0.015 * T_MOST * mean_most
    inverse_SC2, inverse_SH2 = 1.0 / (SC * SC), 1.0 / (SH * SH)
    dC_most = np.maximum(ranges.x_high - ranges.q_low, ranges.q_high - ranges.x_low)
    dC_most = np.maximum(dC_most, 0.0)
    dH2 = np.maximum(D2 - dC_most * dC_most, 0.0)
    y2: Numbers = D2 * inverse_SC2 + dH2 * (inverse_SH2 - inverse_SC2)
    return y2


def _rotation_left(q: Numbers, box: Box, ranges: _Chroma) -> Numbers:
    """Sine of the largest rotation angle at any mean hue that can occur.

    Target and box in one half plane of hues that stay away from 275 degrees keep the
    mean hue away as well. Both normals of a pair point to positive b.
    """
    b, q_b = box.low[:, 2], q[:, 2]
    a_least = _scaled_low(box.low[:, 1], ranges)
    a_most = _scaled_high(box.high[:, 1], ranges)
    q_least, q_most = _scaled_low(q[:, 1], ranges), _scaled_high(q[:, 1], ranges)
    left = np.full(np.broadcast(a_least, b).shape, ROTATION_MOST)
    for rotation, (ux, uy), (vx, vy) in CERTIFICATES:
        right_side = np.minimum(ux * a_least + uy * b, ux * q_least + uy * q_b)
        left_side = np.minimum(vx * a_most + vy * b, vx * q_most + vy * q_b)
        left[np.maximum(right_side, left_side) > CLEAR] = rotation
    return left


def _scaled_low(a: Numbers, ranges: _Chroma) -> Numbers:
    return a * np.where(a > 0.0, ranges.g_low, ranges.g_high)


def _scaled_high(a: Numbers, ranges: _Chroma) -> Numbers:
    return a * np.where(a > 0.0, ranges.g_high, ranges.g_low)


def _g(mean_C: Numbers) -> Numbers:
    return 1.5 - 0.5 * _rho(mean_C)


def _rho(C: Numbers) -> Numbers:
    c2 = C * C
    c7 = c2 * c2 * c2 * C
    return np.sqrt(c7 / (c7 + POW_25_7))
