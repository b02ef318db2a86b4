"""Dumps and reports: docs/wire/xrite_ma.md, sections 4, 5 and 7."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.color import reflectance_to_lab
from paintlink_simulators import ManualClock, Panel, xrite_ma
from paintlink_simulators.paint import WAVELENGTHS_NM, Repeatability

SILENT = Repeatability(gain=0.0, floor=0.0)
BLOCKS = ("207B2000i", "20F7207Ci", "217320F8i", "21EF2174i", "226B21F0i")
FULL_DUMP = (
    "A104000072080000430C000014100000E5130000B6170000871B0000581F0000"
    "29230000FA260000CB2A00009C2E00006D3200003E3600000F3A0000E03D0000"
    "B14100008245000053490000244D0000F5500000C654000097580000685C0000"
    "396000000A640000DB670000AC6B00007D6F00004E7300001F770000"
)
FULL_DUMP_PERCENT = (1185 + 977 * np.arange(31)) / 327.68


def flat(*percent: float) -> Panel:
    """A panel with one reflectance factor per angle of the MA68."""
    angles = np.array(xrite_ma.MODELS["MA68"])
    factors = np.repeat(np.array(percent)[:, np.newaxis] / 100, 31, axis=1)
    return Panel(angles, np.broadcast_to(factors, (5, 31)))


def with_full_dump(**options: object) -> xrite_ma.XriteMa:
    """An instrument whose memory holds the vector of section 7 at every angle."""
    panel = Panel(np.array([45.0]), FULL_DUMP_PERCENT[np.newaxis] / 100)
    simulator = xrite_ma.create(
        panel, clock=ManualClock(), repeatability=SILENT, **options
    )
    simulator.press()
    return simulator


def lines(report: bytes) -> list[list[str]]:
    return [line.split() for line in report.decode("ascii").splitlines()]


def stored(simulator: xrite_ma.XriteMa, block: str = BLOCKS[0]) -> np.ndarray:
    dump = simulator.feed(f"{block}\r".encode()).removesuffix(b"OK\r\n")
    return np.frombuffer(bytes.fromhex(dump.decode("ascii")), "<i4")


@pytest.mark.parametrize(
    ("percent", "count"),
    [
        (3.616, 1185),
        (120, 39322),
        (3.48, 1140),
        (27.31, 8949),
        (61.94, 20296),
        (65.00, 21299),
    ],
)
def test_percent_becomes_count_by_327_68(percent: float, count: int) -> None:
    panel = flat(*[percent] * 5)
    simulator = xrite_ma.create(panel, clock=ManualClock(), repeatability=SILENT)

    simulator.press()

    assert (stored(simulator) == count).all()


def test_counts_are_dumped_little_endian() -> None:
    panel = flat(*[120] * 5)
    simulator = xrite_ma.create(panel, clock=ManualClock(), repeatability=SILENT)

    simulator.press()

    assert simulator.feed(b"207B2000i\r").startswith(b"9A 99 00 00 9A 99 00 00 ")


@pytest.mark.parametrize(("grouping", "length"), [(0, 380), (16, 385), (8, 393)])
@pytest.mark.parametrize("block", BLOCKS)
def test_full_dump_has_the_golden_bytes(grouping: int, length: int, block: str) -> None:
    simulator = with_full_dump(grouping=grouping)

    answer = simulator.feed(f"{block}\r".encode())

    text = answer.decode("ascii")
    assert len(text) == length
    assert "".join(text.split()) == FULL_DUMP + "OK"
    assert text.endswith("OK\r\n")


@pytest.mark.parametrize("grouping", [8, 16])
def test_grouping_adds_a_blank_after_each_group(grouping: int) -> None:
    simulator = with_full_dump(grouping=grouping)

    digits, _, _ = simulator.feed(b"207B2000i\r").partition(b"\r\n")

    groups = [group.split() for group in digits.split(b"  ")]
    assert [len(group) for group in groups[:-1]] == [grouping] * (124 // grouping)
    assert len(groups[-1]) == 124 % grouping


@pytest.mark.parametrize("terminator", ["\r", "\n", "\r\n"])
def test_dump_is_padded_whatever_the_terminator(terminator: str) -> None:
    simulator = with_full_dump(terminator=terminator)

    answer = simulator.feed(b"207B2000i\r").decode("ascii")

    assert len(answer) == 380
    assert answer.endswith(f"OK{terminator}")


def test_memory_is_zero_before_a_reading(simulator: xrite_ma.XriteMa) -> None:
    assert not stored(simulator, BLOCKS[4]).any()


def test_blocks_hold_the_angles_in_order(clock: ManualClock) -> None:
    simulator = xrite_ma.create(
        flat(90, 70, 50, 30, 10), clock=clock, repeatability=SILENT
    )

    simulator.press()

    percent = [stored(simulator, block)[0] / 327.68 for block in BLOCKS]
    assert percent == pytest.approx([90, 70, 50, 30, 10], abs=0.002)


def test_ma58_fills_three_blocks_only(clock: ManualClock) -> None:
    simulator = xrite_ma.create(
        flat(90, 70, 50, 30, 10), clock=clock, repeatability=SILENT, model="MA58"
    )

    simulator.press()

    percent = [stored(simulator, block)[0] / 327.68 for block in BLOCKS]
    assert percent == pytest.approx([70, 50, 30, 0, 0], abs=0.002)


def test_dump_of_one_byte_is_possible() -> None:
    assert with_full_dump().feed(b"20002000i\r").split() == [b"A1", b"OK"]


def test_dump_with_start_first_is_refused() -> None:
    assert with_full_dump().feed(b"2000207Bi\r") == b"?\r\n"


def test_reset_keeps_the_memory(clock: ManualClock) -> None:
    simulator = xrite_ma.create(flat(*[50] * 5), clock=clock, repeatability=SILENT)
    simulator.press()

    simulator.feed(b"p\r")
    clock.advance(0.3)
    simulator.poll()

    assert (stored(simulator) == 16384).all()


def test_report_is_laid_out_as_documented(simulator: xrite_ma.XriteMa) -> None:
    heading, *rows = lines(simulator.press())

    spectral, colors = rows[:31], rows[31:]
    assert not heading[0].isdigit()
    assert [row[0] for row in spectral] == [str(nm) for nm in range(400, 701, 10)]
    assert {len(row) for row in spectral} == {11}
    assert all(len(token.partition(".")[2]) == 2 for token in spectral[0][1:])
    assert [row[0] for row in colors] == ["15", "25", "45", "75", "110"]
    assert {len(row) for row in colors} == {6}


def test_report_samples_are_the_dumped_values(simulator: xrite_ma.XriteMa) -> None:
    rows = lines(simulator.press())[1:32]

    for index, block in enumerate(BLOCKS):
        printed = [float(row[2 + 2 * index]) for row in rows]
        assert printed == pytest.approx(stored(simulator, block) / 327.68, abs=0.00501)


def test_report_colors_belong_to_its_spectra(simulator: xrite_ma.XriteMa) -> None:
    colors = lines(simulator.press())[32:]

    factors = [stored(simulator, block) / 32768 for block in BLOCKS]
    labs = reflectance_to_lab(WAVELENGTHS_NM, np.array(factors))
    printed = np.array([[float(token) for token in row[1:]] for row in colors])
    assert printed[:, :3] == pytest.approx(labs, abs=0.00501)
    assert printed[:, 3] == pytest.approx(np.hypot(labs[:, 1], labs[:, 2]), abs=0.00501)


def test_ma58_reports_its_three_angles(panel: Panel, clock: ManualClock) -> None:
    simulator = xrite_ma.create(panel, clock=clock, model="MA58")

    rows = lines(simulator.press())[1:]

    assert {len(row) for row in rows[:31]} == {7}
    assert [row[0] for row in rows[31:]] == ["25", "45", "75"]


def test_headings_stand_above_the_report(panel: Panel, clock: ManualClock) -> None:
    simulator = xrite_ma.create(panel, clock=clock, heading=("MA68II", "NO NAME"))

    report = simulator.press()

    assert report.startswith(b"MA68II\r\nNO NAME\r\n400 ")


def test_black_panel_prints_numbers_only(clock: ManualClock) -> None:
    simulator = xrite_ma.create(flat(*[0] * 5), clock=clock, repeatability=SILENT)

    rows = lines(simulator.press())[1:]

    assert np.isfinite([float(token) for row in rows for token in row]).all()


def test_press_without_arming_also_prints(simulator: xrite_ma.XriteMa) -> None:
    assert not simulator.armed

    assert len(lines(simulator.press())) == 37


def test_every_press_is_a_fresh_reading(simulator: xrite_ma.XriteMa) -> None:
    first, second = simulator.press(), simulator.press()

    assert first != second
    before, after = (
        np.array(lines(report)[1:32], dtype=float) for report in (first, second)
    )
    assert before == pytest.approx(after, rel=0.03, abs=0.1)


def test_new_panel_is_measured_next(simulator: xrite_ma.XriteMa, panel: Panel) -> None:
    simulator.press()
    before = stored(simulator).astype(float)

    simulator.panel = replace(panel, factors=2 * panel.factors)
    simulator.press()

    assert stored(simulator) / before == pytest.approx(2, rel=0.03)
