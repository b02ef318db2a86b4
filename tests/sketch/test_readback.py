from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from paintlink.color import ciede2000
from paintlink.color.display import encode_srgb
from paintlink.errors import InputError
from paintlink.model import ColorSpec
from paintlink.sketch.fit import fit_painting
from paintlink.sketch.geometry import pixel_geometry
from paintlink.sketch.readback import Sketch, read_back
from paintlink.sketch.transfer import decode_srgb
from tests.sketch.easel import (
    BLUE,
    BROWN,
    GREEN,
    OBJECTS,
    chunk,
    made,
    painted,
    png16,
    start_image,
    stored,
    tiff16,
)
from tests.sketch.icc import (
    ADOBE_CURVE,
    ADOBE_PRIMARIES,
    P3_PRIMARIES,
    SRGB_CURVE,
    SRGB_PRIMARIES,
    matrix_profile,
    to_xyz_d50,
)

Convert = Callable[..., np.ndarray]
Primaries = tuple[tuple[float, float], ...]

ANGLES = (15.0, 45.0, 110.0)
ADOBE = matrix_profile(ADOBE_PRIMARIES, ADOBE_CURVE)
P3 = matrix_profile(P3_PRIMARIES, SRGB_CURVE)


def difference(sketch: Sketch, paint: ColorSpec = BLUE) -> np.ndarray:
    """CIEDE2000 of the fitted paint from the painted one at 15, 45, 110 degrees."""
    found = fit_painting(
        sketch.painting,
        sketch.geometry,
        sketch.start,
        exposure=sketch.recipe.exposure,
        angles_deg=ANGLES,
    )
    return ciede2000(found.spec().lab(), paint.lab())


def to_adobe(codes: np.ndarray, most: int = 255) -> np.ndarray:
    """The samples as a program stores them in Adobe RGB."""
    return np.rint(most * _linear_in(ADOBE_PRIMARIES, codes / most) ** (256 / 563))


def to_p3(codes: np.ndarray, most: int = 255) -> np.ndarray:
    """The samples as a program stores them in Display P3."""
    return np.rint(most * encode_srgb(_linear_in(P3_PRIMARIES, codes / most)))


def _linear_in(primaries: Primaries, encoded: np.ndarray) -> np.ndarray:
    matrix = np.linalg.solve(to_xyz_d50(primaries), to_xyz_d50(SRGB_PRIMARIES))
    return np.clip(decode_srgb(encoded) @ matrix.T, 0.0, 1.0)


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize("suffix", ["png", "tif"])
def test_painted_colour_comes_back(tmp_path: Path, name: str, suffix: str) -> None:
    path = stored(Image.fromarray(painted(name)), tmp_path / f"a.{suffix}")

    sketch = read_back(path, made(name).recipe)

    assert sketch.painting.notes == ()
    assert difference(sketch).max() < 0.15


@pytest.mark.parametrize("suffix", ["png", "tif"])
def test_sixteen_bit_paintings_come_back(tmp_path: Path, suffix: str) -> None:
    codes, path = painted("sphere", 512, 16), tmp_path / f"a.{suffix}"
    if suffix == "png":
        png16(codes, path)
    else:
        tiff16(codes, path, deflate=True)

    sketch = read_back(path, made("sphere", 512, 16).recipe)

    assert sketch.painting.bits == 16
    assert difference(sketch).max() < 0.03


def test_geometry_is_that_of_the_set_up(tmp_path: Path) -> None:
    path = stored(Image.fromarray(painted()), tmp_path / "a.png")

    sketch = read_back(path, made().recipe)

    exact = pixel_geometry(made().recipe.pose)
    np.testing.assert_array_equal(sketch.geometry.theta_deg, exact.theta_deg)
    start = np.asarray(start_image())
    np.testing.assert_array_equal(np.rint(255 * sketch.start), start)


def test_lossy_paintings_come_back(tmp_path: Path) -> None:
    image = Image.fromarray(painted())
    path = stored(image, tmp_path / "a.jpg", quality=90)

    sketch = read_back(path, made().recipe)

    assert len(sketch.painting.notes) == 1
    assert difference(sketch).max() < 1.0


@pytest.mark.parametrize("paint", [BROWN, GREEN], ids=["brown", "green"])
@pytest.mark.parametrize(
    ("convert", "profile"), [(to_adobe, ADOBE), (to_p3, P3)], ids=["adobe", "p3"]
)
def test_profiles_cost_little(
    tmp_path: Path, convert: Convert, profile: bytes, paint: ColorSpec
) -> None:
    image = Image.fromarray(convert(painted(paint=paint)).astype(np.uint8))
    path = stored(image, tmp_path / "a.png", icc_profile=profile)

    sketch = read_back(path, made().recipe)

    assert difference(sketch, paint).max() < 0.3
    assert len(sketch.painting.notes) == 1
    assert "converted from its profile" in sketch.painting.notes[0]


@pytest.mark.parametrize(
    ("convert", "profile"), [(to_adobe, ADOBE), (to_p3, P3)], ids=["adobe", "p3"]
)
def test_profiles_cost_nothing_at_sixteen_bits(
    tmp_path: Path, convert: Convert, profile: bytes
) -> None:
    codes = convert(painted("sphere", 512, 16), 65535)
    embedded = chunk(b"iCCP", b"a\0\0" + zlib.compress(profile))

    sketch = read_back(
        png16(codes, tmp_path / "a.png", embedded), made("sphere", 512, 16).recipe
    )

    assert difference(sketch).max() < 0.03


@pytest.mark.parametrize("convert", [to_adobe, to_p3])
def test_forgotten_profiles_are_noticed(tmp_path: Path, convert: Convert) -> None:
    image = Image.fromarray(convert(painted()).astype(np.uint8))
    path = stored(image, tmp_path / "a.png")

    notes = read_back(path, made().recipe).painting.notes

    assert len(notes) == 1
    assert "the whole picture was converted or corrected" in notes[0]


def test_brightened_pictures_are_noticed(tmp_path: Path) -> None:
    image = Image.fromarray(painted()).point(lambda code: min(255, code * 1.1))

    notes = read_back(stored(image, tmp_path / "a.png"), made().recipe).painting.notes

    assert "off by up to 2" in notes[0]


def test_covered_strip_is_noted(tmp_path: Path) -> None:
    codes = painted().copy()
    codes[480:] = 255

    path = stored(Image.fromarray(codes), tmp_path / "a.png")

    notes = read_back(path, made().recipe).painting.notes
    assert notes == (
        "the control strip was painted over: colour changes cannot be noticed",
    )


def test_moved_paintings_are_put_right(tmp_path: Path) -> None:
    canvas = Image.new("RGB", (512, 512), "white")
    canvas.paste(Image.fromarray(painted()), (9, -6))

    sketch = read_back(stored(canvas, tmp_path / "a.png"), made().recipe)

    assert "moved by +9.0 px to the right and -6.0 px down" in sketch.painting.notes[0]
    assert difference(sketch).max() < 0.2


@pytest.mark.parametrize("size", [384, 700])
def test_resampled_paintings_are_understood(tmp_path: Path, size: int) -> None:
    image = Image.fromarray(painted()).resize((size, size), Image.Resampling.LANCZOS)

    sketch = read_back(stored(image, tmp_path / "a.png"), made().recipe)

    assert f"{size} pixels wide instead of 512" in sketch.painting.notes[0]
    assert difference(sketch).max() < 0.3


def test_opacity_is_kept(tmp_path: Path) -> None:
    image = Image.fromarray(painted())
    image.putalpha(200)

    sketch = read_back(stored(image, tmp_path / "a.png"), made().recipe)

    assert sketch.painting.alpha is not None
    assert sketch.painting.alpha[3, 4] == pytest.approx(200 / 255)


@pytest.mark.parametrize("size", [(512, 500), (200, 200)])
def test_cropped_sizes_are_refused(tmp_path: Path, size: tuple[int, int]) -> None:
    path = stored(Image.new("RGB", size), tmp_path / "a.png")

    with pytest.raises(InputError, match=r"a\.png: .*start picture has 512 x 512"):
        read_back(path, made().recipe)


def test_cropped_paintings_are_refused(tmp_path: Path) -> None:
    image = Image.fromarray(painted()).crop((20, 20, 492, 492))

    with pytest.raises(InputError, match=r"a\.png: .*outline|scaled"):
        read_back(stored(image, tmp_path / "a.png"), made().recipe)
