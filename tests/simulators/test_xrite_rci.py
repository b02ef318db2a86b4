"""The simulated RCI instruments against docs/wire/xrite_rci.md."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from paintlink.color import lab_to_xyz, reflectance_to_lab, white
from paintlink_simulators import ManualClock, Panel, xrite_rci
from paintlink_simulators.paint import Repeatability

EXACT = Repeatability(gain=0.0, floor=0.0)
GOLDEN = bytes.fromhex(
    "07D00BB80FA0138817701B581F40232827102AF82EE032C836B03A983E804268"
    "46504A384E20520855F059D85DC061A8659069786D607148753079187D00"
)
PERCENT = np.arange(2000, 33000, 1000) * 200.0 / 65535.0
SERIAL = ["530", "SP62", "CA22", "DTP22"]
WHITE = {"DTP20": "CR", "530": "UC", "SP62": "10XD", "CA22": "CA", "DTP22": "1CA"}


class Bench:
    def __init__(self, clock: ManualClock, model: str, **options: Any) -> None:
        panel = Panel(np.array([45.0]), PERCENT[None] / 100.0, "golden")
        self.clock = clock
        self.meter = xrite_rci.create(
            panel, clock=clock, model=model, repeatability=EXACT, **options
        )

    def ask(self, command: str, after_s: float = 0.0) -> bytes:
        sent = self.meter.feed(command.encode() + b"\r")
        self.clock.advance(after_s)
        return sent + self.meter.poll()

    def pass_time(self, seconds: float) -> None:
        self.clock.advance(seconds)


@pytest.fixture
def dtp20(clock: ManualClock) -> Bench:
    return Bench(clock, "DTP20")


def test_ping_version_and_plaque_are_golden(dtp20: Bench) -> None:
    assert dtp20.ask("") == b"<00>"
    assert dtp20.ask("sv") == b"X-Rite DTP20 V1.00\r\n<00>"
    assert dtp20.ask("0008CF") == b"<00>"
    assert dtp20.ask("04SN") == b"12345\r<00>"
    assert b"Serial Number: SIM00001\r" in dtp20.ask("GI")


def test_golden_session_of_the_dtp20(clock: ManualClock) -> None:
    bench = Bench(clock, "DTP20", calibrated=False)
    assert bench.ask("0PR", 0.1) == bench.ask("0PR", 0.1) == b"<00>"
    for command in ("0008CF", "0005CF", "0207CF", "020ACF", "001ACF", "0716CF"):
        assert bench.ask(command) == b"<00>"

    assert bench.ask("RM") == b"<28>"
    assert bench.ask("CE") == b"<00>"
    bench.meter.plate_on = True
    assert bench.ask("CR") == b"<00>"
    assert bench.ask("CS") == b"4\r<00>"
    bench.pass_time(3.0)
    assert bench.ask("CS") == b"2\r<00>"
    assert bench.ask("RM", 1.0) == b"<00>"
    assert bench.ask("CS") == b"6\r<00>"
    assert bench.ask("0318CF") == bench.ask("011BCF") == b"<00>"
    assert bench.ask("01GM") == GOLDEN
    assert bench.ask("001BCF") == b"<00>"
    assert bench.ask("0518CF") == bench.ask("0518CF") == b"<00>"
    xyz = lab_to_xyz(
        reflectance_to_lab(np.arange(400.0, 701.0, 10.0), PERCENT / 100.0),
        white("D65", "10"),
    )
    assert bench.ask("01GM") == ("\t".join(f"{v:.2f}" for v in xyz) + "\r<00>").encode()


def test_error_lasts_until_it_is_cleared(dtp20: Bench) -> None:
    assert dtp20.ask("QQ") == b"<11>"
    assert dtp20.ask("SV") == dtp20.ask("") == b"<11>"
    assert dtp20.ask("CE") == b"<00>"
    assert dtp20.ask("") == b"<00>"


def test_a_spectrum_of_delimiters_is_sent_whole(clock: ManualClock) -> None:
    bench = Bench(clock, "DTP20")
    percent = 0x3E3E * 200.0 / 65535.0
    bench.meter.panel = Panel(np.array([45.0]), np.full((1, 31), percent / 100.0))
    bench.ask("RM", 1.0)
    bench.ask("011BCF")

    assert bench.ask("01GM") == b"\x3e" * 62


def test_failed_calibration_shows_in_the_next_command(clock: ManualClock) -> None:
    bench = Bench(clock, "DTP20")
    bench.ask("CR")
    assert bench.ask("RM") == b"<14>"
    assert bench.ask("") == b"<00>"
    bench.pass_time(3.0)

    assert bench.ask("CS") == b"<29>"
    bench.ask("CE")
    assert bench.ask("RM") == b"<28>"


def test_stored_readings_are_counted_numbered_and_cleared(dtp20: Bench) -> None:
    for level in (0.25, 0.5):
        dtp20.meter.panel = Panel(np.array([45.0]), np.full((1, 31), level))
        assert dtp20.ask("RM", 1.0) == b"<00>"

    assert dtp20.ask("00GM") == b"2\r\n<00>"
    assert dtp20.ask("00101GM").startswith(b"25.00,25.00,")
    assert dtp20.ask("00201GM") == dtp20.ask("01GM")
    assert dtp20.ask("02CD") == b"<00>"
    assert dtp20.ask("CS") == b"4\r\n<00>"
    dtp20.pass_time(0.5)
    assert dtp20.ask("00GM") == b"0\r\n<00>"
    assert dtp20.ask("01GM") == b"<42>"


def test_button_of_the_dtp20_changes_the_status_only(dtp20: Bench) -> None:
    assert dtp20.ask("CS") == b"2\r\n<00>"
    assert dtp20.meter.armed

    assert dtp20.meter.press() == b""

    assert dtp20.ask("CS") == b"6\r\n<00>"
    assert not dtp20.meter.armed


@pytest.mark.parametrize("model", SERIAL)
def test_button_of_a_serial_model_is_an_answer_nobody_asked_for(
    clock: ManualClock, model: str
) -> None:
    bench = Bench(clock, model)
    on, off = ("3PB", "2PB") if model == "DTP22" else ("01PB", "00PB")

    assert bench.meter.press() == b""
    assert bench.ask(on) == b"<00>"
    assert bench.meter.press() == b"<01>"
    assert bench.ask(off) == b"<00>"
    assert not bench.meter.armed


@pytest.mark.parametrize(
    ("model", "command", "values"),
    [
        ("530", "03TS", r"[\d.]+"),
        ("SP62", "001GM", r"[\d.]+"),
        ("SP62", "101GM", r"[\d.]+"),
        ("CA22", "1SR", r"S( *[\d.]+)"),
        ("DTP22", "0SR", r"S ([\d.]+)"),
    ],
)
def test_each_model_writes_its_spectrum(
    clock: ManualClock, model: str, command: str, values: str
) -> None:
    bench = Bench(clock, model)
    assert bench.ask("RM", 1.0) == b"<00>"
    assert bench.ask("01ST") == b"<00>"

    sent = bench.ask(command).decode()

    assert sent.endswith("\r\n<00>")
    found = re.findall(values, sent.removesuffix("<00>"))
    np.testing.assert_allclose([float(one) for one in found], PERCENT, atol=0.005)
    if model == "CA22":
        assert len(sent) == 31 * 11 + len("\r\n<00>")


def test_530_sends_the_line_of_the_page(clock: ManualClock) -> None:
    bench = Bench(clock, "530")
    bench.ask("RM", 1.0)
    sent = bench.ask("03TS")

    assert sent.startswith(b"6.10,9.16,")
    assert sent.endswith(b",97.66\r\n<00>")


@pytest.mark.parametrize("model", WHITE)
def test_calibration_needs_the_plaque(clock: ManualClock, model: str) -> None:
    bench = Bench(clock, model, calibrated=False)
    needs, failed = (b"<12>", b"<13>") if model == "DTP22" else (b"<28>", b"<29>")

    assert bench.ask("RM") == needs
    bench.ask("CE")
    refused = bench.ask(WHITE[model], 3.0)
    assert refused + bench.ask("") == (b"<00>" if model == "DTP20" else failed) + failed
    bench.ask("CE")
    bench.meter.feed(WHITE[model].encode() + b"\r")
    assert bench.meter.awaits_plate
    bench.meter.plate_on = True
    bench.meter.press()
    bench.meter.plate_on = False
    bench.pass_time(3.0)
    bench.meter.poll()
    if model == "CA22":
        assert bench.ask("RM") == needs
        bench.ask("CE")
        assert bench.ask("CB", 2.0) == b"<00>"
    if model == "SP62":
        assert bench.ask("01XD") == b"1\r\n<00>"
    assert bench.ask("RM", 1.0) == b"<00>"


@pytest.mark.parametrize(
    ("condition", "second", "first"),
    [
        ("warming", b"<14>", b"<10>"),
        ("battery_low", b"<3B>", b"<23>"),
        ("memory_full", b"<37>", b"<04>"),
    ],
)
def test_condition_refuses_to_measure(
    clock: ManualClock, condition: str, second: bytes, first: bytes
) -> None:
    for model in WHITE:
        bench = Bench(clock, model, condition=condition)
        assert bench.ask("RM") == (first if model == "DTP22" else second)


def test_empty_battery_shows(clock: ManualClock) -> None:
    assert Bench(clock, "DTP20", condition="battery_low").ask("06BA") == b"0\r\n<00>"
    assert Bench(clock, "DTP20").ask("06BA") == b"4\r\n<00>"


def test_configuration_is_lost_in_a_reset_unless_made_permanent(dtp20: Bench) -> None:
    dtp20.ask("0008CF")
    dtp20.ask("0PR", 0.1)
    assert dtp20.ask("04SN") == b"12345\r\n<00>"
    dtp20.ask("0008CF")
    dtp20.ask("MP")
    dtp20.ask("RI", 0.1)
    assert dtp20.ask("04SN") == b"12345\r<00>"
    dtp20.ask("5CRI", 0.1)
    assert dtp20.ask("04SN") == b"12345\r\n<00>"


def test_echo_repeats_the_command(dtp20: Bench) -> None:
    dtp20.ask("0109CF")

    assert dtp20.ask("04SN") == b"04SN\r12345\r\n<00>"


def test_other_illuminants_have_no_tristimulus_values(dtp20: Bench) -> None:
    dtp20.ask("RM", 1.0)
    dtp20.ask("0518CF")

    assert dtp20.ask("01GM") == b"<3F>"


@pytest.mark.parametrize(
    ("command", "second", "first"),
    [
        ("0708CF", b"<12>", b"<02>"),
        ("7CF", b"<12>", b"<02>"),
        ("ZZ9", b"<11>", b"<01>"),
    ],
)
def test_wrong_commands_are_refused(
    clock: ManualClock, command: str, second: bytes, first: bytes
) -> None:
    assert Bench(clock, "DTP20").ask(command) == second
    assert Bench(clock, "DTP22").ask(command) == first


def test_commands_wait_while_it_measures(clock: ManualClock) -> None:
    bench = Bench(clock, "530")

    assert bench.ask("RM") == bench.ask("SV") == b""
    bench.pass_time(1.0)
    assert bench.meter.poll() == b"<00>X-Rite 530 V1.00\r\n<00>"
