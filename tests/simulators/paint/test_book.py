"""The bundled paints as simulators see them: one truth with the library."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from paintlink.color import LEAVES, lab_to_lch, leaf_indices, reflectance_to_lab, white
from paintlink.errors import InputError
from paintlink.library.virtual import book as bundled_book
from paintlink.model import FloatArray
from paintlink_simulators.paint import (
    CAREFUL_SITE,
    WAVELENGTHS_NM,
    SprayBooth,
    amounts,
    book,
    formula_of,
    noisy,
    reflect,
)

CURVES = Path(__file__).parents[4] / "shared" / "data" / "real_paints_curves.csv"
REAL_EFFECTS = (
    "blue-metallic-paint",
    "blue-metallic-paint2",
    "color-changing-paint1",
    "color-changing-paint2",
    "color-changing-paint3",
    "gold-metallic-paint",
    "gold-metallic-paint2",
    "gold-metallic-paint3",
    "gold-paint",
    "green-metallic-paint",
    "green-metallic-paint2",
    "pearl-paint",
    "red-metallic-paint",
    "silver-metallic-paint",
    "silver-metallic-paint2",
    "silver-paint",
    "two-layer-gold",
    "two-layer-silver",
)
GAINS = np.geomspace(0.3, 3.3, 80)


def test_formulas_are_those_of_the_library() -> None:
    known = bundled_book()

    assert tuple(book()) == known.table.codes
    for row, formula in enumerate(book().values()):
        assert [(one.code, one.parts) for one in known.formula(row)] == [
            *formula.items()
        ]


def test_model_gives_the_spectra_of_the_library() -> None:
    """Within one step of what is stored, and Lab within 0.05."""
    known = bundled_book()
    factors = reflect(amounts(list(book().values())), known.table.angles_deg)

    stored = np.array([known.factors(row) for row in range(len(known.table))])

    assert np.abs(np.sqrt(factors) - np.sqrt(stored)).max() < 0.51 / 27_000
    lab = reflectance_to_lab(WAVELENGTHS_NM, factors.reshape(-1, 31))
    assert np.abs(lab.reshape(known.table.lab.shape) - known.table.lab).max() < 0.05


def lightness(y: FloatArray) -> FloatArray:
    """L* of luminance factors in per cent; real ones lie far above the linear toe."""
    return 116.0 * np.cbrt(y / white()[1]) - 16.0


def test_aspecular_curves_have_the_shapes_of_measured_paints() -> None:
    """The nearest of all effect paints, the level left free: it is not truth there."""
    if not CURVES.exists():
        pytest.skip(f"{CURVES.name} is not part of the project")
    with CURVES.open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if float(row["aspecular"]) >= 15]
    angles = sorted({float(row["aspecular"]) for row in rows})
    known = bundled_book().table
    effects = [
        formula
        for formula, finish in zip(book().values(), known.finishes, strict=True)
        if finish != "solid"
    ]
    factors = reflect(amounts(effects), angles)
    ours = reflectance_to_lab(WAVELENGTHS_NM, factors.reshape(-1, 31))[:, 0]
    ours = ours.reshape(-1, len(angles))
    errors = []

    for material in REAL_EFFECTS:
        real = [float(row["L"]) for row in rows if row["material"] == material]
        y = 100.0 * ((np.array(real) + 16.0) / 116.0) ** 3
        scaled = lightness(np.outer(GAINS, y))
        off = np.sqrt(((ours[:, np.newaxis] - scaled) ** 2).mean(axis=2))
        errors.append(off.min())

    assert len(angles) == 20
    assert np.median(errors) <= 2.5
    assert max(errors) <= 6.0


def test_leaves_follow_from_the_formulas() -> None:
    """Not only from what the file says of itself."""
    known = bundled_book().table
    lab = reflectance_to_lab(
        WAVELENGTHS_NM, reflect(amounts(list(book().values())), 45.0)[:, 0]
    )

    leaves = leaf_indices(lab, known.finishes)

    assert set(leaves.tolist()) == set(range(len(LEAVES)))
    stored = leaf_indices(known.lab[:, 3], known.finishes)
    assert np.mean(leaves == stored) > 0.999


def test_no_solid_is_brighter_or_purer_than_real_colours() -> None:
    """The hull of the 2734 real Munsell colours, with black and white added.

    They lie between L* 6 and 92 only; their chroma is no limit, so ceilings by hue
    stand beside the hull.
    """
    import warnings

    from scipy.spatial import Delaunay

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour
    xyy = np.array([
        data for _, data in colour.notation.MUNSELL_COLOURS["Munsell Colours Real"]
    ])
    # The published Y is relative to smoked magnesium oxide (ASTM D1535).
    xyz = colour.xyY_to_XYZ(xyy * [1.0, 1.0, 0.00975])
    source = colour.xy_to_XYZ(
        colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]["C"]
    )
    target = white() / 100.0
    adapted = colour.chromatic_adaptation(
        xyz, source, target, method="Von Kries", transform="CAT02"
    )
    munsell = colour.XYZ_to_Lab(adapted, colour.XYZ_to_xy(target))
    hull = Delaunay(np.vstack([munsell, [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0]]]))
    known = bundled_book().table
    solids = known.lab[np.array(known.finishes) == "solid", 0]

    inside = hull.find_simplex(solids) >= 0
    _, chroma, hue = lab_to_lch(solids).T

    assert len(munsell) == 2734
    assert inside.mean() >= 0.99
    for start, end, ceiling in (
        (0, 45, 80),
        (45, 115, 95),
        (115, 240, 55),
        (240, 320, 70),
        (320, 360, 62),
    ):
        assert chroma[(hue >= start) & (hue < end)].max() <= ceiling


def test_unknown_code_gets_near_ones() -> None:
    with pytest.raises(InputError, match=r"no paint 'RM2091': did you mean .*RM209"):
        formula_of("RM2091")


def test_sprayed_and_read_paints_are_found_again() -> None:
    """Nearest in the library is the paint itself or another of its group."""
    known = bundled_book()
    table = known.table
    columns = [table.angles_deg.index(angle) for angle in (15.0, 45.0, 110.0)]
    booth = SprayBooth(CAREFUL_SITE, seed=11)
    rng = np.random.default_rng(12)
    rows = rng.choice(len(table), 200, replace=False)
    home = 0

    for row in rows.tolist():
        panel = noisy(booth.spray(book()[table.codes[row]]), rng)
        lab = reflectance_to_lab(WAVELENGTHS_NM, panel.factors_at((15.0, 45.0, 110.0)))
        away = np.linalg.norm(table.lab[:, columns] - lab, axis=2).sum(axis=1)
        home += int(away.argmin()) in known.group(row)

    assert home >= 190
