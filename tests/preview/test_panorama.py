from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.preview import environment, panorama, render, rgbe
from tests.preview.truth import GREY

HEADER = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"


def encoded(texels: np.ndarray) -> np.ndarray:
    """Bytes with a shared exponent, shape (h, w, 4)."""
    mantissa, exponent = np.frexp(texels.max(axis=2))
    scale = np.where(texels.max(axis=2) > 0, mantissa * 256 / texels.max(axis=2), 0)
    rgb = texels * scale[..., None]
    return np.dstack([rgb, exponent + 128]).astype(np.uint8)


def write_hdr(path: Path, texels: np.ndarray, *, runs: bool = False) -> None:
    height, width, _ = texels.shape
    data = encoded(texels)
    body = data.tobytes()
    if runs:
        body = b"".join(_row(row) for row in data)
    path.write_bytes(HEADER + b"-Y %d +X %d\n" % (height, width) + body)


def _row(row: np.ndarray) -> bytes:
    packed = [bytes([2, 2, len(row) >> 8, len(row) & 255])]
    for component in row.T:
        if (component == component[0]).all() and len(row) < 128:
            packed.append(bytes([128 + len(row), component[0]]))
        else:
            parts = [component[i : i + 128] for i in range(0, len(row), 128)]
            packed.extend(bytes([len(p)]) + p.tobytes() for p in parts)
    return b"".join(packed)


def gradient() -> np.ndarray:
    height, width = 32, 64
    level = np.linspace(0.2, 3.0, width)[None, :, None] * np.ones((height, 1, 3))
    level[..., 2] *= np.linspace(2, 1, height)[:, None]
    return level


@pytest.mark.parametrize("runs", [False, True])
def test_radiance_picture_is_read_to_its_precision(tmp_path: Path, runs: bool) -> None:
    path = tmp_path / "light.hdr"
    write_hdr(path, gradient(), runs=runs)

    np.testing.assert_allclose(rgbe.read(path), gradient(), rtol=0.02)


def test_long_runs_are_unpacked(tmp_path: Path) -> None:
    path = tmp_path / "light.hdr"
    flat = np.full((16, 32, 3), 0.5)
    write_hdr(path, flat, runs=True)

    np.testing.assert_allclose(rgbe.read(path), flat)


def test_openexr_picture_is_read(tmp_path: Path) -> None:
    openexr = pytest.importorskip("OpenEXR")
    path = tmp_path / "light.exr"
    texels = gradient().astype(np.float32)
    header = {"compression": openexr.ZIP_COMPRESSION, "type": openexr.scanlineimage}
    with openexr.File(header, {"RGB": openexr.Channel("RGB", texels)}) as file:
        file.write(str(path))

    np.testing.assert_allclose(panorama.load(path), texels, rtol=1e-3)


def test_our_own_light_as_a_file_gives_the_same_picture(tmp_path: Path) -> None:
    path = tmp_path / "overcast.hdr"
    write_hdr(path, environment.load("overcast").grid.astype(float))

    ours, file = (
        render([GREY], object="sphere", light=light, size=64, backend="cpu").rgb
        for light in ("overcast", str(path))
    )

    assert np.abs(ours.astype(int) - file).max() <= 3


def test_panorama_lights_from_where_it_is_bright(tmp_path: Path) -> None:
    texels = np.full((32, 64, 3), 0.05)
    texels[10:14, 46:50] = 40.0
    path = tmp_path / "lamp.hdr"
    write_hdr(path, texels)

    rgb = render([GREY], object="sphere", light=str(path), size=64, backend="cpu").rgb

    left, right = rgb[20, 14].mean(), rgb[20, 50].mean()
    assert right > left + 40


def test_large_panorama_is_reduced_with_its_light(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(panorama, "WORKING_SIZE", (16, 32))
    path = tmp_path / "light.hdr"
    write_hdr(path, gradient())

    reduced = panorama.load(path)

    assert reduced.shape == (16, 32, 3)
    assert reduced.mean() == pytest.approx(gradient().mean(), rel=0.02)


def test_changed_file_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "light.hdr"
    write_hdr(path, gradient())
    first = environment.load(str(path)).digest
    write_hdr(path, gradient()[::-1])

    assert environment.load(str(path)).digest != first


BAD = {
    "empty": (b"", "does not begin as a Radiance picture"),
    "text": (b"hello" * 99, "does not begin as a Radiance picture"),
    "xyze": (b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 4 +X 8\n", "not in the format"),
    "turned": (HEADER + b"+X 8 -Y 4\n" + bytes(128), "resolution line is not"),
    "endless": (HEADER + b"-Y 999999 +X 999999\n", "none or too many"),
    "nothing": (HEADER + b"-Y 0 +X 0\n", "none or too many"),
    "short": (HEADER + b"-Y 16 +X 32\n" + bytes(99), "cut short"),
    "short row": (HEADER + b"-Y 4 +X 8\n\2\2\0\10\210", "damaged|cut short"),
    "long run": (HEADER + b"-Y 4 +X 8\n\2\2\0\10\377\1", "damaged"),
    "no run": (HEADER + b"-Y 4 +X 8\n\2\2\0\10\0\1", "damaged"),
    "square": (HEADER + b"-Y 8 +X 8\n" + bytes([9, 9, 9, 128] * 64), "twice as wide"),
    "black": (HEADER + b"-Y 4 +X 8\n" + bytes(128), "black everywhere"),
    "glaring": (HEADER + b"-Y 4 +X 8\n" + b"\377" * 128, "light that is not a number"),
}


@pytest.mark.parametrize("name", BAD)
def test_malformed_panorama_is_refused(tmp_path: Path, name: str) -> None:
    content, words = BAD[name]
    path = tmp_path / "bad.hdr"
    path.write_bytes(content)

    with pytest.raises(PreviewError, match=words):
        render([GREY], light=str(path), backend="cpu")


def test_malformed_openexr_picture_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("OpenEXR")
    path = tmp_path / "bad.exr"
    path.write_bytes(b"v/1\x01" + bytes(200))

    with pytest.raises(PreviewError, match="is no panorama that can be read"):
        render([GREY], light=str(path), backend="cpu")


def test_missing_panorama_is_named(tmp_path: Path) -> None:
    with pytest.raises(PreviewError, match=r"cannot read the light .*none.hdr: No"):
        render([GREY], light=str(tmp_path / "none.hdr"))


def test_huge_panorama_is_not_even_opened(tmp_path: Path) -> None:
    path = tmp_path / "huge.hdr"
    with path.open("wb") as file:
        file.truncate(panorama.MOST_BYTES + 1)

    with pytest.raises(PreviewError, match="512 MiB, more than 512"):
        render([GREY], light=str(path))
