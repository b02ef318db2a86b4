from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from paintlink.errors import PreviewError
from paintlink.preview import Turntable, render, to_webp, turn, turntable
from tests.preview.truth import RED, SILVER

pytestmark = pytest.mark.usefixtures("coarse_bake")
TABLE = Turntable(size=64, frames=4)


def test_frame_looks_like_the_picture_at_that_angle() -> None:
    pictures = list(turn(SILVER, TABLE))

    for number, picture in enumerate(pictures):
        still = render(
            [SILVER], object="car", size=64, backend="cpu", turn_deg=90 * number
        )
        difference = np.abs(picture.astype(int) - still.rgb)
        assert difference.mean() < 0.8
        assert np.percentile(difference, 99) < 25


def test_frames_are_prepared_once_for_all_paints(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    first = list(turn(RED, TABLE))
    monkeypatch.setattr(turntable, "form", None)
    prepared = [turntable.frame(TABLE, number) for number in range(4)]

    assert len(first) == len(prepared)


def test_animation_holds_every_frame_and_never_ends() -> None:
    pictures = list(turn(RED, TABLE))

    with Image.open(io.BytesIO(to_webp(pictures, seconds=2))) as image:
        assert (image.format, image.n_frames) == ("WEBP", 4)
        assert image.info["loop"] == 0
        image.seek(1)
        shown = np.asarray(image.convert("RGB")).astype(int)
    assert np.abs(shown - pictures[1]).mean() < 6


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"frames": 1}, "2 to 360 frames, not 1"),
        ({"frames": 361}, "2 to 360 frames, not 361"),
        ({"size": 2048}, "16 to 1024 pixels, not 2048"),
    ],
)
def test_absurd_turntables_are_refused(asked: dict[str, int], words: str) -> None:
    with pytest.raises(PreviewError, match=words):
        Turntable(**asked)


def test_relief_cannot_turn() -> None:
    with pytest.raises(PreviewError, match="the panel has no back"):
        list(turn(RED, Turntable(object="panel", size=32, frames=2)))
