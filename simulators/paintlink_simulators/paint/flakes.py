"""Flake toners: aluminium, coated mica and silica, metal cores.

Invented grades in the manner of the powders on the market. Their colour is computed
from layer thickness and refractive index, never tabulated.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from paintlink_simulators.paint.films import Film

FlakeKind = Literal["aluminium", "interference"]

ALUMINIUM_NM = 300.0
MICA_NM = tuple(np.linspace(250.0, 650.0, 33).tolist())
"""Real mica is ground, not grown: 250 to 650 nm, evenly."""
SILICA_SPREAD_NM, SILICA_STEPS = 12.0, 9
"""Silica cores are grown and uniform, which is what makes them travel in hue."""
SPACER_SPREAD_NM, SPACER_STEPS = 8.0, 7


@dataclass(frozen=True, slots=True, kw_only=True)
class Flake:
    """A toner of platelets.

    Parameters
    ----------
    area
        Projected flake area of one part by weight.
    spread_deg, tail
        Width and power of the tilt distribution, see `lobe.tilt_density`.
    smoothness
        Share of the mirrored light that a rough face keeps in its direction.
    absorption, scattering
        Diffuse absorption and edge scattering of one unit of area.
    diameter_um
        Median; only the invented texture numbers use it.
    films
        From one face to the other, in binder.
    """

    code: str
    name: str
    kind: FlakeKind
    area: float
    spread_deg: float
    tail: float
    smoothness: float = 1.0
    absorption: float
    scattering: float
    diameter_um: float
    films: tuple[Film, ...]


def _aluminium(
    code: str, name: str, shape: tuple[float, float, float], **optics: float
) -> Flake:
    area, spread_deg, diameter_um = shape
    return Flake(
        code=code,
        name=f"aluminium {name}",
        kind="aluminium",
        area=area,
        spread_deg=spread_deg,
        absorption=0.22,
        diameter_um=diameter_um,
        films=(Film("aluminium", (ALUMINIUM_NM,)),),
        **optics,
    )


def _on_mica(
    code: str,
    name: str,
    coating: tuple[str, float],
    *,
    shape: tuple[float, float, float] = (1.7, 5.0, 18.0),
    absorption: float = 0.004,
    scattering: float = 0.10,
) -> Flake:
    area, spread_deg, diameter_um = shape
    material, thickness_nm = coating
    coat = Film(material, (thickness_nm,))
    return Flake(
        code=code,
        name=f"mica {name}",
        kind="interference",
        area=area,
        spread_deg=spread_deg,
        tail=2.6,
        absorption=absorption,
        scattering=scattering,
        diameter_um=diameter_um,
        films=(coat, Film("mica", MICA_NM), coat),
    )


def _on_silica(code: str, name: str, coat_nm: float, core_nm: float) -> Flake:
    coat = Film("titania", (coat_nm,))
    core = Film("silica", _around(core_nm, SILICA_SPREAD_NM, SILICA_STEPS))
    return Flake(
        code=code,
        name=f"silica travel {name}",
        kind="interference",
        area=1.6,
        spread_deg=4.0,
        tail=2.4,
        absorption=0.004,
        scattering=0.07,
        diameter_um=20.0,
        films=(coat, core, coat),
    )


def _metal_core(code: str, name: str, spacer_nm: float) -> Flake:
    absorber = Film("haematite", (14.0,))
    spacer = Film("silica", _around(spacer_nm, SPACER_SPREAD_NM, SPACER_STEPS))
    return Flake(
        code=code,
        name=f"metal-core travel {name}",
        kind="interference",
        area=2.4,
        spread_deg=3.8,
        tail=2.2,
        absorption=0.12,
        scattering=0.05,
        diameter_um=18.0,
        films=(absorber, spacer, Film("aluminium", (80.0,)), spacer, absorber),
    )


def _around(middle: float, spread: float, steps: int) -> tuple[float, ...]:
    return tuple(np.linspace(middle - spread, middle + spread, steps).tolist())


def _grade(tail: float, smoothness: float, scattering: float) -> dict[str, float]:
    return {"tail": tail, "smoothness": smoothness, "scattering": scattering}


FLAKES = (
    _aluminium(
        "A01", "extra coarse lenticular", (2.6, 3.3, 35.0), **_grade(2.2, 0.97, 0.020)
    ),
    _aluminium(
        "A02", "coarse lenticular", (3.2, 3.7, 26.0), **_grade(2.1, 0.96, 0.026)
    ),
    _aluminium(
        "A03", "medium lenticular", (4.2, 4.3, 19.0), **_grade(2.0, 0.94, 0.040)
    ),
    _aluminium("A04", "fine lenticular", (5.5, 5.2, 13.0), **_grade(2.0, 0.90, 0.075)),
    _aluminium("A05", "coarse cornflake", (3.4, 4.6, 28.0), **_grade(1.9, 0.90, 0.045)),
    _aluminium("A06", "medium cornflake", (4.6, 5.6, 19.0), **_grade(1.9, 0.86, 0.075)),
    _aluminium("A07", "fine cornflake", (6.4, 6.8, 12.0), **_grade(1.9, 0.80, 0.130)),
    _aluminium("A08", "extra fine", (8.0, 8.0, 8.0), **_grade(1.9, 0.74, 0.200)),
    _on_mica(
        "P10", "white fine", ("titania", 48.0), shape=(1.9, 6.0, 10.0), scattering=0.14
    ),
    _on_mica(
        "P11",
        "white coarse",
        ("titania", 52.0),
        shape=(1.3, 4.2, 25.0),
        scattering=0.08,
    ),
    _on_mica("P12", "yellow", ("titania", 82.0)),
    _on_mica("P13", "red", ("titania", 100.0)),
    _on_mica("P14", "violet", ("titania", 108.0)),
    _on_mica("P15", "blue", ("titania", 122.0)),
    _on_mica("P16", "green", ("titania", 150.0)),
    _on_mica(
        "P20", "bronze", ("haematite", 28.0), shape=(2.2, 5.0, 18.0), absorption=0.02
    ),
    _on_mica(
        "P21", "copper", ("haematite", 48.0), shape=(2.2, 5.0, 18.0), absorption=0.02
    ),
    _on_mica(
        "P22", "russet", ("haematite", 66.0), shape=(2.2, 5.0, 18.0), absorption=0.02
    ),
    _on_silica("P30", "green-red", 110.0, 420.0),
    _on_silica("P31", "violet-gold", 70.0, 330.0),
    _metal_core("P40", "long", 395.0),
    _metal_core("P41", "short", 340.0),
)
"""Aluminium from coarse to fine, then interference flakes."""
