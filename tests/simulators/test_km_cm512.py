"""The simulated CM-512m3 against docs/wire/km_cm512.md."""

from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import ConfigError
from paintlink_simulators import ManualClock, Panel, km_cm512
from paintlink_simulators.paint import Repeatability

WAVELENGTHS = np.arange(31)
GOLDEN = (
    "OK00,"
    "008.31,009.31,010.31,011.31,012.31,013.31,014.31,015.31,016.31,017.31,018.31,"
    "019.31,020.31,021.31,022.31,023.31,024.31,025.31,026.31,027.31,028.31,029.31,"
    "030.31,031.31,032.31,033.31,034.31,035.31,036.31,037.31,038.31"
)
GOLDEN_PLATE = (
    b"OK00,090.00,090.10,090.20,090.30,090.40,090.50,090.60,090.70,090.80,090.90,"
    b"091.00,091.10,091.20,091.30,091.40,091.50\r"
)
TYPE_AHEAD = bytes.fromhex("4D45530D260D260D260D260D260D260D")
MES_S = 3.0
EXACT = Repeatability(gain=0.0, floor=0.0)


@pytest.fixture
def golden_panel() -> Panel:
    factors = [
        0.0831 + 0.01 * WAVELENGTHS,
        0.06 + 0.005 * WAVELENGTHS,
        0.04 + 0.0025 * WAVELENGTHS,
    ]
    return Panel(np.array([25.0, 45.0, 75.0]), np.array(factors), "golden")


@pytest.fixture
def meter(golden_panel: Panel, clock: ManualClock) -> km_cm512.KmCm512:
    return km_cm512.create(golden_panel, clock=clock, repeatability=EXACT)


def after(meter: km_cm512.KmCm512, clock: ManualClock, seconds: float) -> bytes:
    clock.advance(seconds)
    return meter.poll()


def test_identity_and_status_are_golden(meter: km_cm512.KmCm512) -> None:
    assert meter.feed(b"IDR\r") == b"OK00,CM-512m3A,1.10,12345678\r"
    assert meter.feed(b"STR\r") == b"OK00,0,1\r"


def test_type_ahead_gives_seven_golden_replies(
    meter: km_cm512.KmCm512, clock: ManualClock
) -> None:
    assert meter.feed(TYPE_AHEAD) == b""

    sent = after(meter, clock, MES_S)

    replies = sent.split(b"\r")[:-1]
    assert len(sent) == 848
    assert [len(reply) + 1 for reply in replies] == [11, 222, 57, 222, 57, 222, 57]
    assert replies[0] == b"OK00,00001"
    assert replies[1].decode() == GOLDEN
    assert replies[3].startswith(b"OK00,006.00,006.50,")
    assert replies[5].endswith(b",011.50")
    assert replies[2] == b"OK00" + b",000.00" * 7 + b"   "


def test_measuring_takes_its_time(meter: km_cm512.KmCm512, clock: ManualClock) -> None:
    meter.feed(b"MES\r")

    assert after(meter, clock, MES_S - 0.1) == b""
    assert meter.due_at() == pytest.approx(MES_S)
    assert after(meter, clock, 0.2) == b"OK00,00001\r"


def test_continuation_ends_with_another_command(
    meter: km_cm512.KmCm512, clock: ManualClock
) -> None:
    meter.feed(b"MES\r")
    after(meter, clock, MES_S)
    meter.feed(b"STR\r")

    assert meter.feed(b"&\r") == b"ER00\r"


def test_plate_is_read_and_written_in_three_parts(meter: km_cm512.KmCm512) -> None:
    assert meter.feed(b"CDR\r") == GOLDEN_PLATE
    values = GOLDEN_PLATE[5:].replace(b"090.00", b"089.99")

    parts = [meter.feed(start + values) for start in (b"CDS,", b"&,", b"&,")]

    assert parts == [b"&\r", b"&\r", b"OK00\r"]
    assert meter.feed(b"CDR\r").startswith(b"OK00,089.99,090.10")
    assert len(meter.feed(b"&\r")) == len(meter.feed(b"&\r")) == 117
    assert meter.feed(b"&\r") == b"ER00\r"


@pytest.mark.parametrize("values", [b"1,2", b"090.00", b",".join([b"90.000"] * 16)])
def test_unreadable_plate_values_are_refused(
    meter: km_cm512.KmCm512, values: bytes
) -> None:
    assert meter.feed(b"CDS," + values + b"\r") == b"ER17\r"
    assert meter.feed(b"&," + values + b"\r") == b"ER00\r"


def test_white_calibration_needs_the_plate(
    golden_panel: Panel, clock: ManualClock
) -> None:
    meter = km_cm512.create(golden_panel, clock=clock, calibrated=False, zeroed=False)

    assert meter.feed(b"STR\rMES\rCAL\r") == b"OK00,0,0\rER01\rER01\r"
    meter.feed(b"UZC\r")
    assert after(meter, clock, 1.5) == b"OK00\r"
    meter.feed(b"CAL\r")
    assert meter.awaits_plate
    assert after(meter, clock, 2.5) == b"ER10\r"
    meter.feed(b"CAL\r")
    meter.plate_on = True
    assert meter.press() == b""
    meter.plate_on = False
    assert after(meter, clock, 2.5) == b"OK00\r"
    assert meter.feed(b"STR\r") == b"OK00,0,1\r"


@pytest.mark.parametrize(
    ("condition", "status", "refusal"),
    [
        ("warming", b"OK00,1,1\r", b"ER02\r"),
        ("battery_low", b"OK00,0,1\r", b"ER30\r"),
    ],
)
def test_condition_refuses_to_measure(
    golden_panel: Panel,
    clock: ManualClock,
    condition: str,
    status: bytes,
    refusal: bytes,
) -> None:
    meter = km_cm512.create(golden_panel, clock=clock, condition=condition)

    assert meter.feed(b"STR\r") == status
    assert meter.feed(b"MES\r") == refusal


def test_lamp_warms_up(golden_panel: Panel, clock: ManualClock) -> None:
    meter = km_cm512.create(golden_panel, clock=clock, condition="warming")

    clock.advance(60.0)

    assert meter.feed(b"STR\r") == b"OK00,0,1\r"


def test_full_memory_is_a_remark(golden_panel: Panel, clock: ManualClock) -> None:
    meter = km_cm512.create(golden_panel, clock=clock, condition="memory_full")
    meter.feed(b"MES\r")

    assert after(meter, clock, MES_S) == b"OK02,00001\r"


@pytest.mark.parametrize("command", [b"XYZ", b"mes", b"&", b"MES,1"])
def test_unknown_command_is_refused(meter: km_cm512.KmCm512, command: bytes) -> None:
    assert meter.feed(command + b"\r")[:2] == b"ER"


def test_line_feeds_and_empty_commands_are_ignored(meter: km_cm512.KmCm512) -> None:
    assert meter.feed(b"\r\r\n") == b""
    assert meter.feed(b"\nSTR\r") == b"OK00,0,1\r"


def test_disconnecting_forgets_what_was_owed(
    meter: km_cm512.KmCm512, clock: ManualClock
) -> None:
    meter.feed(TYPE_AHEAD)
    meter.disconnect()

    assert after(meter, clock, MES_S) == b""
    assert meter.feed(b"&\r") == b"ER00\r"


def test_values_stay_within_their_six_characters(clock: ManualClock) -> None:
    bright = Panel(np.array([25.0]), np.full((1, 31), 14.0))
    meter = km_cm512.create(bright, clock=clock, repeatability=EXACT)
    meter.feed(b"MES\r&\r")

    reply = after(meter, clock, MES_S).split(b"\r")[1]

    assert reply == b"OK00" + b",999.99" * 31


def test_misspelt_model_is_refused(golden_panel: Panel, clock: ManualClock) -> None:
    with pytest.raises(ConfigError, match=r"km_cm512: model = 'CM-5' is not one of"):
        km_cm512.create(golden_panel, clock=clock, model="CM-5")
