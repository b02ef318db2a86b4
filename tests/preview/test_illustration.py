from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.preview import Illustration, Picture, render
from tests.preview.truth import SILVER

pytestmark = pytest.mark.usefixtures("coarse_bake")


def drawn(**layers: float) -> Picture:
    return render(
        [SILVER],
        object="sphere",
        size=128,
        backend="cpu",
        illustration=Illustration(**layers),
    )


@pytest.mark.parametrize("layer", ["orange_peel", "sparkle", "graininess"])
def test_layer_is_seen_only_when_asked_for_and_labelled(layer: str) -> None:
    plain, with_layer = drawn(), drawn(**{layer: 1.0})

    inside = np.abs(with_layer.rgb.astype(int) - plain.rgb)[30:90, 40:90]
    assert inside.mean() > 0.5
    words = f"{layer.replace('_', ' ')} is an illustration, not measured"
    assert words in with_layer.notes
    assert not any("illustration" in note for note in plain.notes)


@pytest.mark.parametrize("layer", ["sparkle", "graininess"])
def test_layers_keep_the_mean_colour(layer: str) -> None:
    plain, with_layer = drawn(), drawn(**{layer: 0.5})

    assert abs(with_layer.rgb.mean() - plain.rgb.mean()) < 3


def test_layers_are_the_same_in_every_picture() -> None:
    first, again = drawn(sparkle=0.5).rgb, drawn(sparkle=0.5).rgb

    np.testing.assert_array_equal(first, again)


@pytest.mark.parametrize("value", [-0.1, 1.1, float("nan")])
def test_strength_beyond_its_range_is_refused(value: float) -> None:
    with pytest.raises(PreviewError, match="sparkle runs from 0"):
        Illustration(sparkle=value)
