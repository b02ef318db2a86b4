from __future__ import annotations

import pytest

from paintlink_simulators._uart import LineSettings, heard

TEXT = b"X-RITE MA68II 3.02\r\n"
EVERY_BYTE = bytes(range(256))
COMMON = LineSettings()


@pytest.mark.parametrize(
    "settings",
    [LineSettings(300.0), LineSettings(250000.0), LineSettings(stopbits=2.0)],
)
def test_same_settings_pass_every_byte(settings: LineSettings) -> None:
    assert heard(EVERY_BYTE, settings, settings) == EVERY_BYTE


def test_a_quantised_baud_rate_is_heard() -> None:
    adapter = LineSettings(3_000_000 / 26)

    assert heard(EVERY_BYTE, LineSettings(115200.0), adapter) == EVERY_BYTE


@pytest.mark.parametrize("baud", [300.0, 1200.0, 4800.0, 19200.0, 115200.0])
def test_wrong_baud_rate_gives_garbage(baud: float) -> None:
    garbage = heard(TEXT, COMMON, LineSettings(baud))

    assert garbage != TEXT
    assert b"X-RITE" not in garbage


def test_half_the_rate_hears_half_the_bits() -> None:
    # On the wire 0 00110011 1; sampled at 3, 5, 7, 9 and on the idle line: 1 0 1 1 1...
    assert heard(b"\xcc", LineSettings(9600.0), LineSettings(4800.0)) == b"\xfd"


def test_receiver_without_parity_takes_the_parity_bit_as_data() -> None:
    seven = LineSettings(bytesize=7, parity="E")

    # 'A' has an even number of ones, 'C' an odd one: bit 7 is the parity.
    assert heard(b"AC", seven, COMMON) == b"\x41\xc3"


def test_seven_bits_carry_no_eighth() -> None:
    seven = LineSettings(bytesize=7, parity="E")

    assert heard(b"\xc1", seven, seven) == b"\x41"


def test_nothing_sent_is_nothing_heard() -> None:
    assert heard(b"", COMMON, LineSettings(300.0)) == b""
