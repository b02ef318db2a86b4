from __future__ import annotations

import io
import subprocess
import sys
import warnings

import numpy as np
import pytest

from paintlink.design import plot
from paintlink.errors import ConfigError
from paintlink.model import ColorSpec, FloatArray
from tests.design.conftest import RED, RED_AT_FIVE, make_spec

pytest.importorskip("matplotlib", reason="curves are an optional extra")

NEAREST = make_spec(np.array(RED) * 0.9, "near")


def drawn(*specs: ColorSpec) -> FloatArray:
    """The picture as numbers, shape (height, width, 3)."""
    from PIL import Image

    with Image.open(io.BytesIO(plot(*specs))) as image:
        return np.asarray(image.convert("RGB"), dtype=np.float64)


def test_curves_show_all_three_colors() -> None:
    from matplotlib.colors import to_rgb

    pixels = drawn(make_spec(RED), make_spec(np.array(RED) * 1.1), NEAREST)

    for color in ("#9aa0a6", "#0b62a8", "#c05621"):
        distance = np.abs(pixels - 255.0 * np.array(to_rgb(color))).max(axis=-1)
        assert np.count_nonzero(distance < 2.0) > 300


def test_changed_design_changes_the_curves() -> None:
    first = plot(make_spec(RED), make_spec(RED), NEAREST)
    second = plot(make_spec(RED), make_spec(np.array(RED) * 1.05), NEAREST)

    assert first != second


def test_curves_of_five_angles_are_drawn_as_svg() -> None:
    five = make_spec(RED_AT_FIVE)

    svg = plot(five, five, make_spec(RED_AT_FIVE, "near"), format="svg")

    assert svg.startswith(b"<?xml")
    assert b"</svg>" in svg


def test_solid_without_travel_is_drawn_without_warning() -> None:
    solid = make_spec([(50.0, 0.0, 0.0)] * 3)

    with warnings.catch_warnings():
        warnings.simplefilter("error")

        assert plot(solid, solid, NEAREST)


def test_name_with_dollar_signs_is_no_formula() -> None:
    odd = make_spec(RED, r"$\frac$")

    assert plot(odd, odd, odd)


def test_missing_matplotlib_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)

    with pytest.raises(ConfigError, match=r"pip install 'paintlink\[plots\]'"):
        plot(make_spec(RED), make_spec(RED), NEAREST)


def test_designing_needs_no_matplotlib() -> None:
    code = "import sys, paintlink.design; print('matplotlib' in sys.modules)"

    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )

    assert done.stdout.strip() == "False"
