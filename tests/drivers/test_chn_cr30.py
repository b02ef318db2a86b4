import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.color import normalise
from paintlink.errors import (
    InstrumentError,
    LinkTimeoutError,
    NeedsCalibrationError,
    ProtocolError,
    ReadingError,
    WrongInstrumentError,
)
from paintlink.instrument import load_driver
from paintlink.model import Instrument, Reading
from tests.drivers.peer import Peer, connect

# docs/wire/chn_cr30.md, section 5. The spectral frames were measured on a real unit and
# published in itohio/color-science, cr30reader (MIT).
CHUNKS = [
    bytes.fromhex(text)
    for text in (
        "bb0110000000a468b040b174e64086130141f49c094199031341bbd81e41b94b2b41756939416480"
        "49411fb159418b716641168c684100000000ff37",
        "bb0111000000ef595d41350a4841fe333041c42c1941c61e05415d00ea404aabcd403587ae40c45b"
        "9340486b874061768b40658f8d4000000000ff92",
        "bb01120000001bb68a40f2278a409ee68c4090589340567b9a407a07a1400260a640000000000000"
        "000000000000000000000000000000000000ffab",
    )
]
IDENTITY = bytes.fromhex(
    "aa0a0000005600190353494d303030303030310000000000000000000000000000000000000000435233"
    "30000000000000000000000000000000ff57"
)
FIRMWARE = bytes.fromhex(
    "aa0a020000302e302e32303233313231390000000000000000000000005631302e302e302e3000000000"
    "00000000000000000000000000000000ffd6"
)
PERCENT = (
    *(5.51, 7.20, 8.07, 8.60, 9.19, 9.93, 10.71, 11.59, 12.59, 13.61, 14.40, 14.53),
    *(13.83, 12.50, 11.01, 9.57, 8.32, 7.31, 6.43, 5.45, 4.60, 4.23, 4.36, 4.42),
    *(4.33, 4.32, 4.40, 4.60, 4.83, 5.03, 5.20),
)


def frame(head, marker=0xFF, **at):
    """Return a frame; keywords such as ``b6=1`` set bytes of it."""
    body = bytearray(bytes.fromhex(head).ljust(58, b"\0") + bytes([marker]))
    for name, value in at.items():
        body[int(name[1:])] = value
    return bytes(body) + bytes([sum(body) % 256])


HOST = frame("bb010900281f0a")
BUTTON = frame("bb010900281f0a", marker=0)


def answers():
    return {
        frame("aa0a00"): IDENTITY,
        frame("aa0a02"): FIRMWARE,
        frame("bb0100"): (0.3, frame("bb0100")),
        frame("bb0109"): HOST,
        **{frame(chunk[:3].hex()): chunk for chunk in CHUNKS},
        frame("bb1000"): (1.0, frame("bb1000", b6=1)),
        frame("bb1100"): (1.0, frame("bb1100", b6=1)),
    }


@pytest.fixture
def peer():
    return Peer(answers(), report=BUTTON)


def driver(peer, **options):
    return connect("chn_cr30", peer, options)


def measured(peer, **options):
    return driver(peer, **options).measure(peer.sentences.append)


def pressed(peer):
    return driver(peer, trigger="button").measure(peer.press)


@pytest.mark.parametrize(
    ("head", "checksum"),
    [
        *(("aa0a00", 0xB3), ("aa0a02", 0xB5), ("bb1000", 0xCA), ("bb1100", 0xCB)),
        *(("bb0100", 0xBB), ("bb0109", 0xC4), ("bb0110", 0xCB), ("bb0112", 0xCD)),
    ],
)
def test_request_frames_have_the_published_checksums(head, checksum):
    assert frame(head)[59] == checksum
    assert (HOST[-2:], BUTTON[-2:]) == (b"\xff\x15", b"\x00\x16")


def test_real_frames_give_the_published_percents(peer):
    reading = measured(peer)

    assert np.round(100 * reading.spectra.factors[0], 2).tolist() == list(PERCENT)
    assert reading.spectra.wavelengths_nm.tolist() == list(range(400, 701, 10))
    assert [one.code for one in reading.geometries] == ["45as45"]
    assert reading.raw == b"".join((HOST, *CHUNKS))
    assert peer.sent == [
        frame(head) for head in ("bb0100", "bb0109", "bb0110", "bb0111", "bb0112")
    ]
    assert peer.sentences == ["Set the instrument on the panel and hold it still."]


def test_every_request_is_one_write_of_60_bytes(peer):
    reader = driver(peer)
    reader.identify()
    reader.calibrate(peer.sentences.append)
    reader.measure(peer.sentences.append)

    assert {len(data) for data in peer.sent} == {60}


def test_button_needs_no_request_for_the_header(peer):
    reading = pressed(peer)

    assert np.round(100 * reading.spectra.factors[0], 2).tolist() == list(PERCENT)
    assert reading.raw[:60] == BUTTON
    assert peer.sent == [frame(head) for head in ("bb0110", "bb0111", "bb0112")]


def test_identity_is_the_model_and_nothing_less(peer):
    assert driver(peer).identify() == Instrument(
        "CHNSpec", "CR30", "SIM0000001", "V10.0.0.0"
    )


def test_another_device_behind_the_same_adapter_is_told_apart(peer):
    peer.answers[frame("aa0a00")] = frame("aa0a00", b39=67, b40=82, b41=51, b42=49)

    with pytest.raises(
        WrongInstrumentError, match="not a CR30: it calls itself 'CR31'"
    ):
        driver(peer).identify()


def test_adapter_that_echoes_is_no_instrument(peer):
    peer.answers[frame("aa0a00")] = frame("aa0a00")

    with pytest.raises(InstrumentError, match="does not know the command aa 0a 00"):
        driver(peer).identify()


def test_echo_before_each_answer_does_no_harm(peer):
    table = answers()
    for request, answer in table.items():
        table[request] = (request, answer) if isinstance(answer, bytes) else answer

    assert measured(Peer(table)).raw == b"".join((HOST, *CHUNKS))


def test_silent_node_wants_replugging(peer):
    peer.answers.clear()

    with pytest.raises(LinkTimeoutError, match="is silent: plug it out and in again"):
        driver(peer).identify()

    assert peer.now_s == pytest.approx(1.0, abs=0.1)


def test_press_between_request_and_reply_starts_the_fetch_anew(peer):
    peer.answers[frame("bb0111")] = [(BUTTON, CHUNKS[1]), CHUNKS[1]]

    reading = measured(peer)

    assert np.round(100 * reading.spectra.factors[0], 2).tolist() == list(PERCENT)
    assert peer.sent[-3:] == [frame(h) for h in ("bb0110", "bb0111", "bb0112")]


def test_button_that_is_never_left_alone_is_refused(peer):
    peer.answers[frame("bb0111")] = BUTTON

    with pytest.raises(InstrumentError, match="pressed again and again"):
        measured(peer)


@pytest.mark.parametrize("place", [*range(7), 24, 33, 58, 59])
def test_damaged_chunk_is_never_part_of_a_reading(peer, place):
    damaged = bytearray(CHUNKS[1])
    damaged[place] ^= 0x10
    peer.answers[frame("bb0111")] = bytes(damaged)

    with pytest.raises(LinkTimeoutError, match="is silent"):
        measured(peer)


@pytest.mark.parametrize(
    "junk", [b"\x00", b"\xbb" * 59, b"\xbb\x01\x11" * 20, HOST[:59]]
)
def test_junk_before_a_frame_is_passed_over(peer, junk):
    peer.answers[frame("bb0111")] = (junk, CHUNKS[1])

    assert measured(peer).raw == b"".join((HOST, *CHUNKS))


def test_frame_that_comes_twice_is_dropped(peer):
    for head in ("bb0110", "bb0111", "bb0112"):
        answer = peer.answers[frame(head)]
        peer.answers[frame(head)] = (answer, answer)

    assert measured(peer).raw == b"".join((HOST, *CHUNKS))


def test_header_that_comes_twice_does_no_harm(peer):
    peer.answers[frame("bb0109")] = (HOST, HOST)

    assert measured(peer).raw == b"".join((HOST, *CHUNKS))


def test_other_wavelength_axis_is_refused(peer):
    peer.answers[frame("bb0109")] = frame("bb010900281f14")

    with pytest.raises(ProtocolError, match="another wavelength axis") as caught:
        measured(peer)

    assert caught.value.raw == frame("bb010900281f14")


def test_magnetic_cap_is_told(peer):
    peer.answers[frame("bb0109")] = frame("bb010900281f0a", b24=1)

    with pytest.raises(InstrumentError, match="cap is on: take it off, calibrate"):
        measured(peer)


def test_previous_reading_once_more_is_refused(peer):
    reader = driver(peer)
    reader.measure(peer.sentences.append)

    with pytest.raises(InstrumentError, match="previous reading once more"):
        reader.measure(peer.sentences.append)


def bright(percent):
    floats = struct.pack("<f", percent)
    return frame("bb0110", **{f"b{6 + i}": floats[i % 4] for i in range(48)})


def test_brighter_than_white_wants_a_calibration(peer):
    peer.answers[frame("bb0110")] = bright(106.0)

    with pytest.raises(NeedsCalibrationError, match="brighter than white: calibrate"):
        measured(peer)


@pytest.mark.parametrize("percent", [float("nan"), float("inf"), 1e30, -50.0])
def test_impossible_values_are_refused(peer, percent):
    peer.answers[frame("bb0110")] = bright(percent)

    with pytest.raises(ProtocolError, match="reflectance factors outside"):
        measured(peer)


def test_calibration_is_black_then_white(peer):
    driver(peer).calibrate(peer.sentences.append)

    assert peer.sent == [frame("bb1000"), frame("bb1100")]
    assert [sentence[:4] for sentence in peer.sentences] == ["Hold", "Set "]


def test_calibration_must_be_confirmed(peer):
    peer.answers[frame("bb1100")] = frame("bb1100", b6=0, b7=1)

    with pytest.raises(InstrumentError, match="did not confirm the calibration"):
        driver(peer).calibrate(peer.sentences.append)


def test_calibration_state_cannot_be_asked(peer):
    assert driver(peer).calibration() == "unknown"
    assert peer.sent == []


def test_nobody_at_the_button_ends_the_wait(peer):
    peer.report = b""

    with pytest.raises(LinkTimeoutError, match="within 300 s"):
        pressed(peer)


@settings(deadline=None, max_examples=30)
@given(cuts=st.lists(st.integers(1, 70), min_size=1, max_size=20))
def test_any_chunking_gives_the_same_reading(cuts):
    peer = Peer(answers(), cuts=tuple(cuts))

    assert measured(peer).raw == b"".join((HOST, *CHUNKS))


def test_readings_serve_solid_colours_only(peer, aware_now):
    instrument = Instrument("CHNSpec", "CR30")
    reading = Reading(measured(peer), instrument, aware_now, "simulated", sample="s")

    assert len(normalise(reading, finish="solid").samples) == 3
    with pytest.raises(ReadingError, match="declare the paint solid"):
        normalise(reading)


def test_driver_says_it_never_met_hardware():
    assert not load_driver("chn_cr30").INFO.hardware_tested
