"""The slow way to the same pictures: quadrature over every direction of the light.

Shares no code with the renderer but the curve of the paint. Lights, curve and reference
values are those of the renderer's fact sheet, sections 3, 4 and 21.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from paintlink.color import ciede2000, drawing_curve, xyz_to_lab
from paintlink.model import ColorSpec, FloatArray, Lab, Sample

ROWS, COLUMNS = 256, 512
WHITE = np.array([0.94811, 1.0, 1.07304])
XYZ_FROM_RGB = np.array([
    [0.41258899, 0.357428476, 0.178092523],
    [0.21277473, 0.715756281, 0.071469003],
    [0.019024037, 0.117960478, 0.93605549],
])
STEP_DEG = 0.05
BIN_DEG = np.arange(3601) * STEP_DEG

Light = Callable[[FloatArray], FloatArray]


def paint(*labs: Sequence[float], angles: Sequence[float] = (15, 45, 110)) -> ColorSpec:
    samples = zip(angles, labs, strict=True)
    return ColorSpec("test", tuple(Sample(a, Lab(*lab)) for a, lab in samples))


RED = paint(*[(43, 56, 35)] * 3)
SILVER = paint((105, -3, -12), (55, -2, -14), (26, -1, -12))
PEARL = paint((95, -30, 48), (60, 10, 20), (30, 42, -38))
GREY = paint(*[(60, 0, 0)] * 3)


def effect_paints(count: int, seed: int) -> list[ColorSpec]:
    """Synthetic metallics and pearls by the recipe of the fact sheet, section 5.3."""
    random = np.random.default_rng(seed)
    drawn = (_effect_paint(random) for _ in iter(int, 1))
    found: Iterator[ColorSpec] = (spec for spec in drawn if spec is not None)
    return [next(found) for _ in range(count)]


def _effect_paint(random: np.random.Generator) -> ColorSpec | None:
    middle, hue = random.uniform(8, 85), random.uniform(0, 2 * np.pi)
    chroma = min(random.gamma(2, 14), 75) * min(1, middle / 45 + 0.15)
    flop_index = min(random.gamma(4, 2.85), 28)
    flop = middle * random.uniform(0.35, 0.85)
    face = flop + (flop_index * middle**0.86 / 2.69) ** (1 / 1.11)
    travel = random.normal(0, 0.12 if random.random() < 0.7 else 0.9)
    if not middle <= face <= 165:
        return None
    return paint(
        _polar(face, chroma * random.uniform(0.7, 1.7), hue - travel),
        _polar(middle, chroma, hue),
        _polar(flop, chroma * random.uniform(0.4, 1.3), hue + travel),
    )


def _polar(lightness: float, chroma: float, hue: float) -> tuple[float, float, float]:
    return lightness, chroma * np.cos(hue), chroma * np.sin(hue)


def as_five_angles(spec: ColorSpec, seed: int) -> ColorSpec:
    """The same paint as a five-angle instrument sees it, off the smooth curve."""
    random = np.random.default_rng(seed)
    angles = (15.0, 25.0, 45.0, 75.0, 110.0)
    lab = drawing_curve(spec.angles_deg, spec.lab())(angles)
    lab[[1, 3]] += random.normal(0, 1.2, (2, 3))
    return paint(*lab, angles=angles)


def sheet_curve(spec: ColorSpec) -> FloatArray:
    """Lab at ``BIN_DEG`` by section 3 of the fact sheet, extrapolated to 0."""
    theta = np.minimum(BIN_DEG, 110.0)
    lab = np.stack([_sheet_channel(theta, y) for y in spec.lab().T], axis=1)
    lab[:, 0] = np.maximum(lab[:, 0], 0.0)
    return lab


def _sheet_channel(theta: FloatArray, y: FloatArray) -> FloatArray:
    face, middle = y[0] - y[2], y[1] - y[2]
    if face * middle > 0 and abs(face) > abs(middle):
        r = np.sqrt(face / middle)
        vertex = (45 * r - 15) / (r - 1)
        if vertex <= 110:
            return y[2] + face / (vertex - 15) ** 2 * np.maximum(vertex - theta, 0) ** 2
    return np.polyval(np.polyfit([15, 45, 110], y, 2), theta)


def rgb_from_lab(lab: FloatArray) -> FloatArray:
    """Linear sRGB of Lab D65/10 with the matrices of section 11.1."""
    fy = (lab[..., 0] + 16) / 116
    f = np.stack([fy + lab[..., 1] / 500, fy, fy - lab[..., 2] / 200], axis=-1)
    xyz = np.where(f > 6 / 29, f**3, 3 * (6 / 29) ** 2 * (f - 4 / 29)) * WHITE
    return np.maximum(xyz, 0) @ np.linalg.inv(XYZ_FROM_RGB).T


def difference(first: FloatArray, second: FloatArray) -> FloatArray:
    """CIEDE2000 between linear sRGB colours."""
    return ciede2000(
        xyz_to_lab(first @ XYZ_FROM_RGB.T, WHITE),
        xyz_to_lab(second @ XYZ_FROM_RGB.T, WHITE),
    )


def grid() -> tuple[FloatArray, FloatArray]:
    """Directions of the light, (n, 3), and solid angles, (n,)."""
    j, i = np.meshgrid(np.arange(ROWS), np.arange(COLUMNS), indexing="ij")
    polar, azimuth = (j + 0.5) * np.pi / ROWS, 2 * np.pi * (i + 0.5) / COLUMNS
    directions = np.stack(
        [
            np.sin(polar) * np.sin(azimuth),
            np.cos(polar),
            -np.sin(polar) * np.cos(azimuth),
        ],
        axis=-1,
    )
    edges = np.cos(j * np.pi / ROWS) - np.cos((j + 1) * np.pi / ROWS)
    return directions.reshape(-1, 3), (edges * 2 * np.pi / COLUMNS).ravel()


def normalisation(light: Light) -> float:
    """Luminance of a perfect diffuser that leans back 45 degrees, N of section 4."""
    directions, solid_angle = grid()
    luminance = light(directions) @ [0.2126, 0.7152, 0.0722]
    facing = np.maximum(directions @ [0, np.sqrt(0.5), np.sqrt(0.5)], 0)
    return float(np.sum(luminance * solid_angle * facing) / np.pi)


def arriving(light: Light, normals: FloatArray) -> FloatArray:
    """Light by aspecular angle: (normals, angles of ``BIN_DEG``, 3), exposed."""
    directions, solid_angle = grid()
    flux = light(directions) * (solid_angle / normalisation(light))[:, None]
    return np.stack([_sorted_light(normal, directions, flux) for normal in normals])


def _sorted_light(
    normal: FloatArray, directions: FloatArray, flux: FloatArray
) -> FloatArray:
    mirror = 2 * normal[2] * normal - [0, 0, 1]
    theta = np.degrees(np.arccos(np.clip(directions @ mirror, -1, 1)))
    bins = np.rint(theta / STEP_DEG).astype(int)
    received = flux * np.maximum(directions @ normal, 0)[:, None]
    return np.stack(
        [np.bincount(bins, part, len(BIN_DEG)) for part in received.T], axis=1
    )


def seen(light_by_angle: FloatArray, factors: FloatArray) -> FloatArray:
    """Linear sRGB of each normal for reflectance factors at ``BIN_DEG``, (n, 3)."""
    return np.einsum("nbc,bc->nc", light_by_angle, factors) / np.pi


def arriving_beyond(light: Light, normals: FloatArray) -> FloatArray:
    """Light that the reading at -15 speaks for, (normals, 3), exposed.

    It comes from beyond the mirror direction as seen from the normal, where its share
    goes from 0 across over 1/2 aside to 1, and between 0 and 45 degrees, 1 at 15.
    """
    directions, solid_angle = grid()
    flux = light(directions) * (solid_angle / normalisation(light))[:, None]
    return np.stack([_beyond(normal, directions, flux) for normal in normals])


def _beyond(normal: FloatArray, directions: FloatArray, flux: FloatArray) -> FloatArray:
    mirror = 2 * normal[2] * normal - [0, 0, 1]
    cosine = np.clip(directions @ mirror, -1, 1)
    theta = np.degrees(np.arccos(cosine))
    aside = directions - cosine[:, None] * mirror
    inward = normal - normal @ mirror * mirror
    length = np.linalg.norm(aside, axis=1) * np.linalg.norm(inward)
    turn = aside @ inward / np.maximum(length, 1e-9)
    rise, fall = np.clip(theta / 15, 0, 1), np.clip((45 - theta) / 30, 0, 1)
    known = rise**2 * (3 - 2 * rise) * fall**2 * (3 - 2 * fall)
    share = known * (1 - turn) / 2 * np.maximum(directions @ normal, 0)
    return share @ flux


def visible_normals(count: int, seed: int) -> FloatArray:
    normals = np.random.default_rng(seed).normal(size=(count, 3))
    normals[:, 2] = np.abs(normals[:, 2])
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def sheet_studio(directions: FloatArray) -> FloatArray:
    """The neutral test light of section 4."""
    level = 0.22 + 0.25 * _sigma(directions[:, 1], 0.25)
    level = level + 7 * _box(directions, (0.55, 0.75, 0.6), (0, 1, 0), (0.45, 0.3))
    level = level + 4 * _box(directions, (-0.9, 0.35, 0.35), (0, 1, 0), (0.18, 0.9))
    level = level + 9 * _box(directions, (0, 1, -0.25), (0, 0, 1), (0.9, 0.10))
    return np.repeat(level[:, None], 3, axis=1)


def _sigma(x: FloatArray, edge: float) -> FloatArray:
    return 1 / (1 + np.exp(-np.clip(x / edge, -60, 60)))


def _box(
    directions: FloatArray,
    centre: Sequence[float],
    up: Sequence[float],
    half: tuple[float, float],
) -> FloatArray:
    c = np.array(centre) / np.linalg.norm(centre)
    x = np.cross(up, c) / np.linalg.norm(np.cross(up, c))
    y = np.cross(c, x)
    z = np.maximum(directions @ c, 0.001)
    across = _sigma(half[0] - np.abs(directions @ x / z), 0.015)
    upward = _sigma(half[1] - np.abs(directions @ y / z), 0.015)
    return np.where(directions @ c > 0.001, across * upward, 0)


def coat_seen(light: Light, normals: FloatArray, roughness: float) -> FloatArray:
    """Light the clearcoat reflects, full GGX quadrature of section 9, (n, 3)."""
    exposure = 1 / normalisation(light)
    half_vectors = _ggx(roughness, 160)
    return np.stack([
        _coat_pixel(light, normal, half_vectors, roughness) * exposure
        for normal in normals
    ])


def _ggx(roughness: float, steps: int) -> FloatArray:
    u, v = np.meshgrid(
        (np.arange(steps) + 0.5) / steps, (np.arange(steps) + 0.5) / steps
    )
    z = np.sqrt((1 - u) / (1 + (roughness**2 - 1) * u))
    sine, azimuth = np.sqrt(1 - z**2), 2 * np.pi * v
    parts = [sine * np.cos(azimuth), sine * np.sin(azimuth), z]
    return np.stack(parts, axis=-1).reshape(-1, 3)


def _coat_pixel(
    light: Light, normal: FloatArray, half_vectors: FloatArray, roughness: float
) -> FloatArray:
    right = np.cross([0.3, 0.9, 0.1], normal)
    right /= np.linalg.norm(right)
    h = half_vectors @ np.stack([right, np.cross(normal, right), normal])
    view_h, light_dir = h[:, 2], 2 * h[:, 2:] * h - [0, 0, 1]
    view_n, light_n, h_n = normal[2], light_dir @ normal, h @ normal
    used = (view_h > 0) & (light_n > 0)
    masking = 1 + _smith(view_n, roughness) + _smith(light_n[used], roughness)
    weight = _fresnel(view_h[used]) * view_h[used] / (view_n * h_n[used] * masking)
    return (light(light_dir[used]) * weight[:, None]).sum(axis=0) / len(h)


def _smith(cosine: FloatArray, roughness: float) -> FloatArray:
    tangent2 = 1 / cosine**2 - 1
    return 0.5 * (np.sqrt(1 + roughness**2 * tangent2) - 1)


def _fresnel(cosine: FloatArray, index: float = 1.5) -> FloatArray:
    inside = np.sqrt(1 - (1 - cosine**2) / index**2)
    s = (cosine - index * inside) / (cosine + index * inside)
    p = (inside - index * cosine) / (inside + index * cosine)
    return (s**2 + p**2) / 2
