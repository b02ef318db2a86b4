from __future__ import annotations

import pytest

from paintlink.model import Gloss
from paintlink.preview import gloss as gloss_table
from paintlink.preview.gloss import assumption, roughness_of


@pytest.mark.parametrize(
    ("gloss", "roughness"),
    [
        (None, 0.002),
        (Gloss(95.0, 60.0), 0.002),
        (Gloss(78.8, 60.0), 0.01),
        (Gloss(78.8), 0.01),
        (Gloss(43.5, 20.0), 0.01),
        (Gloss(84.9, 85.0), 0.01),
        (Gloss(84.9, 75.0), 0.01),
        (Gloss(13.6, 60.0), 0.1),
        (Gloss(0.0, 60.0), 0.5),
    ],
)
def test_gloss_is_read_at_its_own_angle(gloss: Gloss | None, roughness: float) -> None:
    assert roughness_of(gloss) == roughness


@pytest.mark.parametrize(
    ("gloss", "words"),
    [
        (None, "gloss not measured, 90 GU at 60° assumed"),
        (Gloss(80.0), "angle of the gloss not known, 60° assumed"),
        (Gloss(80.0, 75.0), "gloss at 75° taken as gloss at 85°"),
        (Gloss(80.0, 20.0), ""),
    ],
)
def test_assumptions_about_gloss_are_said(gloss: Gloss | None, words: str) -> None:
    assert assumption(gloss) == words


def test_every_roughness_has_its_gloss_at_every_angle() -> None:
    for angle, values in gloss_table.GLOSS_GU.items():
        assert len(values) == len(gloss_table.ROUGHNESS)
        for value, roughness in zip(values, gloss_table.ROUGHNESS, strict=True):
            assert roughness_of(Gloss(value, angle)) == roughness
