"""What the bundled library knows of a paint beyond its colour."""

from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import ciede2000, reflectance_to_lab
from paintlink.library import Book, book
from paintlink.library.store import BUNDLED
from paintlink.library.virtual import decoded, encoded
from paintlink.model import FloatArray

WAVELENGTHS_NM = np.arange(400.0, 701.0, 10.0)
NAMED = ("YM144", "GM027", "GM044", "BM304", "RM209", "RM331")


@pytest.fixture(scope="module")
def known() -> Book:
    return book()


def travel(known: Book, row: int) -> FloatArray:
    return known.table.lab[row, [1, 3, 5]]


def test_lab_is_that_of_the_stored_spectra(known: Book) -> None:
    """Every user can reproduce it: E308, D65/10, rounded to hundredths."""
    factors = np.array([known.factors(row) for row in range(len(known.table))])

    lab = reflectance_to_lab(WAVELENGTHS_NM, factors.reshape(-1, 31))

    assert np.array_equal(
        np.round(lab, 2).reshape(known.table.lab.shape), known.table.lab
    )


def test_storing_spectra_moves_no_colour_visibly() -> None:
    rng = np.random.default_rng(1)
    factors = np.concatenate([
        10.0 ** rng.uniform(-2.5, 0.7, (500, 1)) * rng.uniform(0.3, 1.0, (500, 31)),
        np.full((1, 31), 5.8),
    ])

    stored = decoded(encoded(factors))

    before, after = (reflectance_to_lab(WAVELENGTHS_NM, f) for f in (factors, stored))
    assert np.linalg.norm(before - after, axis=1).max() < 0.05


def test_formulas_weigh_a_hundred_parts_of_few_toners(known: Book) -> None:
    for row, code in enumerate(known.table.codes):
        formula = known.formula(row)
        parts = [one.parts for one in formula]
        assert round(100 * sum(parts)) == 10_000
        assert parts == sorted(parts, reverse=True)
        assert min(parts) >= 0.04
        assert len(formula) <= (10 if code in NAMED else 8)
        assert all(one.name for one in formula)


def test_solids_hold_no_flakes_and_effects_do(known: Book) -> None:
    for row, finish in enumerate(known.table.finishes):
        flakes = {one.code[0] for one in known.formula(row)} & {"A", "P"}
        assert bool(flakes) == (finish != "solid")


def test_solids_have_one_spectrum_at_every_angle(known: Book) -> None:
    first, last = known.factors(0), known.factors(2999)

    assert known.table.finishes[2999] == "solid"
    assert np.array_equal(first, np.tile(first[0], (6, 1)))
    assert last.max() <= 1.0


def test_spectra_fit_a_specification(known: Book) -> None:
    spectra = known.spectra(5000)

    assert [one.aspecular_deg for one in spectra] == [*known.table.angles_deg]
    assert np.array_equal([one.factors for one in spectra], known.factors(5000))
    assert {(one.start_nm, one.step_nm) for one in spectra} == {(400.0, 10.0)}


def test_metallics_sparkle_and_solids_do_not(known: Book) -> None:
    solid, metallic = (
        known.texture(known.table.finishes.index(finish))
        for finish in ("solid", "metallic")
    )

    assert [one.angle_deg for one in metallic] == [15.0, 45.0, 75.0, None]
    assert all(one.value > 0.0 for one in metallic)
    assert all(one.value == 0.0 for one in solid)


def test_variants_hang_round_their_prime(known: Book) -> None:
    primes = [row for row in range(6000) if known.role(row) == "prime"]
    seen = [row for prime in primes for row in known.group(prime)]

    assert sorted(seen) == list(range(6000))
    assert 1500 < len(primes) < 3500
    for prime in primes[::5]:
        first, *variants = known.group(prime)
        roles = [known.role(row) for row in variants]
        assert first == prime
        assert len(set(roles)) == len(roles)
        assert len({known.table.codes[row][:2] for row in (first, *variants)}) == 1
        for number, row in enumerate(variants, start=1):
            expected = f"{known.table.names[prime]} V{number}"
            assert known.table.names[row] == expected
            assert known.group(row) == known.group(prime)
            distance = ciede2000(travel(known, prime), travel(known, row)).mean()
            assert 0.65 < distance < 3.55


@pytest.mark.parametrize(
    ("role", "channel", "sign"),
    [
        ("lighter", 0, 1),
        ("darker", 0, -1),
        ("redder", 1, 1),
        ("greener", 1, -1),
        ("yellower", 2, 1),
        ("bluer", 2, -1),
    ],
)
def test_neutral_variants_look_as_their_role_says(
    known: Book, role: str, channel: int, sign: int
) -> None:
    neutral = [
        row
        for row, code in enumerate(known.table.codes)
        if code[0] in "LMD" and known.role(row) == role
    ]

    for row in neutral:
        away = (travel(known, row) - travel(known, known.group(row)[0])).mean(axis=0)
        assert np.abs(away).argmax() == channel
        assert away[channel] * sign > 0.0
    assert neutral


@pytest.mark.parametrize(("role", "sign"), [("coarser", 1), ("finer", -1)])
def test_coarser_variants_open_face_and_flop(known: Book, role: str, sign: int) -> None:
    rows = [row for row in range(6000) if known.role(row) == role]

    for row in rows:
        away = travel(known, row)[:, 0] - travel(known, known.group(row)[0])[:, 0]
        assert sign * (away[0] - away[2]) > 0.0
    assert len(rows) > 50


def test_file_is_small_enough_to_ship() -> None:
    assert BUNDLED.stat().st_size <= 2_000_000
