from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.model import ColorSpec, Gloss
from paintlink.preview import Picture, light_names, object_names, render, scene
from tests.preview.truth import GREY, PEARL, RED, SILVER, paint

pytestmark = pytest.mark.usefixtures("coarse_bake")

WHITE = paint(*[(95, 0, 0)] * 3)
BLACK = paint(*[(4, 0, 0)] * 3)


def drawn(*specs: ColorSpec, size: int = 64, object: str = "sphere") -> Picture:
    return render(specs, object=object, size=size, backend="cpu")


def test_picture_is_square_bytes_nobody_can_change() -> None:
    picture = drawn(SILVER)

    assert picture.rgb.shape == (64, 64, 3)
    assert picture.rgb.dtype == np.uint8
    assert not picture.rgb.flags.writeable
    assert (picture.backend, picture.object, picture.light) == (
        "cpu",
        "sphere",
        "studio",
    )


@pytest.mark.parametrize("object", object_names())
def test_neutral_paint_in_neutral_light_is_neutral(object: str) -> None:
    rgb = drawn(GREY, object=object).rgb.astype(int)

    assert np.ptp(rgb, axis=2).max() <= 1


def test_backdrop_is_the_same_behind_every_paint() -> None:
    corner = [drawn(spec).rgb[:8, :8] for spec in (WHITE, BLACK, RED)]

    np.testing.assert_array_equal(corner[0], corner[1])
    np.testing.assert_array_equal(corner[0], corner[2])


def test_exposure_does_not_follow_the_paint() -> None:
    white, grey, black = (
        drawn(spec).rgb[32, 32].mean() for spec in (WHITE, GREY, BLACK)
    )

    assert white > grey + 30 > black + 60


def test_metallic_is_brighter_in_the_face_than_in_the_flop() -> None:
    solid, metallic = drawn(GREY).rgb.astype(int), drawn(SILVER).rgb.astype(int)

    face, flop = metallic[16, 36].mean(), metallic[52, 40].mean()
    assert face - flop > (solid[16, 36].mean() - solid[52, 40].mean()) + 30


def test_pearl_turns_its_hue_from_face_to_flop() -> None:
    rgb = drawn(PEARL, size=128).rgb.astype(int)

    face, flop = rgb[32, 72], rgb[100, 120 - 30]
    assert face[1] > face[2]
    assert flop[0] > flop[1]


def test_two_paints_stand_left_and_right() -> None:
    both = drawn(RED, SILVER, size=128).rgb
    left, right = drawn(RED, size=128).rgb, drawn(SILVER, size=128).rgb

    np.testing.assert_array_equal(both[:, :63], left[:, :63])
    np.testing.assert_array_equal(both[:, 65:], right[:, 65:])


def test_neutral_seam_parts_two_paints() -> None:
    rgb = drawn(RED, RED, size=400).rgb.astype(int)

    assert np.ptp(rgb[:, 199:201], axis=2).max() == 0
    assert np.ptp(rgb[100:300, [196, 203]], axis=2).min() > 50


@pytest.mark.parametrize("count", [3, 4])
def test_more_paints_share_the_width_of_the_object(count: int) -> None:
    specs = [RED, SILVER, PEARL, GREY][:count]
    together = drawn(*specs, size=96, object="cylinder").rgb
    alone = [drawn(spec, size=96, object="cylinder").rgb for spec in specs]

    middles = np.linspace(7, 89, 2 * count + 1)[1::2].round().astype(int)

    for column, picture in zip(middles, alone, strict=True):
        np.testing.assert_array_equal(together[:, column], picture[:, column])


def test_strips_keep_their_own_gloss() -> None:
    dull = ColorSpec("dull", BLACK.samples, gloss=Gloss(5.0, 60.0))
    shiny = ColorSpec("shiny", BLACK.samples, gloss=Gloss(90.0, 60.0))

    rgb = drawn(dull, shiny, size=128, object="cylinder").rgb.astype(int)

    edges = np.abs(np.diff(rgb[40:90, [28, 100], 0], axis=0)).max(axis=0)
    assert edges[1] > 4 * edges[0]


def test_unknown_gloss_is_said() -> None:
    measured = ColorSpec("measured", RED.samples, gloss=Gloss(92.0, 20.0))

    assert drawn(RED).notes == ("gloss not measured, 90 GU at 60° assumed",)
    assert drawn(measured).notes == ()


def test_outline_is_smooth() -> None:
    rgb = drawn(BLACK, size=256).rgb.astype(int)[:100, 128].mean(axis=1)

    first = int(np.argmax(np.abs(np.diff(rgb)) > 20))
    assert abs(rgb[first + 3] - rgb[first - 2]) > np.abs(np.diff(rgb)).max() + 5


def test_picture_is_the_same_in_one_band_or_many(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    whole = drawn(SILVER, size=96).rgb
    monkeypatch.setattr(scene, "BAND_PIXELS", 96 * 7)

    np.testing.assert_array_equal(whole, drawn(SILVER, size=96).rgb)


@pytest.mark.parametrize("light", light_names())
@pytest.mark.parametrize("size", [16, 17, 1500])
def test_sizes_from_thumbnail_to_poster_are_drawn(size: int, light: str) -> None:
    rgb = render([PEARL], size=size, light=light, backend="cpu").rgb

    assert rgb.shape == (size, size, 3)
    assert np.ptp(rgb.reshape(-1, 3), axis=0).min() > 40


def test_small_picture_is_the_large_one_seen_from_afar() -> None:
    small = drawn(SILVER, size=64, object="panel").rgb.astype(float)
    large = drawn(SILVER, size=512, object="panel").rgb.astype(float)

    shrunk = large.reshape(64, 8, 64, 8, 3).mean(axis=(1, 3))
    assert np.abs(shrunk - small).mean() < 1.5


def test_threads_at_once_get_the_right_pictures() -> None:
    specs = [RED, SILVER, PEARL, GREY] * 3
    alone = [drawn(spec, size=80).rgb for spec in specs]

    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda spec: drawn(spec, size=80).rgb, specs))

    for one, other in zip(alone, together, strict=True):
        np.testing.assert_array_equal(one, other)


EXTREMES = [
    paint((170, 400, -400), (0, -400, 400), (-16, 0, 0)),
    paint((-16, 0, 0), (-16, 5, 5), (-16, -5, 0)),
    paint(*[(50, 20, 30)] * 3, angles=(25, 45, 75)),
    paint(*[(50, 20, 30)] * 6, angles=(-15, 15, 25, 45, 75, 110)),
    paint(*[(50, 20, 30)] * 3, angles=(-90, -15, 180)),
]


@pytest.mark.parametrize("spec", EXTREMES, ids=["vivid", "black", "25", "six", "far"])
def test_every_valid_specification_can_be_drawn(spec: ColorSpec) -> None:
    assert drawn(spec, size=32).rgb.shape == (32, 32, 3)


@pytest.mark.parametrize("size", [0, 15, 4097, -5])
def test_size_out_of_range_is_refused(size: int) -> None:
    with pytest.raises(PreviewError, match=f"16 to 4096 pixels wide, not {size}"):
        drawn(RED, size=size)


@pytest.mark.parametrize("count", [0, 5])
def test_wrong_number_of_paints_is_refused(count: int) -> None:
    with pytest.raises(PreviewError, match=f"shows 1 to 4 paints, not {count}"):
        drawn(*[RED] * count)


def test_unknown_backend_names_the_nearest() -> None:
    with pytest.raises(PreviewError, match="no preview backend 'gpu': did you mean 'c"):
        render([RED], backend="gpu")  # type: ignore[arg-type]
