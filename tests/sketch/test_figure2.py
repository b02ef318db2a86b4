from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

TOOL = runpy.run_path(
    str(Path(__file__).parents[2] / "tools" / "figure2_session.py"), run_name="figure2"
)


@pytest.fixture(scope="module")
def panel():
    return TOOL["geometry_of"]("panel")


def mean(session) -> float:
    return float(np.nanmean(session.fit.residual))


def test_painting_with_the_form_becomes_that_paint(panel):
    session = TOOL["replay"](panel)

    assert session.floor <= 2.0
    assert mean(session) <= min(session.floor + 1.5, 3.0)
    assert session.fit.floor.consistent


def test_straight_gradient_raises_the_warning(panel):
    session = TOOL["replay"](panel, straight=True)

    assert mean(session) <= session.floor + 1.5
    assert session.fit.notes[0].startswith("no paint looks like this")


def test_figure_is_drawn_small_enough_to_ship(panel, tmp_path):
    target = tmp_path / "images" / "figure2.png"

    TOOL["draw"](TOOL["replay"](panel), target)

    with Image.open(target) as image:
        assert image.width > 4 * 300
    assert target.stat().st_size < 200_000
