"""Reflection and transmission of a stack of thin films in binder."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from paintlink.model import FloatArray
from paintlink_simulators.paint.materials import ComplexArray, refractive_index
from paintlink_simulators.paint.wavelengths import WAVELENGTHS_NM


class Film(NamedTuple):
    """One layer; several thicknesses make flakes of which each has another one."""

    material: str
    thicknesses_nm: tuple[float, ...]


class Response(NamedTuple):
    """Reflectance and transmittance, shape (g, 31) each."""

    reflectance: FloatArray
    transmittance: FloatArray


def response(films: Sequence[Film], incidence_rad: ArrayLike) -> Response:
    """What a flake in binder reflects and lets through, unpolarised.

    Intensities are averaged over the thicknesses, which must be one or equally many in
    every film: flakes of a powder differ, a single thickness gives fringes that no
    powder shows.

    Parameters
    ----------
    incidence_rad
        Angle of incidence in the binder, shape (g,).

    References
    ----------
    Characteristic matrix of each film, Born and Wolf, "Principles of Optics", section
    1.6; absorption as n + ik.
    """
    incidence = np.atleast_1d(np.asarray(incidence_rad, dtype=np.float64))
    along = np.sin(incidence)[:, np.newaxis] * refractive_index("binder")
    waves = [_polarised(films, along, parallel) for parallel in (False, True)]
    reflected, passed = (sum(part) / 2.0 for part in zip(*waves, strict=True))
    return Response(reflected.mean(axis=-1), passed.mean(axis=-1))


def _polarised(
    films: Sequence[Film], along: ComplexArray, parallel: bool
) -> tuple[FloatArray, FloatArray]:
    """Reflectance and transmittance of one polarisation, shape (g, 31, thicknesses).

    ``along`` is the part of the wave vector along the films, which Snell's law keeps.
    """
    outside, _ = _admittance("binder", along, parallel)
    first, second = outside * 0.0 + 1.0, outside
    for film in reversed(films):
        admittance, normal = _admittance(film.material, along, parallel)
        phase = 2.0 * np.pi * normal / WAVELENGTHS_NM[:, np.newaxis]
        phase = phase * np.array(film.thicknesses_nm)
        cosine, sine = np.cos(phase), -1j * np.sin(phase)
        first, second = (
            cosine * first + sine / admittance * second,
            admittance * sine * first + cosine * second,
        )
    total = outside * first + second
    reflected = np.abs((outside * first - second) / total) ** 2
    return reflected, np.abs(2.0 * outside / total) ** 2


def _admittance(
    material: str, along: ComplexArray, parallel: bool
) -> tuple[ComplexArray, ComplexArray]:
    """Optical admittance and n cos θ, shape (g, 31, 1) each."""
    index = refractive_index(material)
    normal = np.sqrt(index**2 - along**2)
    admittance = index**2 / normal if parallel else normal
    return admittance[..., np.newaxis], normal[..., np.newaxis]
