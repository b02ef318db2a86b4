"""Files of more than eight bits, and what is said of a picture."""

from __future__ import annotations

import io
import json
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.preview import backends, facts, render, to_exr, to_png
from tests.preview.truth import GREY, RED, SILVER, paint

pytestmark = pytest.mark.usefixtures("coarse_bake")


def drawn(*specs: object, linear: bool = True) -> object:
    return render(specs or [SILVER], object="sphere", size=32, linear=linear)


def pixels(png: bytes) -> np.ndarray:
    """Samples of an unfiltered or up-filtered 16-bit PNG, read by hand."""
    width, height, bits = struct.unpack(">IIB", png[16:25])
    start = png.index(b"IDAT") + 4
    length = struct.unpack(">I", png[start - 8 : start - 4])[0]
    rows = np.frombuffer(zlib.decompress(png[start : start + length]), np.uint8)
    rows = rows.reshape(height, -1)
    assert (bits, set(rows[:, 0])) == (16, {2})
    samples = np.cumsum(rows[:, 1:], axis=0, dtype=np.uint8)
    return np.ascontiguousarray(samples).view(">u2").reshape(height, width, 3)


def test_sixteen_bits_round_to_the_eight() -> None:
    picture = drawn()

    deep = pixels(to_png(picture, deep=True)) / 257.0

    assert np.abs(deep - picture.rgb).max() < 1.1


def test_openexr_keeps_what_a_screen_cannot_show(tmp_path: Path) -> None:
    openexr = pytest.importorskip("OpenEXR")
    vivid = paint((140, -110, 60), (60, -100, 60), (45, -90, 60))
    picture = drawn(vivid)
    path = tmp_path / "picture.exr"
    path.write_bytes(to_exr(picture))

    with openexr.File(str(path)) as file:
        light = file.channels()["RGB"].pixels.astype(float)
        comments = str(file.header()["comments"])

    np.testing.assert_allclose(light, picture.linear, rtol=2e-3, atol=1e-3)
    assert light.max() > 1 > 0 > light.min()
    assert "not for visual matching" in comments


def test_deep_file_of_an_eight_bit_picture_is_refused() -> None:
    with pytest.raises(PreviewError, match="keeps 8 bits only: draw it with linear"):
        to_png(drawn(linear=False), deep=True)


def test_gamut_is_reported_alike_by_both_renderers(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(backends, "SOFTWARE", ())  # OpenGL, whoever computes it
    vivid = paint((140, -110, 60), (60, -100, 60), (45, -90, 60))
    shares = []
    for backend in ("auto", "cpu"):
        picture = render([vivid], object="sphere", size=96, backend=backend)
        shares.append((picture.too_chromatic, picture.too_bright))

    np.testing.assert_allclose(shares[0], shares[1], atol=0.002)
    assert shares[0][0] > 0.3
    assert render([GREY], object="sphere", size=48).too_chromatic == 0


def test_facts_are_json_and_name_the_paint() -> None:
    document = json.loads(json.dumps(facts(drawn(RED))))

    assert document["paints"][0]["name"] == RED.name
    assert document["object"] == "sphere"
    assert document["notes"][-1] == "not for visual matching"


def test_png_with_cicp_opens_everywhere() -> None:
    from PIL import Image

    with Image.open(io.BytesIO(to_png(drawn()))) as image:
        image.load()
        assert image.size == (32, 32)
