from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink.sketch.selection import (
    REASONS,
    counts,
    eroded,
    select,
    thinning,
)
from paintlink.sketch.values import Painting
from tests.sketch.synthesis import Setup, sphere

SETUP = Setup.of(sphere(128))
FACE = (64, 64)


def repainted(value: float = 0.4) -> Painting:
    encoded = SETUP.start.copy()
    encoded[SETUP.geometry.mask] = value
    return Painting(encoded)


def reason_at(painting: Painting, pixel: tuple[int, int]) -> str:
    chosen = select(painting, SETUP.geometry, SETUP.start)
    return REASONS[chosen.reasons[pixel]]


def test_every_pixel_has_one_reason():
    chosen = select(repainted(), SETUP.geometry, SETUP.start)

    number = counts(chosen.reasons)

    assert sum(number.values()) == 128 * 128
    assert number["kept"] == chosen.theta_deg.size > 5000
    assert number["background"] == np.count_nonzero(~SETUP.geometry.mask)


def test_kept_pixels_carry_their_own_values():
    encoded = SETUP.start.copy()
    encoded[SETUP.geometry.mask, 0] = SETUP.geometry.phi[SETUP.geometry.mask] / 2.0

    chosen = select(Painting(encoded), SETUP.geometry, SETUP.start)

    assert chosen.encoded[:, 0] == pytest.approx(chosen.phi / 2.0)
    assert chosen.theta_deg.min() >= 12.0
    assert chosen.phi.min() >= 0.12


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        pytest.param((254 / 255, 0.1, 0.1), "clipped", id="one-channel-at-the-end"),
        pytest.param((253 / 255, 0.1, 0.1), "kept", id="one-code-below"),
        pytest.param((0.95, 0.95, 0.95), "near-white", id="gloss"),
        pytest.param((0.95, 0.95, 0.93), "kept", id="tinted"),
    ],
)
def test_bright_pixels_are_left_out(value, reason):
    painting = repainted()
    painting.encoded[FACE] = value

    assert reason_at(painting, FACE) == reason


@pytest.mark.parametrize(
    ("codes", "lossy", "reason"),
    [(2, False, "unchanged"), (3, False, "kept"), (8, True, "unchanged"),
     (9, True, "kept")],
)  # fmt: skip
def test_small_changes_are_no_paint(codes, lossy, reason):
    painting = repainted()
    painting.encoded[FACE] = SETUP.start[FACE]
    painting.encoded[FACE][1] += codes / 255.0

    assert reason_at(replace(painting, lossy=lossy), FACE) == reason


def test_transparent_pixels_are_left_out():
    alpha = np.ones((128, 128))
    alpha[FACE] = 0.99

    assert reason_at(replace(repainted(), alpha=alpha), FACE) == "transparent"


def test_low_angles_are_gloss_and_shade_is_grazing():
    chosen = select(repainted(), SETUP.geometry, SETUP.start)

    gloss = chosen.reasons == REASONS.index("gloss")
    grazing = chosen.reasons == REASONS.index("grazing")

    assert SETUP.geometry.theta_deg[gloss].max() < 12.0
    assert SETUP.geometry.phi[grazing].max() < 0.12


def test_clipped_pixels_still_count_as_painted():
    painting = repainted()
    painting.encoded[FACE] = 1.0

    chosen = select(painting, SETUP.geometry, SETUP.start)

    assert chosen.painted_deg.size == chosen.theta_deg.size + 1


def test_erosion_equals_four_rounds_of_neighbours():
    mask = np.random.default_rng(3).random((60, 70)) > 0.02
    rounds = mask
    for _ in range(4):
        padded = np.pad(rounds, 1)
        rounds = (
            rounds
            & padded[:-2, 1:-1] & padded[2:, 1:-1]
            & padded[1:-1, :-2] & padded[1:-1, 2:]
        )  # fmt: skip

    assert rounds.any()
    assert np.array_equal(eroded(mask, 1), rounds)
    assert np.array_equal(eroded(mask, 3), rounds[::3, ::3])


@pytest.mark.parametrize(("side", "step"), [(500, 1), (600, 3), (1600, 3), (2000, 5)])
def test_large_pictures_are_thinned_oddly(side, step):
    assert thinning(np.ones((side, side), dtype=bool)) == step


def test_pictures_of_another_size_are_refused():
    small = Painting(np.zeros((64, 64, 3)))

    with pytest.raises(InputError, match="64 x 64 pixels, the set-up 128 x 128"):
        select(small, SETUP.geometry, SETUP.start)
