"""Refractive indices n + ik of what flakes are made of, at `WAVELENGTHS_NM`.

Optical constants are measured facts from the literature, read from refractiveindex.info
(CC0): Devore 1951 for rutile, Malitson 1965 for silica, Rakić 1995 for aluminium,
Querry 1985 for haematite.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np
from numpy.typing import NDArray

from paintlink_simulators.paint.optics import COAT_INDEX
from paintlink_simulators.paint.wavelengths import WAVELENGTHS_NM

ComplexArray = NDArray[np.complex128]

COATING_DENSITY = 0.87
"""Share of n² − 1 that a precipitated TiO2 layer keeps: porous, partly anatase. An
assumption."""

ALUMINIUM_UM_N_K = (
    (0.36466, 0.399, 4.396),
    (0.41328, 0.521, 5.001),
    (0.44280, 0.608, 5.368),
    (0.47687, 0.728, 5.778),
    (0.51660, 0.873, 6.242),
    (0.56357, 1.073, 6.784),
    (0.61993, 1.366, 7.405),
    (0.65225, 1.572, 7.735),
    (0.68881, 1.830, 8.060),
    (0.72932, 2.161, 8.357),
)
HAEMATITE_UM_N_K = (
    (0.40, 2.756, 1.294),
    (0.42, 2.962, 1.231),
    (0.44, 3.126, 1.101),
    (0.46, 3.217, 0.943),
    (0.48, 3.264, 0.809),
    (0.50, 3.282, 0.675),
    (0.52, 3.262, 0.587),
    (0.54, 3.286, 0.538),
    (0.56, 3.348, 0.437),
    (0.58, 3.348, 0.274),
    (0.60, 3.265, 0.149),
    (0.62, 3.175, 0.089),
    (0.64, 3.102, 0.065),
    (0.66, 3.051, 0.051),
    (0.68, 3.008, 0.038),
    (0.70, 2.972, 0.031),
)
MICA_INDEX = 1.58
"""Muscovite, between its principal values 1.564 and 1.603."""


@cache
def refractive_index(material: str) -> ComplexArray:
    """Complex refractive index of a material, shape (31,).

    Known: ``binder``, ``titania`` (rutile as a coating), ``rutile``, ``mica``,
    ``silica``, ``aluminium``, ``haematite``.
    """
    index = _INDICES[material]()
    index.setflags(write=False)
    return index


def _constant(value: float) -> ComplexArray:
    return np.full(WAVELENGTHS_NM.size, value, dtype=np.complex128)


def _interpolated(table: tuple[tuple[float, float, float], ...]) -> ComplexArray:
    wavelength_um, n, k = np.array(table).T
    at = WAVELENGTHS_NM / 1000.0
    real, imaginary = np.interp(at, wavelength_um, n), np.interp(at, wavelength_um, k)
    index: ComplexArray = real + 1j * imaginary
    return index


def _rutile() -> ComplexArray:
    """Ordinary ray, Devore 1951; his formula begins at 430 nm and is carried on."""
    square = (WAVELENGTHS_NM / 1000.0) ** 2
    return np.sqrt(5.913 + 0.2441 / (square - 0.0803)).astype(np.complex128)


def _titania() -> ComplexArray:
    index: ComplexArray = np.sqrt(1.0 + COATING_DENSITY * (_rutile() ** 2 - 1.0))
    return index


def _silica() -> ComplexArray:
    """Fused silica, the three-term Sellmeier formula of Malitson 1965."""
    square = (WAVELENGTHS_NM / 1000.0) ** 2
    terms = (
        (0.6961663, 0.0684043),
        (0.4079426, 0.1162414),
        (0.8974794, 9.896161),
    )
    above = sum(strength * square / (square - pole**2) for strength, pole in terms)
    return np.sqrt(1.0 + above).astype(np.complex128)


_INDICES: Mapping[str, Callable[[], ComplexArray]] = {
    "binder": lambda: _constant(COAT_INDEX),
    "mica": lambda: _constant(MICA_INDEX),
    "rutile": _rutile,
    "titania": _titania,
    "silica": _silica,
    "aluminium": lambda: _interpolated(ALUMINIUM_UM_N_K),
    "haematite": lambda: _interpolated(HAEMATITE_UM_N_K),
}
