import numpy as np
import pytest

from paintlink.errors import (
    CancelledError,
    InstrumentError,
    LinkTimeoutError,
    ProtocolError,
)
from tests.drivers import ma_peer as ma


def test_press_is_awaited_for_the_configured_time(peer):
    peer.report = b""

    with pytest.raises(LinkTimeoutError, match="sent nothing within 300 s"):
        ma.measured(peer)
    with pytest.raises(LinkTimeoutError, match="sent nothing within 20 s"):
        ma.connect(peer, {"press_timeout_s": 20}).measure(peer.press)


def test_wait_for_the_press_can_be_cancelled(peer):
    peer.report = b""

    with pytest.raises(CancelledError, match="stopped while waiting"):
        ma.measured(peer, cancelled=lambda: peer.now_s > 7.0)

    assert peer.now_s < 7.2


def test_pause_within_the_report_is_waited_out(peer):
    report = ma.golden_report()
    peer.report = (120.0, report[:100], 0.25, report[100:])

    assert np.array_equal(ma.measured(peer).spectra.factors, ma.GOLDEN)


def test_report_before_the_press_is_thrown_away(peer):
    peer.say(ma.golden_report())

    assert np.array_equal(ma.measured(peer).spectra.factors, ma.GOLDEN)


def test_247_digits_are_no_spectrum(peer):
    command = ma.DUMP_COMMANDS[2]
    peer.answers[command] = ma.dump_text(ma.GOLDEN_HEX)[1:]

    with pytest.raises(ProtocolError, match="not 124 bytes and OK") as caught:
        ma.measured(peer)

    assert caught.value.raw == peer.answers[command]


@pytest.mark.parametrize(
    "damage",
    [
        lambda text: b"0" + text,
        lambda text: b"G" + text[1:],
        lambda text: text.replace(b"OK", b"ERROR OK"),
        lambda text: b"MA68II REPORT\r\n400 1.00 2.00\r\n" + text,
    ],
    ids=["249 digits", "no digit", "error before OK", "report before"],
)
def test_anything_but_the_digits_is_refused(peer, damage):
    command = ma.DUMP_COMMANDS[4]
    peer.answers[command] = damage(peer.answers[command])

    with pytest.raises(ProtocolError, match="not 124 bytes and OK") as caught:
        ma.measured(peer)

    assert caught.value.raw == peer.answers[command]


@pytest.mark.parametrize("answer", [b"A1 04 00", b"?\r\n", b"REPORT\r\n400 1.00\r\n"])
def test_dump_without_an_end_is_refused(peer, answer):
    peer.answers[ma.DUMP_COMMANDS[1]] = answer

    with pytest.raises(ProtocolError, match=f"stopped after {len(answer)} ") as caught:
        ma.measured(peer)

    assert caught.value.raw == answer


def test_silence_in_place_of_a_dump_is_a_timeout(peer):
    del peer.answers[ma.DUMP_COMMANDS[0]]

    with pytest.raises(LinkTimeoutError, match="sent nothing within 5 s"):
        ma.measured(peer)


def test_flood_in_place_of_a_report_is_refused(peer):
    peer.report = b"\x00" * 70000

    with pytest.raises(ProtocolError, match="more than 65536 bytes"):
        ma.measured(peer)


@pytest.mark.parametrize("pause_s", [0.0, 0.01, 0.15])
@pytest.mark.parametrize("which", range(3))
def test_answer_sent_twice_is_never_a_press(peer, which, pause_s):
    command = (b"v\r", b"ys\r", b"00A04Cw\r")[which]
    answer = peer.answers[command]
    peer.answers[command] = (answer, pause_s, answer)
    peer.report = ()

    with pytest.raises(LinkTimeoutError, match="within 300 s"):
        ma.measured(peer)


def test_late_calibration_answer_does_not_confirm_the_arming(peer):
    answer = peer.answers[b"ys\r"]
    peer.answers |= {b"ys\r": (answer, 0.01, answer), b"00A04Cw\r": b"?\r\n"}

    with pytest.raises(InstrumentError, match="to '00A04Cw'"):
        ma.measured(peer)

    assert peer.sentences == []


@pytest.mark.parametrize("which", range(4))
def test_dump_sent_twice_at_once_does_no_harm(peer, which):
    command = ma.DUMP_COMMANDS[which]
    peer.answers[command] *= 2

    assert np.array_equal(ma.measured(peer).spectra.factors, ma.GOLDEN)


@pytest.mark.parametrize("which", range(4))
def test_dump_that_comes_again_later_is_refused(peer, which):
    first, second = ma.DUMP_COMMANDS[which : which + 2]
    peer.answers[second] = (peer.answers[first], 0.01, peer.answers[second])

    with pytest.raises(ProtocolError, match="two geometries hold the same values"):
        ma.measured(peer)


def test_memory_never_filled_is_no_reading(peer):
    for command in ma.DUMP_COMMANDS:
        peer.answers[command] = ma.dump_text("00" * 124)

    with pytest.raises(InstrumentError, match="holds no reading"):
        ma.measured(peer)


def test_unchanged_memory_is_no_second_reading(peer):
    driver = ma.connect(peer)
    driver.measure(peer.press)

    with pytest.raises(InstrumentError, match="previous reading once more"):
        driver.measure(peer.press)

    peer.answers[ma.DUMP_COMMANDS[3]] = ma.dump_text(ma.shifted_hex(301))
    assert driver.measure(peer.press).spectra.factors[3, 0] == 1486 / 32768


def test_negative_noise_is_kept(peer):
    dark = (-5).to_bytes(4, "little", signed=True).hex() * 31
    peer.answers[ma.DUMP_COMMANDS[4]] = ma.dump_text(dark)

    assert ma.measured(peer).spectra.factors[4, 0] == -5 / 32768


def test_damaged_high_digits_are_implausible(peer):
    peer.answers[ma.DUMP_COMMANDS[0]] = ma.dump_text("A1040010" + ma.GOLDEN_HEX[8:])

    with pytest.raises(ProtocolError, match="outside -10 to 1000 %"):
        ma.measured(peer)


@pytest.mark.parametrize("cut", range(0, 380, 19))
def test_no_cut_of_a_dump_makes_a_reading(peer, cut):
    command = ma.DUMP_COMMANDS[4]
    peer.answers[command] = peer.answers[command][:cut]

    with pytest.raises((ProtocolError, LinkTimeoutError), match=r"stopped|nothing"):
        ma.measured(peer)
