"""Many pictures in one process."""

from __future__ import annotations

import gc
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from paintlink.preview import render
from tests.preview.test_gl import resident_kib
from tests.preview.truth import GREY, PEARL, RED, SILVER

pytestmark = [
    pytest.mark.proof,
    pytest.mark.timeout(600),
    pytest.mark.usefixtures("coarse_bake"),
]

PAINTS = (RED, SILVER, PEARL, GREY)


@pytest.mark.parametrize("backend", ["cpu", "gl"])
def test_twenty_thousand_pictures_by_four_threads_need_no_more_memory(
    backend: str,
) -> None:
    def draw(number: int) -> int:
        picture = render(
            [PAINTS[number % 4]], object="sphere", size=32, backend=backend
        )
        return int(picture.rgb.sum())

    expected = [draw(number) for number in range(4)]
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(draw, range(4000)))
        gc.collect()
        early = resident_kib()
        sums = np.fromiter(pool.map(draw, range(16_000)), int)

    gc.collect()
    assert resident_kib() - early < 16 * 1024
    for number in range(4):
        assert set(sums[number::4]) == {expected[number]}
