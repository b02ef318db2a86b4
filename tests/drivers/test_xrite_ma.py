import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.errors import (
    ConfigError,
    InstrumentError,
    LinkTimeoutError,
    NeedsCalibrationError,
    WrongInstrumentError,
)
from paintlink.instrument import load_driver, parse_geometry
from paintlink.model import Instrument
from tests.drivers import ma_peer as ma

ANGLES_DEG = (15, 25, 45, 75, 110)


def test_golden_texts_have_the_published_lengths():
    lengths = [len(ma.dump_text(ma.GOLDEN_HEX, grouping)) for grouping in (0, 16, 8)]

    assert lengths == [380, 385, 393]
    assert ma.shifted_hex(0).upper() == ma.GOLDEN_HEX


def test_golden_transcript_gives_the_golden_reading(peer):
    driver = ma.connect(peer)

    identity = driver.identify()
    reading = driver.measure(peer.press)

    assert identity == Instrument("X-Rite", "MA68II", firmware="3.02")
    assert peer.sent == [b"v\r", b"ys\r", b"00A04Cw\r", *ma.DUMP_COMMANDS]
    assert np.array_equal(reading.spectra.factors, ma.GOLDEN)
    assert reading.spectra.wavelengths_nm.tolist() == list(range(400, 701, 10))
    assert reading.geometries == tuple(
        parse_geometry(f"45as{angle}") for angle in ANGLES_DEG
    )
    assert reading.raw == b"".join(
        peer.answers[command] for command in ma.DUMP_COMMANDS
    )
    assert (reading.averaged, reading.data_mode, reading.lab) == (1, "", None)
    assert peer.sentences == ["Set the instrument on the panel and press it down."]


def test_published_integers_give_the_published_percents():
    values = {1185: 3.616, 39322: 120.0, 1140: 3.48, 8949: 27.31, 20296: 61.94}
    factors = load_driver("xrite_ma").factors

    for integer, percent in values.items():
        dump = (integer.to_bytes(4, "little").hex() * 31).encode() + b"OK"
        assert 100 * factors(dump)[0] == pytest.approx(percent, abs=0.005)


def test_published_hex_of_120_percent_reads_back():
    dump = b"9A 99 00 00 " * 31 + b"\r\nOK\r\n"

    assert load_driver("xrite_ma").factors(dump)[30] == pytest.approx(1.2, abs=2e-5)


@pytest.mark.parametrize("grouping", [0, 8, 16])
def test_white_space_of_the_dump_does_not_matter(grouping):
    peer = ma.Peer(ma.golden_answers(grouping=grouping), report=ma.golden_report())

    assert np.array_equal(ma.measured(peer).spectra.factors, ma.GOLDEN)


@pytest.mark.parametrize("end", [b"\r\n", b"\r", b"\n"])
@pytest.mark.parametrize("echo", [False, True])
@pytest.mark.parametrize("cuts", [(1,), (4096,)])
def test_line_ends_echo_and_pieces_do_not_matter(end, echo, cuts):
    answers = {
        command: answer.replace(b"\r\n", end)
        for command, answer in ma.golden_answers().items()
    }
    report = ma.golden_report().replace(b"\r\n", end)
    peer = ma.Peer(answers, report=report, cuts=cuts, echo=echo)

    assert np.array_equal(ma.measured(peer).spectra.factors, ma.GOLDEN)


def test_answers_without_line_end_are_ended_by_silence():
    answers = {
        command: answer.rstrip() for command, answer in ma.golden_answers().items()
    }
    peer = ma.Peer(answers, report=b"PRESSED")

    assert np.array_equal(ma.measured(peer).spectra.factors, ma.GOLDEN)


@settings(deadline=None)
@given(cuts=st.lists(st.integers(1, 400), min_size=1, max_size=40))
def test_any_chunking_gives_the_same_reading(cuts):
    report = ma.golden_report()
    peer = ma.Peer(ma.golden_answers(), report=report, cuts=tuple(cuts))

    assert np.array_equal(ma.measured(peer).spectra.factors, ma.GOLDEN)


def test_ma58_has_three_angles():
    peer = ma.Peer(ma.golden_answers("MA58"), report=b"REPORT\r\n")
    driver = ma.connect(peer, {"serial": "000123"})

    identity = driver.identify()
    reading = driver.measure(peer.press)

    assert identity == Instrument("X-Rite", "MA58", "000123", "3.02")
    assert [geometry.code for geometry in reading.geometries] == [
        *("45as25", "45as45", "45as75"),
    ]
    assert peer.sent[-3:] == list(ma.DUMP_COMMANDS[:3])
    assert np.array_equal(reading.spectra.factors, ma.GOLDEN[:3])


@pytest.mark.parametrize(
    ("answer", "model", "firmware"),
    [
        (b"X-RITE MA68 1.10\r\n", "MA68", "1.10"),
        (b"X-RITE\r\nMA68II\r\n", "MA68II", ""),
        (b"X-RITE MA58\r\n", "MA58", ""),
        (b"(c) X-RITE INC. MA68II REV 3.02B\r\n", "MA68II", "3.02"),
    ],
)
def test_identity_is_read_from_any_spelling(peer, answer, model, firmware):
    peer.answers[b"v\r"] = answer

    identity = ma.connect(peer).identify()

    assert (identity.model, identity.firmware) == (model, firmware)


@pytest.mark.parametrize(
    "answer", [b"X-RITE MA98 1.00\r\n", b"X-RITE SP62\r\n", b"OK00,CM-512\r", b"?\r\n"]
)
def test_other_instrument_is_told_apart(peer, answer):
    peer.answers[b"v\r"] = answer
    text = answer.decode().strip()

    with pytest.raises(WrongInstrumentError, match="answered") as caught:
        ma.connect(peer).identify()

    assert caught.value.code == text


def test_identity_is_asked_three_times():
    peer = ma.Peer({})

    with pytest.raises(LinkTimeoutError, match="sent nothing within 2 s"):
        ma.connect(peer).identify()

    assert peer.sent == [b"v\r"] * 3
    assert peer.now_s == pytest.approx(6.0)


def test_half_sent_line_before_identity_does_no_harm(peer):
    answers = [b"?\r\n", peer.answers[b"v\r"]]
    peer.answers[b"v\r"] = b""

    class Disturbed(ma.Peer):
        def write(self, data):
            super().write(data)
            self.say(answers.pop(0))

    disturbed = Disturbed(peer.answers)

    assert ma.connect(disturbed).identify().model == "MA68II"


@pytest.mark.parametrize(
    ("answer", "state"),
    [(b"CALIBRATION OK\r\n", "valid"), (b"CALIBRATION NEEDED\r\n", "needed")],
)
def test_calibration_state_is_asked(peer, answer, state):
    peer.answers[b"ys\r"] = answer

    assert ma.connect(peer).calibration() == state


def test_uncalibrated_instrument_is_not_armed(peer):
    peer.answers[b"ys\r"] = b"CALIBRATION NEEDED\r\n"

    with pytest.raises(NeedsCalibrationError, match="calibrate it on its white plaque"):
        ma.measured(peer)

    assert b"00A04Cw\r" not in peer.sent
    assert peer.sentences == []


def test_calibration_lost_before_the_press_is_no_reading(peer):
    peer.report = b"CALIBRATION NEEDED\r\n"

    with pytest.raises(NeedsCalibrationError, match="not calibrated"):
        ma.measured(peer)

    assert peer.sent[-1] == b"00A04Cw\r"


def test_calibration_follows_the_published_sequence(peer):
    peer.answers |= {
        b"p\r": b"RESET\r\n",
        b"3ys\r": b"CALIBRATION NEEDED\r\n",
        b"yw\r": (90.0, b"...\r\n", 4.0, b"OK\r\n"),
    }

    ma.connect(peer).calibrate(peer.sentences.append)

    assert peer.sent == [b"p\r", b"3ys\r", b"yw\r", b"ys\r"]
    assert peer.sentences == [
        "Set the instrument on its white plaque and press it down."
    ]


def test_calibration_beside_the_plaque_is_refused(peer):
    peer.answers |= {
        b"p\r": b"RESET\r\n",
        b"3ys\r": b"CALIBRATION NEEDED\r\n",
        b"yw\r": b"CALIBRATION ERROR\r\n",
    }

    with pytest.raises(InstrumentError, match="'CALIBRATION ERROR' to 'yw'") as caught:
        ma.connect(peer).calibrate(peer.sentences.append)

    assert caught.value.code == "CALIBRATION ERROR"


def test_calibration_must_be_confirmed(peer):
    peer.answers |= {
        b"p\r": b"RESET\r\n",
        b"3ys\r": b"CALIBRATION NEEDED\r\n",
        b"yw\r": b"OK\r\n",
        b"ys\r": b"CALIBRATION NEEDED\r\n",
    }
    peer.report = b""

    with pytest.raises(InstrumentError, match="white calibration failed: clean"):
        ma.connect(peer).calibrate(peer.press)


def test_nobody_closing_the_plaque_ends_the_calibration(peer):
    peer.answers |= {b"p\r": b"RESET\r\n", b"3ys\r": b"CALIBRATION\r\n"}
    peer.report = b""

    with pytest.raises(LinkTimeoutError, match="within 120 s"):
        ma.connect(peer).calibrate(peer.press)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"mode": "lisen"}, r"option mode = 'lisen', did you mean 'listen'\?"),
        ({"press_timeout_s": 0}, "option press_timeout_s = 0: must be a number from 1"),
        ({"sample_columns": [2, 4]}, "must be 5 different whole numbers"),
        ({"trigger": "host"}, "unknown option 'trigger'; known: mode, model, serial"),
    ],
)
def test_wrong_options_are_refused(peer, options, text):
    with pytest.raises(ConfigError, match=text):
        ma.connect(peer, options)


def test_driver_says_it_never_met_hardware():
    info = load_driver("xrite_ma").INFO

    assert not info.hardware_tested
    assert info.label == "X-Rite MA58, MA68, MA68II"
    assert info.serial.summary == "9600 8N1"
    assert {name: len(angles) for name, angles in info.models.items()} == {
        **{"MA58": 3, "MA68": 5, "MA68II": 5},
    }
