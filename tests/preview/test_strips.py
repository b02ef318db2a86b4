from __future__ import annotations

import numpy as np
import pytest

from paintlink.preview.strips import Strips, split


def strips(*edges: int) -> Strips:
    return Strips(np.zeros((len(edges) - 1, 12, 3), dtype=np.float32), edges)


def test_strips_share_the_object_not_the_picture() -> None:
    assert split((-0.5, 0.5), 4, 400) == (0, 150, 200, 250, 400)
    assert split((-0.5, 0.5), 1, 400) == (0, 400)


@pytest.mark.parametrize("width", [16, 512, 4096])
def test_seam_is_as_wide_as_it_says(width: int) -> None:
    pair = strips(0, width // 2, width)

    missing = (1 - pair.between_seams()).sum()

    assert missing == pytest.approx(2 * pair.half_seam, abs=0.01)
    assert missing == pytest.approx(max(1, width / 200), abs=0.01)


def test_one_paint_has_no_seam() -> None:
    assert (strips(0, 64).between_seams() == 1).all()
