import numpy as np
import pytest

from paintlink.errors import InstrumentError, LinkTimeoutError, ProtocolError
from paintlink.instrument import (
    ReadingCheck,
    complete,
    parse_band_rows,
    parse_geometry,
)

GEOMETRIES = (parse_geometry("45as15"), parse_geometry("45as45"))
WAVELENGTHS_NM = np.array([400.0, 410.0, 420.0])
GREY = np.array([[0.5, 0.5, 0.5], [0.4, 0.4, 0.4]])


def admit(check, factors):
    return check.admit(GEOMETRIES, WAVELENGTHS_NM, factors, b"raw")


def test_plausible_reading_is_handed_on():
    reading = admit(ReadingCheck(), GREY)

    assert reading.geometries == GEOMETRIES
    assert np.array_equal(reading.spectra.factors, GREY)
    assert reading.raw == b"raw"


@pytest.mark.parametrize("factor", [-0.2, 10.1, np.nan, np.inf])
def test_impossible_factor_is_refused(factor):
    factors = GREY.copy()
    factors[1, 2] = factor

    with pytest.raises(ProtocolError, match="outside -10 to 1000 %") as caught:
        admit(ReadingCheck(), factors)

    assert caught.value.raw == b"raw"


def test_bright_flakes_and_dark_noise_are_possible():
    factors = np.array([[4.0, 3.0, 2.0], [-0.001, 0.0, 0.001]])

    assert admit(ReadingCheck(), factors).spectra.factors[0, 0] == 4.0


def test_one_empty_geometry_is_no_reading():
    factors = GREY.copy()
    factors[1] = 0.0

    with pytest.raises(InstrumentError, match="holds no reading: measure again"):
        admit(ReadingCheck(), factors)


def test_two_equal_geometries_are_a_mix_up():
    with pytest.raises(ProtocolError, match="two geometries hold the same values"):
        admit(ReadingCheck(), GREY[[0, 0]])


def test_same_reading_twice_is_refused():
    check = ReadingCheck()
    admit(check, GREY)

    with pytest.raises(InstrumentError, match="previous reading once more"):
        admit(check, GREY.copy())


def test_smallest_change_makes_a_new_reading():
    check = ReadingCheck()
    admit(check, GREY)
    factors = GREY.copy()
    factors[0, 0] += 1 / 32768

    assert admit(check, factors).spectra.factors[0, 0] > 0.5


def test_refused_reading_does_not_count_as_the_last():
    check = ReadingCheck()
    admit(check, GREY)

    with pytest.raises(InstrumentError, match="holds no reading"):
        admit(check, np.zeros((2, 3)))
    with pytest.raises(InstrumentError, match="previous reading"):
        admit(check, GREY)


def test_half_a_frame_is_a_protocol_error():
    with (
        pytest.raises(ProtocolError, match="dump stopped after 3 bytes") as caught,
        complete("dump"),
    ):
        raise LinkTimeoutError("late", partial=b"abc")

    assert caught.value.raw == b"abc"


@pytest.mark.parametrize("partial", [b"", b"\r\n"])
def test_silence_stays_a_timeout(partial):
    with pytest.raises(LinkTimeoutError, match="late"), complete("dump"):
        raise LinkTimeoutError("late", partial=partial)


REPORT = b"MA68\r\n400 1.00 10.5\r\n410 1.00 -0.25\n420 1.00 30\r45 55.00 1.00 2.00\r\n"


def test_band_rows_are_picked_from_a_report():
    percent = parse_band_rows(REPORT, WAVELENGTHS_NM, (2, 1))

    assert percent.tolist() == [[10.5, -0.25, 30.0], [1.0, 1.0, 1.0]]


@pytest.mark.parametrize(
    "report",
    [
        b"",
        REPORT.replace(b"410", b"41 "),
        REPORT.replace(b"410 1.00 -0.25", b"410 1.00"),
        REPORT + REPORT,
        b"\n".join(reversed(REPORT.splitlines())),
    ],
    ids=["empty", "garbled", "short row", "twice", "reversed"],
)
def test_wrong_set_of_rows_is_refused(report):
    with pytest.raises(
        ProtocolError, match=r"usable rows, expected 3 from 400 to 420 nm with 2"
    ) as caught:
        parse_band_rows(report, WAVELENGTHS_NM, (2, 1))

    assert caught.value.raw == report


@pytest.mark.parametrize("token", [b"-----", b"nan", b"1e5", b"1_0", b"1,5", b".5"])
def test_other_than_a_decimal_number_is_refused(token):
    report = REPORT.replace(b"-0.25", token)

    with pytest.raises(ProtocolError, match="in place of a number"):
        parse_band_rows(report, WAVELENGTHS_NM, (2, 1))
