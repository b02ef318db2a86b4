import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.errors import InstrumentError, LinkTimeoutError, ProtocolError
from paintlink.model import Instrument
from tests.drivers import ma_peer as ma

WAVELENGTHS_NM = np.arange(400, 701, 10)
SAMPLES = 10 * np.arange(5)[:, None] + WAVELENGTHS_NM / 100
LISTEN = {"mode": "listen"}


def listening(peer, **options):
    return ma.connect(peer, {**LISTEN, **options}).measure(peer.sentences.append)


def test_printed_report_is_a_reading():
    report = ma.golden_report()
    peer = ma.Peer({})
    peer.say(report)

    reading = listening(peer)

    assert np.allclose(reading.spectra.factors, SAMPLES / 100, rtol=0, atol=1e-12)
    assert [geometry.aspecular_deg for geometry in reading.geometries] == [
        *(15, 25, 45, 75, 110),
    ]
    assert reading.raw == report
    assert peer.sent == []


def test_recorded_percents_are_read_at_45_degrees():
    recorded = {400: 3.48, 500: 27.31, 550: 61.94, 700: 65.0}
    peer = ma.Peer({})
    peer.say(ma.report_text(lambda k, nm: recorded.get(nm, 30.0 + k)))

    spectra = listening(peer).spectra

    for wavelength_nm, percent in recorded.items():
        band = spectra.wavelengths_nm.tolist().index(wavelength_nm)
        assert spectra.factors[2, band] == pytest.approx(percent / 100)


def test_columns_follow_the_configuration():
    peer = ma.Peer({})
    peer.say(ma.golden_report())

    reading = listening(peer, sample_columns=[10, 8, 6, 4, 2])

    assert np.allclose(reading.spectra.factors, SAMPLES[::-1] / 100)


def test_rows_of_ten_tokens_serve_narrower_columns():
    rows = [line.split() for line in ma.golden_report().splitlines()]
    report = b"\r\n".join(b" ".join(row[:10]) for row in rows) + b"\r\n"
    peer = ma.Peer({})
    peer.say(report)

    assert listening(peer, sample_columns=[2, 4, 6, 8, 9])
    peer.say(report)
    with pytest.raises(ProtocolError, match=r"0 usable rows, expected 31.*10 numbers"):
        listening(peer)


def test_reports_in_a_row_are_readings_in_a_row():
    peer = ma.Peer({})
    second = ma.report_text(lambda k, nm: 1.0 + k + nm / 100)
    peer.say(ma.golden_report() + second)
    driver = ma.connect(peer, LISTEN)

    readings = [driver.measure(peer.sentences.append) for _ in range(2)]

    assert readings[0].spectra.factors[0, 0] == pytest.approx(0.04)
    assert readings[1].spectra.factors[0, 0] == pytest.approx(0.05)
    assert readings[1].raw.strip() == second.strip()


@settings(deadline=None)
@given(cuts=st.lists(st.integers(1, 900), min_size=1, max_size=20))
def test_chunking_never_changes_a_report(cuts):
    peer = ma.Peer({}, cuts=tuple(cuts))
    peer.say(ma.golden_report())

    assert np.allclose(listening(peer).spectra.factors, SAMPLES / 100)


@pytest.mark.parametrize("end", [b"\r", b"\n", b""])
def test_last_row_ends_in_anything(end):
    peer = ma.Peer({})
    peer.say(ma.golden_report().rstrip() + end)

    assert np.allclose(listening(peer).spectra.factors, SAMPLES / 100)


@pytest.mark.parametrize("rows", range(36))
def test_report_cut_before_its_last_row_is_refused(rows):
    report = ma.report_text(lambda _k, _nm: 20.0, rows=rows)
    peer = ma.Peer({})
    peer.say(report)

    with pytest.raises(ProtocolError, match=f"stopped after {len(report)}") as caught:
        listening(peer)

    assert caught.value.raw == report


def test_lost_row_is_refused():
    peer = ma.Peer({})
    peer.say(ma.golden_report().replace(b"550 ", b"5 0 "))

    with pytest.raises(ProtocolError, match="30 usable rows, expected 31"):
        listening(peer)


def test_same_report_twice_is_refused():
    peer = ma.Peer({})
    peer.say(ma.golden_report() * 2)
    driver = ma.connect(peer, LISTEN)
    driver.measure(peer.sentences.append)

    with pytest.raises(InstrumentError, match="previous reading once more"):
        driver.measure(peer.sentences.append)


def test_nobody_pressing_is_a_timeout():
    peer = ma.Peer({})

    with pytest.raises(LinkTimeoutError, match="sent nothing within 12 s"):
        listening(peer, press_timeout_s=12)


def test_listener_asks_the_instrument_nothing():
    peer = ma.Peer({})
    driver = ma.connect(peer, {**LISTEN, "model": "MA68", "serial": "0042"})

    identity, state = driver.identify(), driver.calibration()

    assert identity == Instrument("X-Rite", "MA68", "0042")
    assert state == "unknown"
    with pytest.raises(
        InstrumentError, match="calibrate with the instrument's own keys"
    ):
        driver.calibrate(peer.sentences.append)
    assert peer.sent == []
