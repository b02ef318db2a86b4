from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFilter

from paintlink.errors import InputError
from paintlink.sketch.geometry import coverage
from paintlink.sketch.registration import NO_SHIFT, registered, require_upright
from tests.sketch.easel import GREY_CODE, OBJECTS, made, start_image, values

FILL = (GREY_CODE,) * 3


def warped(image: Image.Image, *matrix: float) -> Image.Image:
    """The picture with each pixel taken from another place."""
    return image.transform(
        image.size,
        Image.Transform.AFFINE,
        matrix,
        Image.Resampling.BICUBIC,
        fillcolor=FILL,
    )


def moved(image: Image.Image, right: float, down: float) -> Image.Image:
    return warped(image, 1, 0, -right, 0, 1, -down)


def scaled(image: Image.Image, by: float) -> Image.Image:
    off = image.width / 2 * (1 - 1 / by)
    return warped(image, 1 / by, 0, off, 0, 1 / by, off)


def repainted(name: str) -> Image.Image:
    """A red object before white, the control strip gone, 25 wild strokes."""
    start = np.asarray(start_image(name))
    cover = coverage(made(name).recipe.pose)[..., np.newaxis]
    red = start * np.array([0.9, 0.3, 0.2])
    image = Image.fromarray((cover * red + (1 - cover) * 255).astype(np.uint8))
    draw, random = ImageDraw.Draw(image), np.random.default_rng(3)
    for _ in range(25):
        ends = [tuple(random.integers(90, 400, 2).tolist()) for _ in range(3)]
        draw.line(ends, fill=tuple(random.integers(0, 255, 3).tolist()), width=14)
    return image


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize("move", [(1, 0), (0, -2), (3, 2), (10, -4), (-13, 9)])
def test_moves_are_found_to_a_tenth_of_a_pixel(
    name: str, move: tuple[int, int]
) -> None:
    shift = registered(values(moved(start_image(name), *move)), made(name).recipe.pose)

    assert (shift.right_px, shift.down_px) == pytest.approx(move, abs=0.1)


@pytest.mark.parametrize("move", [(0.5, 0.5), (-7.4, 2.2), (25, 9), (-40, 6)])
def test_far_and_partial_moves_are_found(move: tuple[float, float]) -> None:
    pose = made("sphere").recipe.pose

    shift = registered(values(moved(start_image(), *move)), pose)

    assert (shift.right_px, shift.down_px) == pytest.approx(move, abs=0.1)


@pytest.mark.parametrize("name", OBJECTS)
def test_moves_of_repainted_pictures_are_found(name: str) -> None:
    image = moved(repainted(name), 6, -3)

    shift = registered(values(image), made(name).recipe.pose)

    assert (shift.right_px, shift.down_px) == pytest.approx((6, -3), abs=0.15)


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize("size", [256, 512, 1100])
def test_pictures_in_their_place_stay_there(name: str, size: int) -> None:
    encoded = values(start_image(name, size))

    require_upright(encoded)

    assert registered(encoded, made(name, size).recipe.pose) == NO_SHIFT


@pytest.mark.parametrize("name", OBJECTS)
def test_painting_does_not_move_a_picture(name: str) -> None:
    image = repainted(name)
    data = io.BytesIO()
    image.save(data, "JPEG", quality=60)
    changed = (image, image.filter(ImageFilter.GaussianBlur(1)), Image.open(data))

    for one in changed:
        require_upright(values(one))
        assert registered(values(one), made(name).recipe.pose) == NO_SHIFT


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize("by", [0.97, 0.98, 0.99, 1.01, 1.02, 1.03])
def test_scaled_pictures_are_refused_with_the_scale(name: str, by: float) -> None:
    with pytest.raises(InputError, match=r"scaled by about") as caught:
        registered(values(scaled(start_image(name), by)), made(name).recipe.pose)

    percent = float(str(caught.value).split("about ")[1].split(" %")[0])
    assert percent == pytest.approx(100 * (by - 1), abs=0.4)


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize("by", [-3, -1, 1, 3])
def test_slightly_turned_pictures_are_refused(name: str, by: float) -> None:
    image = start_image(name).rotate(by, Image.Resampling.BICUBIC, fillcolor=FILL)

    with pytest.raises(InputError, match=r"control strip moved|outline of the object"):
        registered(values(image), made(name).recipe.pose)


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize(
    ("turn", "words"),
    [
        (Image.Transpose.FLIP_LEFT_RIGHT, "mirrored left to right: save"),
        (Image.Transpose.FLIP_TOP_BOTTOM, "mirrored top to bottom: save"),
        (Image.Transpose.ROTATE_90, "turned by 90 degrees: save"),
        (Image.Transpose.ROTATE_180, "turned by 180 degrees: save"),
        (Image.Transpose.ROTATE_270, "turned by 270 degrees: save"),
        (Image.Transpose.TRANSPOSE, "mirrored and turned"),
        (Image.Transpose.TRANSVERSE, "mirrored and turned"),
    ],
)
def test_mirrors_and_turns_are_named(
    name: str, turn: Image.Transpose, words: str
) -> None:
    with pytest.raises(InputError, match=words):
        require_upright(values(start_image(name).transpose(turn)))


@pytest.mark.parametrize("name", OBJECTS)
def test_other_pictures_are_refused(name: str) -> None:
    pose = made(name).recipe.pose
    noise = np.random.default_rng(1).random((512, 512, 3), dtype=np.float32)
    blank = np.full((512, 512, 3), 0.46, dtype=np.float32)
    others = [values(start_image(one)) for one in OBJECTS if one != name]

    for encoded in (noise, blank, *others):
        with pytest.raises(InputError, match=r"outline of the object|scaled by"):
            registered(encoded, pose)


def test_large_pictures_are_found_as_well() -> None:
    image = moved(start_image("sphere", 2048), 37, -12)

    shift = registered(values(image), made("sphere", 2048).recipe.pose)

    assert (shift.right_px, shift.down_px) == pytest.approx((37, -12), abs=0.1)
