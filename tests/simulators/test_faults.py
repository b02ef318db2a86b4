"""Each fault changes what it says, and nothing else."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from paintlink.errors import LinkError
from paintlink_simulators import FAULTS, ManualClock, MemoryPort, Panel, xrite_ma
from paintlink_simulators._simulator import LineCutError
from paintlink_simulators.faults import (
    Altered,
    Chunked,
    ClosedAfter,
    Late,
    drop_middle,
    flip_bit,
    from_answer,
    prefix_garbage,
    truncate,
)

IDENTITY = b"X-RITE MA68II 3.02\r\n"
COMMANDS = (b"v\r", b"ys\r", b"00A04Cw\r", b"207B2000i\r", b"p\r", b"v\r")
HARD_OF_HEARING = {"first_command_lost", "wrong_baud"}
SPONTANEOUS = {"never_ends", "stuck_button"}
ANSWERS = st.binary(min_size=1, max_size=400)


def answers_of(simulator: object, clock: ManualClock) -> list[bytes]:
    """What a client gets for each command within two seconds, piece by piece."""
    port = MemoryPort(simulator, clock)
    answers = []
    for command in COMMANDS:
        port.write(command)
        pieces = iter(lambda: port.read(2.0), b"")
        answers.append(b"".join(pieces))
    return answers


@pytest.fixture
def sound(panel: Panel) -> list[bytes]:
    clock = ManualClock()
    return answers_of(xrite_ma.create(panel, clock=clock, seed=7), clock)


def with_fault(
    name: str, simulator: xrite_ma.XriteMa, clock: ManualClock, seed: int = 0
) -> list[bytes]:
    return answers_of(FAULTS[name](simulator, seed), clock)


def test_silent_instrument_answers_nothing(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    assert with_fault("silent", simulator, clock) == [b""] * len(COMMANDS)
    assert simulator.armed is False


@pytest.mark.parametrize("name", ["one_byte_at_a_time", "seven_bytes_at_a_time"])
def test_pieces_add_up_to_the_sound_answers(
    name: str, simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    assert with_fault(name, simulator, clock) == sound


def test_late_answers_are_the_sound_ones(
    simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    assert with_fault("late", simulator, clock) == sound


def test_echo_precedes_the_sound_answers(
    simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    received = with_fault("echo_on", simulator, clock)

    assert received == [
        command + answer for command, answer in zip(COMMANDS, sound, strict=True)
    ]


def test_duplicate_sends_every_answer_twice(
    simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    received = with_fault("duplicate_frame", simulator, clock)

    assert received == [2 * answer for answer in sound]


def test_truncation_leaves_the_beginning(
    simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    received = with_fault("truncate", simulator, clock)

    assert received == [answer[:7] for answer in sound]


def test_garbage_stands_before_the_sound_answers(
    simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    received = with_fault("garbage_prefix", simulator, clock)

    assert [answer[8:] for answer in received] == sound
    assert all(byte >= 0x80 for answer in received for byte in answer[:8])


def test_dropped_bytes_were_in_the_middle(
    simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    received = with_fault("drop_mid_frame", simulator, clock)

    assert received[0] == IDENTITY[:7] + IDENTITY[12:]
    assert [len(answer) for answer in received] == [
        max(len(answer) - 5, 1) for answer in sound
    ]


def test_flipped_answers_differ_in_one_bit(
    simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    received = with_fault("flip_bit", simulator, clock)

    assert [
        different_bits(answer, whole)
        for answer, whole in zip(received, sound, strict=True)
    ] == [1] * len(sound)


def test_closed_port_cuts_the_stream(
    simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    port = MemoryPort(FAULTS["close_port"](simulator, 0), clock)
    for command in COMMANDS[:4]:
        port.write(command)

    received = port.read(2.0)

    assert received == b"".join(sound)[:100]
    with pytest.raises(LinkError, match="closed"):
        port.read(2.0)


@pytest.mark.parametrize("name", sorted(set(FAULTS) - HARD_OF_HEARING))
def test_fault_leaves_the_instrument_reachable(
    name: str, simulator: xrite_ma.XriteMa, panel: Panel
) -> None:
    faulty = FAULTS[name](simulator, 0)

    faulty.feed(b"00A04Cw\r")
    assert faulty.armed
    faulty.feed(b"yw\r")
    assert faulty.awaits_plate
    faulty.plate_on = True
    assert simulator.plate_on
    faulty.panel = blank = Panel(np.array([45.0]), np.ones((1, 31)))
    assert simulator.panel is blank
    assert faulty.clock is simulator.clock


@pytest.mark.parametrize("name", sorted(set(FAULTS) - SPONTANEOUS))
def test_disconnecting_ends_what_a_fault_holds(
    name: str, simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    faulty = FAULTS[name](simulator, 0)
    faulty.feed(b"v\rp\rys")

    faulty.disconnect()
    clock.advance(10.0)

    assert faulty.poll() == b""
    assert faulty.due_at() is None


@pytest.mark.parametrize("name", ["flip_bit", "garbage_prefix"])
def test_seed_decides_what_is_damaged(name: str, panel: Panel) -> None:
    def damaged(seed: int) -> list[bytes]:
        clock = ManualClock()
        simulator = xrite_ma.create(panel, clock=clock, seed=7)
        return with_fault(name, simulator, clock, seed)

    assert damaged(1) == damaged(1)
    assert damaged(1) != damaged(2)


def test_fault_can_begin_at_a_later_answer(
    simulator: xrite_ma.XriteMa, clock: ManualClock, sound: list[bytes]
) -> None:
    fault = from_answer(3, FAULTS["truncate"])

    received = answers_of(fault(simulator, 0), clock)

    assert received[:3] == sound[:3]
    assert received[3:] == [answer[:7] for answer in sound[3:]]


def test_fault_can_begin_at_the_first_answer(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    fault = from_answer(0, FAULTS["silent"])

    assert answers_of(fault(simulator, 0), clock) == [b""] * len(COMMANDS)


def test_faults_combine(simulator: xrite_ma.XriteMa, clock: ManualClock) -> None:
    faulty = Late(Altered(Chunked(simulator, 4), truncate(2)), 0.5)
    port = MemoryPort(faulty, clock)

    port.write(b"v\r")

    assert port.read(0.4) == b""
    assert b"".join(iter(lambda: port.read(2.0), b"")) == b"X-TEA6I 02"


def test_late_answer_keeps_its_delay(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    port = MemoryPort(Late(simulator, 0.5), clock)
    port.write(b"p\r")

    assert port.read(2.0) == b"RESET\r\n"
    assert clock() == pytest.approx(0.8)


def test_late_fault_reports_the_next_event(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    faulty = Late(simulator, 0.5)

    faulty.feed(b"v\rp\r")

    assert faulty.due_at() == pytest.approx(0.3)
    clock.advance(0.3)
    assert faulty.poll() == b""
    assert faulty.due_at() == pytest.approx(0.5)


def test_cut_may_fall_between_answers(simulator: xrite_ma.XriteMa) -> None:
    faulty = ClosedAfter(simulator, len(IDENTITY))

    with pytest.raises(LineCutError, match="cut after 20 more bytes") as cut:
        faulty.feed(b"v\r")

    assert cut.value.sent == IDENTITY


def test_cut_happens_once(simulator: xrite_ma.XriteMa) -> None:
    faulty = ClosedAfter(simulator, 30)
    assert faulty.feed(b"v\r") == IDENTITY

    with pytest.raises(LineCutError, match="cut after 10 more bytes") as cut:
        faulty.feed(b"v\r")

    assert cut.value.sent == IDENTITY[:10]
    assert faulty.feed(b"v\r") == IDENTITY


@given(answer=ANSWERS, size=st.integers(1, 20))
def test_dropping_keeps_the_first_byte(answer: bytes, size: int) -> None:
    left = drop_middle(size)(answer)

    assert len(left) == max(len(answer) - size, 1)
    assert left[:1] == answer[:1]


@given(answer=ANSWERS, seed=st.integers(0, 1000))
def test_flipping_inverts_one_bit(answer: bytes, seed: int) -> None:
    assert different_bits(flip_bit(np.random.default_rng(seed))(answer), answer) == 1


@given(answer=ANSWERS, size=st.integers(1, 20))
def test_garbage_only_precedes(answer: bytes, size: int) -> None:
    damaged = prefix_garbage(np.random.default_rng(0), size)(answer)

    assert damaged[size:] == answer


def different_bits(one: bytes, other: bytes) -> int:
    assert len(one) == len(other)
    return sum((a ^ b).bit_count() for a, b in zip(one, other, strict=True))
