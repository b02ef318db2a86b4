"""Pigment toners: spectral absorption K and scattering S of one part by weight.

Invented, in the manner of common pigment classes; no maker's spectra are in it. The
unit: white W10 scatters 1 at 550 nm.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from paintlink.model import FloatArray
from paintlink_simulators.paint.wavelengths import WAVELENGTHS_NM

REFERENCE_NM = 550.0
LEAST_ABSORPTION = 1e-5
"""No pigment is perfectly clear; keeps K/S away from 0/0."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pigment:
    """A toner without flakes.

    Parameters
    ----------
    edges
        Height, place and width in nm of absorption that ends towards the red:
        h / (1 + exp((λ − e)/s)).
    bands
        Height, place and width in nm of absorption bands: h exp(−((λ − c)/w)²/2).
    floor, slope
        Even absorption, and its change per nm from 400 nm on.
    scattering, decay
        S at 550 nm, and the power of 550/λ by which it grows towards the blue.
    """

    code: str
    name: str
    edges: tuple[tuple[float, float, float], ...] = ()
    bands: tuple[tuple[float, float, float], ...] = ()
    floor: float = 0.0
    slope: float = 0.0
    scattering: float
    decay: float = 1.0

    def absorption(self) -> FloatArray:
        """K of one part, shape (31,)."""
        k: FloatArray = self.floor + self.slope * (WAVELENGTHS_NM - WAVELENGTHS_NM[0])
        for height, place, width in self.edges:
            k = k + height / (1.0 + np.exp((WAVELENGTHS_NM - place) / width))
        for height, place, width in self.bands:
            k = k + height * np.exp(-0.5 * ((WAVELENGTHS_NM - place) / width) ** 2)
        return np.maximum(k, LEAST_ABSORPTION)

    def scatter(self) -> FloatArray:
        """S of one part, shape (31,)."""
        s: FloatArray = self.scattering * (REFERENCE_NM / WAVELENGTHS_NM) ** self.decay
        return s


PIGMENTS = (
    Pigment(
        code="W10",
        name="white rutile",
        edges=((0.2, 400, 6),),
        floor=0.001,
        scattering=1.0,
        decay=0.25,
    ),
    Pigment(
        code="W11",
        name="white tinting strength 1/5",
        edges=((0.04, 400, 6),),
        floor=0.0002,
        scattering=0.2,
        decay=0.25,
    ),
    Pigment(
        code="W12",
        name="white micro TiO2 (frost)",
        edges=((0.3, 410, 10),),
        floor=0.002,
        scattering=0.1,
        decay=4,
    ),
    Pigment(
        code="N20",
        name="jet black",
        floor=4.2,
        scattering=0.03,
    ),
    Pigment(
        code="N21",
        name="blue-tone black",
        floor=2.4,
        slope=0.0009,
        scattering=0.05,
    ),
    Pigment(
        code="N22",
        name="brown-tone black",
        floor=2.8,
        slope=-0.0022,
        scattering=0.05,
    ),
    Pigment(
        code="Y30",
        name="green yellow opaque",
        edges=((2.2, 488, 8),),
        floor=0.002,
        scattering=0.55,
        decay=0.3,
    ),
    Pigment(
        code="Y31",
        name="lemon yellow transparent",
        edges=((2.6, 480, 9),),
        floor=0.005,
        scattering=0.05,
    ),
    Pigment(
        code="Y32",
        name="medium yellow organic",
        edges=((2.6, 512, 9),),
        floor=0.006,
        scattering=0.16,
    ),
    Pigment(
        code="Y33",
        name="golden yellow transparent",
        edges=((2.8, 532, 10),),
        floor=0.01,
        scattering=0.04,
    ),
    Pigment(
        code="Y34",
        name="yellow oxide",
        edges=((1.7, 536, 16),),
        bands=((0.12, 640, 45),),
        floor=0.03,
        scattering=0.33,
        decay=0.3,
    ),
    Pigment(
        code="Y35",
        name="transparent yellow oxide",
        edges=((2.4, 520, 22),),
        floor=0.05,
        scattering=0.03,
    ),
    Pigment(
        code="O40",
        name="orange opaque",
        edges=((2.3, 566, 9),),
        floor=0.004,
        scattering=0.38,
        decay=0.3,
    ),
    Pigment(
        code="O41",
        name="transparent orange",
        edges=((2.8, 572, 10),),
        floor=0.01,
        scattering=0.05,
    ),
    Pigment(
        code="R50",
        name="scarlet",
        edges=((2.4, 580, 8),),
        floor=0.005,
        scattering=0.25,
    ),
    Pigment(
        code="R51",
        name="bright red opaque",
        edges=((2.5, 590, 8),),
        floor=0.004,
        scattering=0.3,
    ),
    Pigment(
        code="R52",
        name="transparent red",
        edges=((3, 597, 9),),
        floor=0.01,
        scattering=0.04,
    ),
    Pigment(
        code="R53",
        name="maroon perylene",
        edges=((2.6, 612, 15),),
        floor=0.03,
        scattering=0.06,
    ),
    Pigment(
        code="R54",
        name="red oxide",
        edges=((2.1, 583, 12),),
        bands=((0.1, 650, 40),),
        floor=0.05,
        scattering=0.42,
        decay=0.3,
    ),
    Pigment(
        code="R55",
        name="transparent red oxide",
        edges=((2.5, 572, 18),),
        floor=0.08,
        scattering=0.04,
    ),
    Pigment(
        code="M60",
        name="magenta quinacridone",
        bands=(
            (2.8, 542, 36),
            (0.35, 470, 40),
        ),
        floor=0.01,
        scattering=0.05,
    ),
    Pigment(
        code="M61",
        name="red-violet quinacridone",
        bands=(
            (2.4, 555, 38),
            (0.7, 480, 40),
        ),
        floor=0.015,
        scattering=0.05,
    ),
    Pigment(
        code="V62",
        name="violet dioxazine",
        bands=(
            (3.4, 570, 50),
            (1.2, 635, 28),
        ),
        floor=0.04,
        scattering=0.03,
    ),
    Pigment(
        code="B70",
        name="reddish blue phthalo",
        bands=(
            (3, 615, 42),
            (2.8, 690, 42),
            (0.25, 400, 30),
        ),
        floor=0.012,
        scattering=0.05,
    ),
    Pigment(
        code="B71",
        name="greenish blue phthalo",
        bands=(
            (3.2, 635, 46),
            (3, 700, 40),
            (0.18, 400, 25),
        ),
        floor=0.01,
        scattering=0.05,
    ),
    Pigment(
        code="B72",
        name="indanthrone blue",
        bands=(
            (2.6, 600, 70),
            (2.2, 680, 60),
            (0.2, 410, 30),
        ),
        floor=0.06,
        scattering=0.04,
    ),
    Pigment(
        code="B73",
        name="ultramarine",
        bands=(
            (1.7, 590, 48),
            (0.8, 660, 50),
        ),
        floor=0.015,
        scattering=0.12,
    ),
    Pigment(
        code="G80",
        name="bluish green phthalo",
        bands=(
            (3, 645, 50),
            (2, 710, 50),
            (1.7, 410, 40),
        ),
        floor=0.012,
        scattering=0.05,
    ),
    Pigment(
        code="G81",
        name="yellowish green phthalo",
        bands=(
            (3, 668, 52),
            (2.6, 415, 52),
        ),
        floor=0.012,
        scattering=0.05,
    ),
    Pigment(
        code="G82",
        name="olive opaque green",
        bands=(
            (1.2, 650, 50),
            (1.8, 430, 60),
        ),
        floor=0.06,
        scattering=0.35,
        decay=0.3,
    ),
)
"""From white over the hue circle to green, as on a mixing bench."""
