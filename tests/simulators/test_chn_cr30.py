"""The simulated CR30 against docs/wire/chn_cr30.md."""

from __future__ import annotations

import struct

import numpy as np
import pytest

from paintlink_simulators import ManualClock, Panel, chn_cr30
from paintlink_simulators.paint import Repeatability

EXACT = Repeatability(gain=0.0, floor=0.0)
TRIGGER_S, CALIBRATION_S = 0.3, 1.0
# Measured on a real unit and published in itohio/color-science (cr30reader, MIT).
REAL_CHUNKS = {
    0x10: "bb0110000000a468b040b174e64086130141f49c094199031341bbd81e41b94b2b417569394"
    "1648049411fb159418b716641168c684100000000ff37",
    0x11: "bb0111000000ef595d41350a4841fe333041c42c1941c61e05415d00ea404aabcd403587ae4"
    "0c45b9340486b874061768b40658f8d4000000000ff92",
    0x12: "bb01120000001bb68a40f2278a409ee68c4090589340567b9a407a07a1400260a6400000000"
    "00000000000000000000000000000000000000000ffab",
    0x13: "bb01130000000000000000000000000000000000000000000000000000000000"
    "0000a468b040b174e64086130141f49c09419903134100000000ffba",
}
REAL_PERCENT = [
    *(5.51, 7.20, 8.07, 8.60, 9.19, 9.93, 10.71, 11.59, 12.59, 13.61, 14.40, 14.53),
    *(13.83, 12.50, 11.01, 9.57, 8.32, 7.31, 6.43, 5.45, 4.60, 4.23, 4.36, 4.42),
    *(4.33, 4.32, 4.40, 4.60, 4.83, 5.03, 5.20),
]
IDENTITY = {
    0x00: "aa0a0000005600190353494d3030303030303100000000000000000000000000000000000000"
    "0043523330000000000000000000000000000000ff57",
    0x01: "aa0a010000000000000000000000000000000053494d30303030303032"
    "00000000000000000000000000000000000000005631312e332e000000ff36",
    0x02: "aa0a020000302e302e3230323331323139000000000000000000000000"
    "5631302e302e302e300000000000000000000000000000000000000000ffd6",
    0x03: "aa0a03000000000000000000000000000000000200000000000000000000"
    "00000000000000000000000000000000000000000000000000000000ffb8",
}


def frame(*head: int, marker: int = 0xFF) -> bytes:
    body = bytes(head).ljust(58, b"\0") + bytes([marker])
    return body + bytes([sum(body) % 256])


def real_panel() -> Panel:
    percent = np.concatenate([
        np.frombuffer(bytes.fromhex(REAL_CHUNKS[sub])[6:54], "<f4")
        for sub in (0x10, 0x11, 0x12)
    ])[:31]
    return Panel(np.array([45.0]), percent[None].astype(float) / 100.0)


@pytest.fixture
def meter(clock: ManualClock) -> chn_cr30.ChnCr30:
    return chn_cr30.create(real_panel(), clock=clock, repeatability=EXACT)


def after(meter: chn_cr30.ChnCr30, clock: ManualClock, seconds: float) -> bytes:
    clock.advance(seconds)
    return meter.poll()


def measured(meter: chn_cr30.ChnCr30, clock: ManualClock) -> None:
    assert meter.feed(frame(0xBB, 1, 0)) == b""
    assert after(meter, clock, TRIGGER_S) == frame(0xBB, 1, 0)


def percent_of(meter: chn_cr30.ChnCr30) -> np.ndarray:
    chunks = [meter.feed(frame(0xBB, 1, sub))[6:54] for sub in (0x10, 0x11, 0x12)]
    return np.frombuffer(b"".join(chunks), "<f4")[:31]


@pytest.mark.parametrize("sub", sorted(IDENTITY))
def test_identity_replies_are_golden(meter: chn_cr30.ChnCr30, sub: int) -> None:
    assert meter.feed(frame(0xAA, 0x0A, sub)).hex() == IDENTITY[sub]


def test_real_spectrum_is_sent_byte_by_byte(
    meter: chn_cr30.ChnCr30, clock: ManualClock
) -> None:
    measured(meter, clock)

    sent = {sub: meter.feed(frame(0xBB, 1, sub)).hex() for sub in REAL_CHUNKS}

    assert sent == REAL_CHUNKS
    np.testing.assert_allclose(percent_of(meter), REAL_PERCENT, atol=0.005)


def test_headers_tell_host_from_button(
    meter: chn_cr30.ChnCr30, clock: ManualClock
) -> None:
    measured(meter, clock)
    host = meter.feed(frame(0xBB, 1, 9))
    button = meter.press()

    assert host == bytes.fromhex("bb010900281f0a" + "00" * 51 + "ff15")
    assert button == bytes.fromhex("bb010900281f0a" + "00" * 51 + "0016")


@pytest.mark.parametrize(
    "writes",
    [(30, 30), (59, 1), (1, 59), (20, 20, 20), (120,), (180,), (61,), (0,)],
)
def test_split_and_joined_frames_get_silence_then_work_again(
    meter: chn_cr30.ChnCr30, writes: tuple[int, ...]
) -> None:
    stream = frame(0xAA, 0x0A, 0) * 3
    sent = b""
    for size in writes:
        sent += meter.feed(stream[:size])
        stream = stream[size:]

    assert sent == b""
    assert meter.feed(frame(0xAA, 0x0A, 0)).hex() == IDENTITY[0]


def test_request_checksum_and_marker_are_ignored(meter: chn_cr30.ChnCr30) -> None:
    wrong = frame(0xAA, 0x0A, 0)[:58] + b"\x00\x00"

    assert meter.feed(wrong).hex() == IDENTITY[0]


def test_request_bytes_survive_where_the_device_writes_none(
    meter: chn_cr30.ChnCr30,
) -> None:
    request = bytearray(frame(0xAA, 0x0A, 0))
    request[4], request[55:58] = 0x11, b"\x22\x33\x44"

    reply = meter.feed(bytes(request))

    assert reply[4] == 0x11
    assert reply[55:58] == b"\x22\x33\x44"
    assert sum(reply[:59]) % 256 == reply[59]


@pytest.mark.parametrize("head", [(0xBB, 0x17, 0), (0xBB, 0x28, 0), (0xAA, 0x0A, 9)])
def test_what_is_not_implemented_comes_back(
    meter: chn_cr30.ChnCr30, head: tuple[int, ...]
) -> None:
    assert meter.feed(frame(*head)) == frame(*head)


def test_no_chunk_exists_before_the_first_reading(meter: chn_cr30.ChnCr30) -> None:
    assert meter.feed(frame(0xBB, 1, 0x10)) == frame(0xBB, 1, 0x10)
    assert meter.feed(frame(0xBB, 1, 9))[4:7] == b"\0\0\0"


def test_unknown_start_gets_silence(meter: chn_cr30.ChnCr30) -> None:
    assert meter.feed(frame(0xCC, 1, 9)) == b""


def test_calibration_replies_are_golden(
    meter: chn_cr30.ChnCr30, clock: ManualClock
) -> None:
    meter.feed(frame(0xBB, 0x10, 0))
    black = after(meter, clock, CALIBRATION_S)
    meter.plate_on = True
    meter.feed(frame(0xBB, 0x11, 0))
    white = after(meter, clock, CALIBRATION_S)

    assert black == bytes.fromhex("bb1000000000" + "01" + "00" * 51 + "ffcb")
    assert white == bytes.fromhex("bb1100000000" + "01" + "00" * 51 + "ffcc")


def test_white_calibration_beside_the_tile_spoils_the_reference(
    meter: chn_cr30.ChnCr30, clock: ManualClock
) -> None:
    meter.feed(frame(0xBB, 0x11, 0))

    assert after(meter, clock, CALIBRATION_S)[6] == 0
    measured(meter, clock)
    np.testing.assert_allclose(
        percent_of(meter), np.array(REAL_PERCENT) * 1.4, atol=0.01
    )


def test_reading_with_the_cap_on_spoils_the_reference(
    meter: chn_cr30.ChnCr30, clock: ManualClock
) -> None:
    meter.plate_on = True
    meter.press()

    assert meter.feed(frame(0xBB, 1, 9))[24] == 1
    assert (percent_of(meter) == 90.0).all()
    meter.plate_on = False
    meter.press()
    assert percent_of(meter)[0] == pytest.approx(5.51 * 1.4, abs=0.01)


def test_frames_wait_while_it_measures(
    meter: chn_cr30.ChnCr30, clock: ManualClock
) -> None:
    meter.feed(frame(0xBB, 1, 0))
    assert meter.feed(frame(0xBB, 1, 9)) == b""
    assert meter.press() == b""

    sent = after(meter, clock, TRIGGER_S)

    assert [sent[:3], sent[60:63]] == [b"\xbb\x01\x00", b"\xbb\x01\x09"]


def test_it_falls_asleep_until_the_line_is_opened_anew(clock: ManualClock) -> None:
    meter = chn_cr30.create(real_panel(), clock=clock, idle_s=600.0)
    clock.advance(601.0)

    assert meter.feed(frame(0xAA, 0x0A, 0)) == b""
    assert meter.feed(frame(0xAA, 0x0A, 0)) == b""
    meter.disconnect()
    assert meter.feed(frame(0xAA, 0x0A, 0)).hex() == IDENTITY[0]


@pytest.mark.parametrize("condition", ["warming", "battery_low", "memory_full"])
def test_every_other_condition_is_silence(clock: ManualClock, condition: str) -> None:
    meter = chn_cr30.create(real_panel(), clock=clock, condition=condition)

    assert meter.feed(frame(0xAA, 0x0A, 0)) == meter.press() == b""


def test_values_are_little_endian_floats(
    meter: chn_cr30.ChnCr30, clock: ManualClock
) -> None:
    measured(meter, clock)

    (first,) = struct.unpack_from("<f", meter.feed(frame(0xBB, 1, 0x10)), 6)

    assert first == pytest.approx(5.51, abs=0.005)
