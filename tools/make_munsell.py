"""Write the library of Munsell colours: ``python tools/make_munsell.py``.

The renotation of 1943 gives the chromaticity of each colour for illuminant C and the
2 degree observer. A library needs Lab for D65 and 10 degrees. No chromatic adaptation
can know that: observer and light both change. So each colour gets the smoothest
reflectance curve that has its tristimulus values under C/2, and this curve is then
looked at under D65/10. Colours for which no such curve is found, at the very limit of
what surfaces can be, are adapted by CAT16 instead, and marked.

``--check`` measures both ways on the charts of colour-science, whose curves are known.

References
----------
Newhall, Nickerson and Judd 1943 (the renotation, as colour-science carries it); ASTM
D1535 (reflectance relative to the perfect diffuser: 0.975 times the renotation's);
Burns 2020, Numerical methods for smoothest reflectance reconstruction (the curve whose
hyperbolic arctangent has the least slope); Li and others 2017 (CAT16).
"""

from __future__ import annotations

import io
import sys
import warnings
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import colour
    from colour.notation import MUNSELL_COLOURS_REAL

from paintlink.color import cie76

Array = NDArray[np.float64]
TARGET = Path(__file__).parents[1] / "paintlink" / "library" / "data" / "munsell.npz"
LIBRARY = "Munsell (real, converted to D65/10)"
MAGNESIUM_OXIDE = 0.975
FIRST_NM, LAST_NM, STEP_NM = 360, 780, 10
ANGLES_DEG = (15.0, 45.0, 110.0)
ENOUGH = 1e-9
MOST_STEPS = 60
MOST_CHANGE = 2.0
SMALLEST_ADVANCE = 1e-3
A_DATE = (2026, 1, 1, 0, 0, 0)


def main() -> None:
    """Write the library, or check the method."""
    if "--check" in sys.argv:
        check()
    else:
        write(Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET)


def write(target: Path) -> None:
    """Convert all colours and write the file; the same bytes on every run."""
    codes, xyz = renotation()
    factors = np.array([smoothest(one) for one in xyz])
    adapted = np.isnan(factors[:, 0])
    lab = np.where(adapted[:, None], cat16(xyz), to_lab(factors @ D65_10, D65_10))
    hundredths = np.rint(lab * 100.0).astype(np.int16)
    save(target, {
        "library": np.array(LIBRARY),
        "synthetic": np.array(False),
        "observer": np.array("10"),
        "angles_deg": np.array(ANGLES_DEG),
        "ids": np.arange(1, len(codes) + 1),
        "codes": np.array(codes, dtype=np.bytes_),
        "names": np.array([f"Munsell {code}" for code in codes], dtype=np.bytes_),
        "finishes": np.array(["solid"] * len(codes), dtype=np.bytes_),
        "lab_hundredths": np.repeat(hundredths[:, None], len(ANGLES_DEG), axis=1),
        "gloss_tenths_gu": np.zeros(len(codes), dtype=np.int16),
        "adapted": adapted,
    })  # fmt: skip
    size = target.stat().st_size / 1024
    print(f"{target}: {len(codes)} colours, {adapted.sum()} adapted, {size:.0f} KiB")


def check() -> None:
    """Print how far both ways are from the truth of known reflectance curves."""
    charts = (chart.values() for chart in colour.SDS_COLOURCHECKERS.values())
    shape = colour.SpectralShape(FIRST_NM, LAST_NM, STEP_NM)
    curves = np.array([
        np.clip(one.copy().align(shape).values, 0.0, None)
        for chart in charts
        for one in chart
    ])
    truth = to_lab(curves @ D65_10, D65_10)
    under_c = curves @ C_2
    factors = np.array([smoothest(one) for one in under_c])
    print(f"{len(curves)} patches, CIE76 to the truth: median, p90, largest")
    for name, lab in (
        ("smoothest reflectance", to_lab(factors @ D65_10, D65_10)),
        ("CAT16", cat16(under_c)),
    ):
        found = cie76(truth, lab)
        median, p90, largest = np.percentile(found, [50, 90, 100])
        print(f"{name:24s} {median:5.2f} {p90:5.2f} {largest:5.2f}")


def renotation() -> tuple[list[str], Array]:
    """Codes such as ``5R 4/14``, and XYZ for C/2 with Y = 100 for the diffuser."""
    codes = [
        f"{hue} {value:g}/{chroma:g}"
        for (hue, value, chroma), _ in MUNSELL_COLOURS_REAL
    ]
    x, y, luminance = np.array([xyY for _, xyY in MUNSELL_COLOURS_REAL]).T
    scale = luminance * MAGNESIUM_OXIDE / y
    return codes, scale[:, None] * np.stack([x, y, 1.0 - x - y], axis=1)


def weights(illuminant: str, observer: str) -> Array:
    """Weights of reflectance factors at the nodes, shape (nodes, 3).

    The curve runs straight from node to node; Y of the perfect diffuser is 100.
    """
    shape = colour.SpectralShape(FIRST_NM, LAST_NM, 1)
    functions = colour.MSDS_CMFS[observer].copy().align(shape).values
    light = colour.SDS_ILLUMINANTS[illuminant].copy().align(shape).values
    fine = functions * light[:, None]
    nodes = np.arange(FIRST_NM, LAST_NM + 1, STEP_NM)
    every = np.arange(FIRST_NM, LAST_NM + 1)
    hats = np.array([np.interp(every, nodes, row) for row in np.eye(len(nodes))])
    table: Array = hats @ fine
    return table * 100.0 / table[:, 1].sum()


def smoothest(xyz: Array) -> Array:
    """Reflectance factors at the nodes with this XYZ under C/2; NaN where none has.

    Walks from the grey of the same Y to the colour, with shorter steps where it has to.
    """
    nodes = len(C_2)
    grey = C_2.sum(axis=0) * xyz[1] / 100.0
    curve = Curve(np.full(nodes, np.arctanh(2.0 * xyz[1] / 100.0 - 1.0)), np.zeros(3))
    done, advance = 0.0, 1.0
    while done < 1.0:
        goal = min(done + advance, 1.0)
        found = solved(curve, grey + goal * (xyz - grey))
        if found is None:
            advance /= 2.0
            if advance < SMALLEST_ADVANCE:
                return np.full(nodes, np.nan)
            continue
        curve, done = found, goal
    return curve.factors


@dataclass(frozen=True)
class Curve:
    """A reflectance curve in the making: ``z = arctanh(2 factor - 1)``."""

    z: Array
    multipliers: Array

    @property
    def factors(self) -> Array:
        """Reflectance factors, between 0 and 1."""
        return (np.tanh(self.z) + 1.0) / 2.0


def solved(curve: Curve, xyz: Array) -> Curve | None:
    """The smoothest curve with this XYZ by Newton's method; None when it fails."""
    z, multipliers = curve.z, curve.multipliers
    nodes = len(z)
    for _ in range(MOST_STEPS):
        slope = 0.5 / np.cosh(z) ** 2
        pull = C_2 @ multipliers
        tilted = slope[:, None] * C_2
        fault = np.concatenate([
            SLOPES @ z + slope * pull,
            C_2.T @ Curve(z, multipliers).factors - xyz,
        ])
        if np.abs(fault).max() < ENOUGH:
            return Curve(z, multipliers)
        bend = np.diag(-2.0 * slope * np.tanh(z) * pull)
        matrix = np.block([[SLOPES + bend, tilted], [tilted.T, np.zeros((3, 3))]])
        try:
            step = np.linalg.solve(matrix, -fault)
        except np.linalg.LinAlgError:
            return None
        step *= min(1.0, MOST_CHANGE / np.abs(step[:nodes]).max())
        z, multipliers = z + step[:nodes], multipliers + step[nodes:]
    return None


def slopes(nodes: int) -> Array:
    """Matrix whose quadratic form is the sum of the squared slopes of a curve."""
    differences = np.diff(np.eye(nodes), axis=0)
    matrix: Array = 2.0 * differences.T @ differences
    return matrix


def cat16(xyz: Array) -> Array:
    """Lab for D65/10 by chromatic adaptation alone."""
    matrix = colour.adaptation.matrix_chromatic_adaptation_VonKries(
        C_2.sum(axis=0), D65_10.sum(axis=0), transform="CAT16"
    )
    return to_lab(xyz @ matrix.T, D65_10)


def to_lab(xyz: Array, table: Array) -> Array:
    """CIE Lab of XYZ; the white is that of the weights."""
    white = colour.XYZ_to_xy(table.sum(axis=0))
    lab: Array = colour.XYZ_to_Lab(xyz / 100.0, white)
    return lab


def save(target: Path, columns: dict[str, NDArray[np.generic]]) -> None:
    """Write an npz archive without the time it was made."""
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, column in columns.items():
            content = io.BytesIO()
            np.lib.format.write_array(content, np.asarray(column), allow_pickle=False)
            info = zipfile.ZipInfo(f"{name}.npy", A_DATE)
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, content.getvalue())


C_2 = weights("C", "CIE 1931 2 Degree Standard Observer")
D65_10 = weights("D65", "CIE 1964 10 Degree Standard Observer")
SLOPES = slopes(len(C_2))

if __name__ == "__main__":
    main()
