"""Long chains of wild steps: always valid, always the same."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.color import flop_index
from paintlink.design import STEPS, Design, State, Step, from_json, make_step, to_json
from paintlink.design.ends import SetFlopIndex, SetSample
from paintlink.design.limits import room, with_possible_chroma
from paintlink.design.parameters import (
    Choice,
    Color,
    Kind,
    Number,
    Paint,
    parameters,
)
from tests.design.conftest import make_design, make_spec

CHAINS = 2000
LONGEST = 15


def test_2000_random_chains_stay_valid_and_replay() -> None:
    rng = np.random.default_rng(20240611)
    made = 0

    for _ in range(CHAINS):
        design = random_design(rng)
        made += len(design.steps)

        states = [design.start.state, *(one.state for one in design.history())]
        assert min(room(state.lab).min() for state in states) >= -1e-6
        assert_replays(design)

    assert made > 10_000


def test_undo_restores_every_bit() -> None:
    rng = np.random.default_rng(7)

    for _ in range(100):
        design = random_design(rng)
        bits = [design.start.state.lab.tobytes()]
        bits += [one.state.lab.tobytes() for one in design.history()]
        for count in range(1, len(design.steps) + 1):
            shorter = design.undo(count)
            assert shorter.state.lab.tobytes() == bits[-1 - count]
            assert shorter.redo(count) == design


def assert_replays(design: Design) -> None:
    again = from_json(to_json(design))
    assert again == design
    assert again.state.lab.tobytes() == design.state.lab.tobytes()
    # The result is an ordinary specification: its constructor refuses others.
    assert design.spec.lab().tobytes() == (design.state.lab + 0.0).tobytes()


def random_design(rng: np.random.Generator) -> Design:
    design = make_design(random_paint(rng, int(rng.choice([3, 5]))))
    state, steps = design.start.state, []
    for _ in range(rng.integers(1, LONGEST + 1)):
        step = random_step(rng, design)
        if is_refused(step, state):
            continue
        state = step.applied(state).state
        steps.append(step)
    return replace(design, steps=tuple(steps))


def is_refused(step: Step, state: State) -> bool:
    """Whether the colour lacks what the step needs: travel in L, or that angle."""
    if isinstance(step, SetFlopIndex):
        return not flop_index([state.face, state.middle, state.flop])
    return isinstance(step, SetSample) and step.angle_deg not in state.angles_deg


def random_paint(rng: np.random.Generator, count: int) -> np.ndarray:
    lab = rng.uniform((0, -120, -120), (150, 120, 120), (count, 3))
    return np.array([with_possible_chroma(row)[0] for row in lab])


def random_step(rng: np.random.Generator, design: Design) -> Step:
    name = str(rng.choice(list(STEPS)))
    values = {
        key: random_value(rng, parameter.kind)
        for key, parameter in parameters(STEPS[name]).items()
        if parameter.required or rng.random() < 0.7
    }
    if name.startswith("set-") and "L" in parameters(STEPS[name]):
        values.setdefault("L", 40.0)
    if name == "set-sample" and rng.random() < 0.9:
        values["angle_deg"] = float(rng.choice(design.start.spec.angles_deg))
    return make_step(name, values)


def random_value(rng: np.random.Generator, kind: Kind) -> object:
    if isinstance(kind, Number):
        low = np.nextafter(kind.low, np.inf) if kind.open else kind.low
        inside = rng.uniform(low, kind.high)
        return float(rng.choice([inside, inside, inside, low, kind.high]))
    if isinstance(kind, Choice):
        return str(rng.choice(kind.options))
    if isinstance(kind, Color):
        return random_paint(rng, 1)[0].tolist()
    if isinstance(kind, Paint):
        return make_spec(random_paint(rng, int(rng.choice([3, 5]))))
    pytest.fail(f"no random value for {kind}")
