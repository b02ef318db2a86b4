"""What can go wrong between an instrument and its driver, as wrappers of a simulator.

Wrappers of wrappers are simulators again, so faults combine. States only the device
can show (not calibrated, another model) belong to the simulators themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from paintlink_simulators._simulator import Simulator
from paintlink_simulators.faults._answers import (
    Altered,
    drop_middle,
    duplicate,
    flip_bit,
    prefix_garbage,
    swallow,
    truncate,
)
from paintlink_simulators.faults._delivery import (
    Chunked,
    ClosedAfter,
    Echoing,
    Late,
    Onset,
)

Fault = Callable[[Simulator, int], Simulator]
"""From a simulator and a seed to the same simulator with the fault."""


def _altered(alter: Callable[[np.random.Generator], Callable[[bytes], bytes]]) -> Fault:
    return lambda simulator, seed: Altered(
        simulator, alter(np.random.default_rng(seed))
    )


FAULTS: Mapping[str, Fault] = MappingProxyType({
    "close_port": lambda simulator, _seed: ClosedAfter(simulator, 100),
    "drop_mid_frame": _altered(lambda _rng: drop_middle(5)),
    "duplicate_frame": _altered(lambda _rng: duplicate),
    "echo_on": lambda simulator, _seed: Echoing(simulator),
    "flip_bit": _altered(flip_bit),
    "garbage_prefix": _altered(lambda rng: prefix_garbage(rng, 8)),
    "late": lambda simulator, _seed: Late(simulator, 0.5),
    "one_byte_at_a_time": lambda simulator, _seed: Chunked(simulator, 1),
    "seven_bytes_at_a_time": lambda simulator, _seed: Chunked(simulator, 7),
    "silent": _altered(lambda _rng: swallow),
    "truncate": _altered(lambda _rng: truncate(7)),
})
"""Every fault by name. Harmless to a sound driver are ``echo_on``, ``late`` and the
two that only cut the answers into pieces; ``flip_bit`` is not always detectable where
the protocol has no checksum."""


def from_answer(answers: int, fault: Fault) -> Fault:
    """``fault`` that begins after the first ``answers`` answers."""
    return lambda simulator, seed: Onset(simulator, fault(simulator, seed), answers)


__all__ = [
    "FAULTS",
    "Altered",
    "Chunked",
    "ClosedAfter",
    "Echoing",
    "Fault",
    "Late",
    "Onset",
    "drop_middle",
    "duplicate",
    "flip_bit",
    "from_answer",
    "prefix_garbage",
    "swallow",
    "truncate",
]
