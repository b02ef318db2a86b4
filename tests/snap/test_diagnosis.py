"""The paper's three problematic designs, and what must not be called a problem."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from paintlink.library import bundled, find
from paintlink.model import FloatArray
from paintlink.snap import Finding, Limits, diagnose, nearest, sentences
from paintlink.snap.diagnosis import Kind
from paintlink.snap.hull import outside
from tests.snap.conftest import STANDARD, make_table, make_target

CASES: set[Kind] = {"too-chromatic", "off-radial", "face-and-flop"}


def paint(code: str) -> FloatArray:
    table = bundled()
    columns = [table.angles_deg.index(angle) for angle in STANDARD]
    return table.lab[find(table, code), columns].copy()


def turned(lab: FloatArray, degrees: Sequence[float]) -> FloatArray:
    turn = np.radians(degrees)
    a, b = lab[:, 1].copy(), lab[:, 2].copy()
    lab[:, 1] = a * np.cos(turn) - b * np.sin(turn)
    lab[:, 2] = a * np.sin(turn) + b * np.cos(turn)
    return lab


def findings(lab: FloatArray, limits: Limits | None = None) -> dict[Kind, Finding]:
    table, spec = bundled(), make_target(lab)
    found = diagnose(spec, nearest(spec, table), table, limits)
    return {finding.kind: finding for finding in found}


def told(lab: FloatArray) -> set[Kind]:
    return {kind for kind, finding in findings(lab).items() if finding.told}


def test_figure_12_is_too_chromatic() -> None:
    design = paint("RM209") * (1.0, 1.35, 1.35)

    found = findings(design)

    assert found["too-chromatic"].told
    assert found["outside"].told
    assert found["too-chromatic"].sentence.startswith("the colour is too chromatic: RM")
    assert "has the hue, but lacks" in found["too-chromatic"].sentence
    assert not told(design) & {"off-radial", "face-and-flop"}


def test_figure_13_travels_off_the_radial_line() -> None:
    design = turned(paint("RM331"), (0.0, 25.0, 50.0))

    found = findings(design)

    assert found["off-radial"].told
    assert "the hue shifts off the radial line: +" in found["off-radial"].sentence
    assert "cannot follow" in found["off-radial"].sentence
    assert not found["too-chromatic"].told


def test_figure_14_has_a_brighter_face_and_a_darker_flop() -> None:
    design = paint("RM331")
    design[:, 0] += (6.0, 0.0, -5.0)

    found = findings(design)

    assert found["face-and-flop"].told
    assert found["face-and-flop"].value == pytest.approx(11.0)
    assert found["face-and-flop"].sentence == (
        "the face is 6.0 brighter and the flop 5.0 darker than RM331"
    )
    assert not told(design) & {"off-radial", "too-chromatic", "outside"}


def test_readings_of_known_paints_are_not_diagnosed() -> None:
    rng = np.random.default_rng(14)
    table = bundled()
    columns = [table.angles_deg.index(angle) for angle in STANDARD]
    rows = rng.choice(len(table), 500, replace=False)
    readings = table.lab[rows][:, columns] + rng.normal(0.0, 0.06, (500, 3, 3))

    told_of = [told(reading) for reading in readings]

    assert sum(not kinds & CASES for kinds in told_of) >= 485
    assert sum(not kinds for kinds in told_of) >= 485


def test_finish_is_doubted_even_where_the_total_is_small() -> None:
    flat = np.array([[52.0, 0.0, 0.0], [50.0, 0.0, 0.0], [48.0, 0.0, 0.0]])
    table = make_table([flat])
    spec = make_target(flat + np.outer((1.5, 0.0, -1.5), (1.0, 0.0, 0.0)))

    (match,) = nearest(spec, table)
    strict = Limits(flop_index=0.3)
    finding = {f.kind: f for f in diagnose(spec, [match], table, strict)}["finish"]

    assert match.mean < 1.5
    assert finding.told
    assert "it flops more than C0 (Flop Index 0.8 against 0.4)" in finding.sentence


def test_very_dark_paints_get_no_verdict_on_their_finish() -> None:
    dark = np.array([[4.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.0, 0.0]])
    spec = make_target(dark + np.outer((3.0, 0.0, 0.0), (1.0, 0.0, 0.0)))

    found = diagnose(spec, nearest(spec, make_table([dark])), make_table([dark]))

    assert "finish" not in {finding.kind for finding in found}


def test_neutral_faces_have_no_radial_line() -> None:
    grey = np.array([[60.0, 0.5, 0.2], [50.0, 0.0, 0.0], [40.0, 3.0, 9.0]])
    spec = make_target(grey)

    found = diagnose(spec, nearest(spec, make_table([grey])), make_table([grey]))

    assert "off-radial" not in {finding.kind for finding in found}


def test_limits_decide_what_is_told() -> None:
    design = paint("RM331")
    design[:, 0] += (6.0, 0.0, -5.0)
    generous = replace(Limits(), face_and_flop=20.0)

    assert not findings(design, generous)["face-and-flop"].told


def test_farthest_beyond_its_limit_is_told_first() -> None:
    design = paint("RM209") * (1.0, 1.35, 1.35)
    table, spec = bundled(), make_target(design)
    found = diagnose(spec, nearest(spec, table), table)
    beyond = {one.sentence: one.value / one.limit for one in found if one.told}

    told_in_order = sentences(found)

    assert len(told_in_order) == len(beyond) >= 2
    ratios = [beyond[sentence] for sentence in told_in_order]
    assert ratios == sorted(ratios, reverse=True)


@pytest.mark.parametrize("distance", [0.5, 3.0, 40.0])
def test_distance_beyond_a_ball_is_met(distance: float) -> None:
    rng = np.random.default_rng(1)
    on_ball = rng.normal(size=(20_000, 3))
    on_ball = 30.0 * on_ball / np.linalg.norm(on_ball, axis=1)[:, np.newaxis]
    table = make_table(
        np.repeat((on_ball + np.array([50, 0, 0]))[:, np.newaxis], 3, axis=1)
    )
    way = np.array([0.48, -0.6, 0.64])

    found = outside(table, 45.0, np.array([50.0, 0.0, 0.0]) + way * (30.0 + distance))

    assert found == pytest.approx(distance, abs=0.02)


def test_colours_between_paints_are_not_outside() -> None:
    rng = np.random.default_rng(2)
    lab = rng.uniform(-20.0, 20.0, (50, 3, 3)) + np.array([50.0, 0.0, 0.0])
    table = make_table(lab)
    weights = rng.dirichlet(np.ones(50), 100)

    for mixed in weights @ lab[:, 1]:
        assert outside(table, 45.0, mixed) == 0.0


def test_distance_to_the_hull_is_that_of_an_independent_solver() -> None:
    from scipy.optimize import nnls

    rng = np.random.default_rng(3)
    lab = rng.normal(0.0, 20.0, (40, 3, 3))
    for _ in range(60):
        target = rng.normal(0.0, 45.0, 3)
        corners = np.vstack([lab[:, 1].T, np.full(40, 1e4)])
        weights, _ = nnls(corners, np.append(target, 1e4))
        nearest_point = weights @ lab[:, 1] / weights.sum()

        found = outside(make_table(lab), 45.0, target)

        expected = np.linalg.norm(nearest_point - target)
        assert found == pytest.approx(expected, abs=1e-3)
