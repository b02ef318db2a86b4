"""What can go wrong between an instrument and its driver, as wrappers of a simulator.

Wrappers of wrappers are simulators again, so faults combine. States only the device can
show are options of the simulators (`STATES`); unplugging belongs to the ports.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from paintlink_simulators._simulator import Simulator
from paintlink_simulators.faults._answers import (
    After,
    Altered,
    Swapped,
    drop_first,
    drop_middle,
    duplicate,
    flip_bit,
    insert,
    lose_runs,
    prefix,
    prefix_garbage,
    splice,
    stale_first,
    swallow,
    truncate,
    wrong_last_byte,
)
from paintlink_simulators.faults._delivery import (
    Chunked,
    ClosedAfter,
    DeafAtFirst,
    Echoing,
    Late,
    Onset,
    Recurring,
    WrongBaud,
)
from paintlink_simulators.faults._mutations import MUTATIONS, Mutating

Fault = Callable[[Simulator, int], Simulator]
"""From a simulator and a seed to the same simulator with the fault."""

EVERY_BYTE = bytes(range(256))
XON_XOFF = (0x11, 0x13)


def _altered(alter: Callable[[np.random.Generator], Callable[[bytes], bytes]]) -> Fault:
    return lambda simulator, seed: Altered(
        simulator, alter(np.random.default_rng(seed))
    )


FAULTS: Mapping[str, Fault] = MappingProxyType({
    "bad_checksum": _altered(lambda _rng: wrong_last_byte),
    "close_port": lambda simulator, _seed: ClosedAfter(simulator, 100),
    "drop_first_byte": _altered(lambda _rng: drop_first),
    "drop_mid_frame": _altered(lambda _rng: drop_middle(5)),
    "duplicate_frame": _altered(lambda _rng: duplicate),
    "echo_on": lambda simulator, _seed: Echoing(simulator),
    "every_byte_first": _altered(lambda _rng: prefix(EVERY_BYTE)),
    "first_command_lost": lambda simulator, _seed: DeafAtFirst(simulator),
    "flip_bit": _altered(flip_bit),
    "garbage_prefix": _altered(lambda rng: prefix_garbage(rng, 8)),
    "insert_byte": _altered(lambda rng: insert(rng, EVERY_BYTE)),
    "late": lambda simulator, _seed: Late(simulator, 0.5),
    "never_ends": lambda simulator, _seed: Recurring(
        simulator, 0.01, lambda _: b"A" * 10, alone=True
    ),
    "nul_flood": _altered(lambda _rng: prefix(bytes(1000))),
    "one_byte_at_a_time": lambda simulator, _seed: Chunked(simulator, 1),
    "out_of_order": lambda simulator, _seed: Swapped(simulator),
    "seven_bytes_at_a_time": lambda simulator, _seed: Chunked(simulator, 7),
    "silent": _altered(lambda _rng: swallow),
    "splice": lambda simulator, _seed: After(simulator, splice),
    "stale_frame": lambda simulator, _seed: After(simulator, stale_first),
    "stuck_button": lambda simulator, _seed: Recurring(
        simulator, 0.02, lambda instrument: instrument.press()
    ),
    "truncate": _altered(lambda _rng: truncate(7)),
    "two_clients": _altered(lambda rng: lose_runs(rng, 20)),
    "wrong_baud": lambda simulator, _seed: WrongBaud(simulator, 9600.0, 19200.0),
    "xon_xoff": _altered(lambda rng: insert(rng, XON_XOFF)),
})
"""Every fault of the line by name."""

STATES: Mapping[str, Mapping[str, object]] = MappingProxyType({
    "lab_out_of_range": {"defect": "impossible"},
    "lamp_warming": {"condition": "warming"},
    "low_battery": {"condition": "battery_low"},
    "memory_full": {"condition": "memory_full"},
    "nan_value": {"defect": "not_a_number"},
    "needs_calibration": {"calibrated": False},
})
"""Options that put a simulator into a state only the device can show."""

HARMLESS = frozenset({"echo_on", "late", "one_byte_at_a_time", "seven_bytes_at_a_time"})
"""What a sound driver does not notice, unless its simulator lists it as ``HARMFUL``."""

BUNDLED = frozenset({"duplicate_frame", "stale_frame", "stuck_button"})
"""What a driver makes of them hangs on which bytes arrive together."""


def from_answer(answers: int, fault: Fault) -> Fault:
    """``fault`` that begins after the first ``answers`` answers."""
    return lambda simulator, seed: Onset(simulator, fault(simulator, seed), answers)


__all__ = [
    "BUNDLED",
    "FAULTS",
    "HARMLESS",
    "MUTATIONS",
    "STATES",
    "After",
    "Altered",
    "Chunked",
    "ClosedAfter",
    "DeafAtFirst",
    "Echoing",
    "Fault",
    "Late",
    "Mutating",
    "Onset",
    "Recurring",
    "Swapped",
    "WrongBaud",
    "drop_middle",
    "duplicate",
    "flip_bit",
    "from_answer",
    "prefix_garbage",
    "swallow",
    "truncate",
]
