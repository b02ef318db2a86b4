"""Commands, states and noise: docs/wire/xrite_ma.md, sections 3, 6 and 7."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from paintlink.errors import ConfigError
from paintlink_simulators import ManualClock, Panel, xrite_ma


def test_transcript_of_the_wire_page_is_kept(simulator: xrite_ma.XriteMa) -> None:
    assert simulator.feed(bytes.fromhex("76 0D")) == b"X-RITE MA68II 3.02\r\n"
    assert simulator.feed(b"ys\r") == b"CALIBRATION OK\r\n"
    assert simulator.feed(b"00A04Cw\r") == b"OK\r\n"
    assert simulator.press().splitlines()[-1].startswith(b"110 ")
    assert simulator.feed(b"207B2000i\r").endswith(b"\r\n  OK\r\n")


def test_press_disarms_the_instrument(simulator: xrite_ma.XriteMa) -> None:
    simulator.feed(b"00A04Cw\r")
    assert simulator.armed

    simulator.press()

    assert not simulator.armed


def test_uncalibrated_press_gives_no_data(panel: Panel, clock: ManualClock) -> None:
    simulator = xrite_ma.create(panel, clock=clock, calibrated=False)
    simulator.feed(b"00A04Cw\r")

    answer = simulator.press()

    assert answer == b"CALIBRATION NEEDED\r\n"
    assert {*simulator.feed(b"207B2000i\r").split()} == {b"00", b"OK"}
    assert not simulator.armed


def test_forced_calibration_changes_the_state(simulator: xrite_ma.XriteMa) -> None:
    assert simulator.feed(b"3ys\r") == b"CALIBRATION NEEDED\r\n"

    assert simulator.feed(b"ys\r") == b"CALIBRATION NEEDED\r\n"


def test_calibration_on_the_plaque_succeeds(simulator: xrite_ma.XriteMa) -> None:
    simulator.feed(b"3ys\r")
    assert simulator.feed(b"yw\r") == b""
    assert simulator.awaits_plate
    simulator.plate_on = True

    answer = simulator.press()

    assert answer == b"OK\r\n"
    assert not simulator.awaits_plate
    assert simulator.feed(b"ys\r") == b"CALIBRATION OK\r\n"


def test_calibration_off_the_plaque_fails(simulator: xrite_ma.XriteMa) -> None:
    simulator.feed(b"yw\r")

    answer = simulator.press()

    assert answer == b"CALIBRATION ERROR\r\n"
    assert simulator.feed(b"ys\r") == b"CALIBRATION NEEDED\r\n"


def test_reset_answers_after_300_ms(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    simulator.feed(b"00A04Cw\r")

    assert simulator.feed(b"p\r") == b""
    assert not simulator.armed
    assert simulator.due_at() == pytest.approx(0.3)
    clock.advance(0.299)
    assert simulator.poll() == b""
    clock.advance_to(0.3)
    assert simulator.poll() == b"RESET\r\n"
    assert simulator.poll() == b""
    assert simulator.due_at() is None


def test_commands_wait_for_a_running_reset(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    assert simulator.feed(b"p\r3ys\rv\r") == b""
    clock.advance(0.3)

    answer = simulator.poll()

    assert answer == b"RESET\r\nCALIBRATION NEEDED\r\nX-RITE MA68II 3.02\r\n"


def test_press_during_a_reset_is_ignored(simulator: xrite_ma.XriteMa) -> None:
    simulator.feed(b"p\r")

    assert simulator.press() == b""


def test_disconnecting_forgets_what_is_owed(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    simulator.feed(b"p\rys")

    simulator.disconnect()
    clock.advance(1.0)

    assert simulator.poll() == b""
    assert simulator.feed(b"v\r") == b"X-RITE MA68II 3.02\r\n"


@pytest.mark.parametrize("command", [b"", b"V", b"x", b"\nv", b"207B2000", b"\xff"])
def test_unknown_command_is_answered_with_question_mark(
    simulator: xrite_ma.XriteMa, command: bytes
) -> None:
    assert simulator.feed(command + b"\r") == b"?\r\n"


def test_echo_is_a_line_before_the_answer(panel: Panel, clock: ManualClock) -> None:
    simulator = xrite_ma.create(panel, clock=clock, echo=True)

    assert simulator.feed(b"ys\r") == b"ys\r\nCALIBRATION OK\r\n"


def test_identity_names_model_and_firmware(panel: Panel, clock: ManualClock) -> None:
    ma58 = xrite_ma.create(panel, clock=clock, model="MA58", firmware="1.9")
    sphere = xrite_ma.create(panel, clock=clock, identity="X-RITE 968 1.00")

    assert ma58.feed(b"v\r") == b"X-RITE MA58 1.9\r\n"
    assert sphere.feed(b"v\r") == b"X-RITE 968 1.00\r\n"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"model": "MA96"}, "model = 'MA96' is not one of 'MA58', 'MA68', 'MA68II'"),
        ({"grouping": 4}, "grouping = 4 is not one of 0, 8, 16"),
        ({"terminator": ";"}, "terminator = ';' is not one of"),
    ],
)
def test_impossible_option_is_refused(
    panel: Panel, options: dict[str, object], message: str
) -> None:
    with pytest.raises(ConfigError, match=message):
        xrite_ma.create(panel, clock=ManualClock(), **options)


COMMANDS = [b"v", b"p", b"3ys", b"ys", b"yw", b"00A04Cw", b"207B2000i", b"nonsense"]


@given(commands=st.lists(st.sampled_from(COMMANDS), max_size=8), data=st.data())
def test_answers_do_not_depend_on_chunks(
    commands: list[bytes], data: st.DataObject, panel: Panel
) -> None:
    stream = b"".join(command + b"\r" for command in commands)
    cuts = data.draw(st.lists(st.integers(0, len(stream)), max_size=12).map(sorted))
    pieces = [
        stream[a:b] for a, b in zip([0, *cuts], [*cuts, len(stream)], strict=True)
    ]

    assert conversation(panel, pieces) == conversation(panel, [stream])


def conversation(panel: Panel, pieces: list[bytes]) -> bytes:
    clock = ManualClock()
    simulator = xrite_ma.create(panel, clock=clock)
    sent = b"".join(simulator.feed(piece) for piece in pieces)
    while (due := simulator.due_at()) is not None:
        clock.advance_to(due)
        sent += simulator.poll()
    return sent


@given(noise=st.binary(max_size=200))
def test_any_bytes_leave_it_answering(noise: bytes, panel: Panel) -> None:
    clock = ManualClock()
    simulator = xrite_ma.create(panel, clock=clock)

    simulator.feed(noise + b"\r")
    while simulator.due_at() is not None:
        clock.advance(0.3)
        simulator.poll()

    assert simulator.feed(b"v\r") == b"X-RITE MA68II 3.02\r\n"


def test_same_seed_gives_the_same_bytes(panel: Panel, clock: ManualClock) -> None:
    first, second = (xrite_ma.create(panel, clock=clock, seed=3) for _ in range(2))

    assert [first.press() for _ in range(3)] == [second.press() for _ in range(3)]


def test_misspelt_attribute_is_refused(simulator: xrite_ma.XriteMa) -> None:
    with pytest.raises(AttributeError, match="plate_off"):
        simulator.plate_off = True  # type: ignore[attr-defined]
