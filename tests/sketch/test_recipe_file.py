from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.errors import SpecError
from paintlink.sketch.pose import Light, Pose
from paintlink.sketch.recipe import Recipe
from paintlink.sketch.recipe_file import read_recipe, read_recipe_file, write_recipe
from tests.sketch.easel import BLUE, OBJECTS, made

Change = Callable[[dict[str, Any]], object]


@settings(deadline=None)
@given(
    name=st.sampled_from(OBJECTS),
    polar=st.floats(0.0, 85.0),
    azimuth=st.floats(-360.0, 360.0),
    distance=st.none() | st.floats(2.0, 1e6),
    size=st.integers(256, 4096),
    exposure=st.floats(0.001, 1.0),
    bits=st.sampled_from([8, 16]),
)
def test_recipes_come_back_to_the_bit(
    name: str,
    polar: float,
    azimuth: float,
    distance: float | None,
    size: int,
    exposure: float,
    bits: int,
) -> None:
    light = Light(polar, azimuth)
    if distance:
        light = Light(polar, azimuth, "point", distance)
    pose = Pose(name, light, size)
    recipe = Recipe(pose, BLUE, "id", exposure, bits, "0" * 64, "f" * 64)

    assert read_recipe(write_recipe(recipe)) == recipe


def changed(change: Change) -> bytes:
    document = json.loads(made(size=256).files["recipe.json"])
    change(document)
    return json.dumps(document).encode()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda d: d.update(version=2), "newer paintlink .version 2.*update paintlink"),
        (lambda d: d.update(version=0), "<version>: Input should be 1"),
        (lambda d: d.update(format="png"), "<format>: not the recipe of a sketch"),
        (lambda d: d.update(object="car"), "no sketch object 'car'"),
        (lambda d: d.update(size="512"), "<size>: Input should be a valid integer"),
        (lambda d: d.update(size=7), "256 to 4096 pixels wide, not 7"),
        (lambda d: d.update(exposure=0.0), "exposure lies between 0 and 1, not at 0"),
        (lambda d: d.update(exposure=float("nan")), "<exposure>: .*finite"),
        (lambda d: d.update(bits=12), "8 or 16 bits a channel, not 12"),
        (lambda d: d.update(extra=1), "<extra>: Extra inputs are not permitted"),
        (lambda d: d.pop("light"), "<light>: Field required"),
        (lambda d: d["light"].update(kind="sun"), "<light.kind>: Input should be"),
        (
            lambda d: d["light"].update(polar_deg=90.0),
            "not 90: set the sketch up again",
        ),
        (lambda d: d["start"].update(samples=[]), "needs Lab at 3, 5 or 6"),
        (
            lambda d: d["sha256"].update(start="x"),
            "<sha256.start>: String should match",
        ),
        (lambda d: d.update(theta_scale_deg=90), "<theta_scale_deg>"),
    ],
)
def test_altered_recipes_are_refused_by_field(change: Change, words: str) -> None:
    with pytest.raises(SpecError, match=words):
        read_recipe(changed(change))


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "not a JSON document"),
        (b"[]", "not the recipe of a sketch"),
        (b"\xff\xfe", "not a JSON document"),
        (b"[" * 100_000, "not a JSON document"),
        (b" " * 300_000, "larger than 262144 bytes"),
    ],
)
def test_other_documents_are_refused(data: bytes, words: str) -> None:
    with pytest.raises(SpecError, match=words):
        read_recipe(data)


def test_missing_recipe_names_the_file(tmp_path: Path) -> None:
    with pytest.raises(SpecError, match=r"gone\.json: cannot be read .*recipe\.json"):
        read_recipe_file(tmp_path / "gone.json")
