from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.preview import environment, light_names
from paintlink.preview.softbox import Softbox
from tests.preview import truth


@pytest.mark.parametrize("light", light_names())
def test_diffuser_leaning_back_has_luminance_one(light: str) -> None:
    surroundings = environment.load(light)
    directions, solid_angle = truth.grid()

    radiance = surroundings.seen_along(directions.astype(np.float32))

    colour = np.broadcast_to(radiance, (len(radiance), 3))
    facing = np.maximum(directions @ [0, np.sqrt(0.5), np.sqrt(0.5)], 0) * solid_angle
    luminance = facing @ colour @ [0.2126, 0.7152, 0.0722] / np.pi
    assert luminance == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize("light", light_names())
def test_merged_lamps_keep_the_whole_flux(light: str) -> None:
    surroundings = environment.load(light)
    directions, solid_angle = truth.grid()

    pointing, flux = surroundings.lamps()

    whole = solid_angle @ surroundings.seen_along(directions.astype(np.float32))
    np.testing.assert_allclose(flux.sum(axis=0), whole, rtol=1e-4)
    np.testing.assert_allclose(np.linalg.norm(pointing, axis=1), 1, atol=1e-5)


def test_neutral_light_needs_one_channel() -> None:
    channels = {name: environment.load(name).channels for name in light_names()}

    assert channels == {
        "booth": 1,
        "overcast": 1,
        "point": 1,
        "sky": 3,
        "studio": 1,
        "sunset": 3,
    }


def test_every_light_but_the_point_shines_everywhere() -> None:
    for name in set(light_names()) - {"point"}:
        assert environment.load(name).grid.min() > 0.0


def test_light_is_known_by_what_it_is() -> None:
    first = environment.Environment("a", "A", truth.sheet_studio)
    same = environment.Environment("b", "B", truth.sheet_studio)
    brighter = environment.Environment("a", "A", lambda d: 2 * truth.sheet_studio(d))

    assert first.digest == same.digest
    assert first.digest != brighter.digest


def test_unknown_light_names_the_nearest() -> None:
    with pytest.raises(PreviewError, match="no preview light 'studo': did you mean 's"):
        environment.load("studo")


def test_softbox_is_bright_inside_and_dark_outside() -> None:
    lamp = Softbox((0.0, 0.0, 1.0), 0.5, 0.25, radiance=3.0, edge=0.01)
    directions = np.array([[0, 0, 1], [0.4, 0, 1], [0, 0.4, 1], [0, 0, -1]], np.float32)

    seen = lamp.seen_along(directions)

    np.testing.assert_allclose(seen, [3, 3, 0, 0], atol=1e-3)


def test_softbox_gradient_favours_the_lower_side() -> None:
    lamp = Softbox((0.0, 0.0, 1.0), 0.5, 0.5, radiance=1.0, gradient=0.5)
    directions = np.array([[0, -0.4, 1], [0, 0.4, 1]], np.float32)

    lower, upper = lamp.seen_along(directions)

    assert lower == pytest.approx(1.4, abs=0.01)
    assert upper == pytest.approx(0.6, abs=0.01)
