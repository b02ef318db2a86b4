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
from paintlink_drivers.km_cm512 import percents
from tests.drivers.peer import Peer, connect

# docs/wire/km_cm512.md, section 7.
BANDS = np.arange(31)
GOLDEN = np.array([8.31 + BANDS, 6.0 + 0.5 * BANDS, 4.0 + 0.25 * BANDS]) / 100
GOLDEN_25 = (
    b"OK00,008.31,009.31,010.31,011.31,012.31,013.31,014.31,015.31,016.31,017.31,"
    b"018.31,019.31,020.31,021.31,022.31,023.31,024.31,025.31,026.31,027.31,028.31,"
    b"029.31,030.31,031.31,032.31,033.31,034.31,035.31,036.31,037.31,038.31\r"
)
SHORT = b"OK00" + b",000.00" * 7 + b"   \r"


def spectrum(percent, code=b"OK00"):
    return code + b"".join(b",%06.2f" % value for value in percent) + b"\r"


def answers(**changes):
    """Return the golden transcript; keywords replace answers."""
    three = [spectrum(100 * row) for row in GOLDEN]
    table = {
        b"IDR\r": b"OK00,CM-512m3A,1.10,12345678\r",
        b"STR\r": b"OK00,0,1\r",
        b"UZC\r": (1.5, b"OK00\r"),
        b"CAL\r": (2.5, b"OK00\r"),
        b"MES\r": (3.0, b"OK00,00001\r"),
        b"&\r": [three[0], SHORT, three[1], SHORT, three[2], SHORT],
    }
    named = {"more": b"&\r"}
    return table | {
        named.get(name, name.encode() + b"\r"): answer
        for name, answer in changes.items()
    }


@pytest.fixture
def peer():
    return Peer(answers())


def driver(peer, **options):
    return connect("km_cm512", peer, options)


def measured(peer, **options):
    return driver(peer, **options).measure(peer.sentences.append)


def test_golden_reply_has_the_published_bytes():
    assert spectrum(100 * GOLDEN[0]) == GOLDEN_25
    assert (len(GOLDEN_25), len(SHORT)) == (222, 57)


def test_golden_transcript_gives_the_golden_reading(peer):
    reading = measured(peer)

    assert peer.sent == [b"STR\r", b"MES\r", *[b"&\r"] * 6]
    assert np.allclose(reading.spectra.factors, GOLDEN, rtol=0, atol=1e-12)
    assert reading.spectra.wavelengths_nm.tolist() == list(range(400, 701, 10))
    assert [one.code for one in reading.geometries] == ["25as25", "45as45", "75as75"]
    assert reading.raw.startswith(b"OK00,00001\rOK00,008.31,")
    assert peer.sentences == ["Set the instrument on the panel and hold it still."]


def test_identity_is_read_after_a_blind_wake_up(peer):
    identity = driver(peer).identify()

    assert identity == Instrument("Konica Minolta", "CM-512m3A", "12345678", "1.10")
    assert peer.sent == [b"IDR\r", b"IDR\r"]
    assert peer.now_s == pytest.approx(1.0, abs=0.3)


def test_first_identification_may_be_lost():
    peer = Peer(answers(IDR=[b"", b"", b"OK00,CM-512m3,1.0,7\r"]))

    assert driver(peer).identify().model == "CM-512m3"


@pytest.mark.parametrize(
    ("answer", "options", "serial"),
    [
        (b"OK00,CM-512m3A,1.10,12345678\r", {}, "12345678"),
        (b"OK00,CM-512m3A,99,1.10,4711\r", {"serial_field": 4}, "4711"),
        (b"OK00,4711,400,700,10\r", {"serial_field": 1, "any_name": True}, "4711"),
        (b"OK00,CM-512m3A\r\n", {}, ""),
    ],
)
def test_place_of_the_serial_number_is_an_option(answer, options, serial):
    identity = driver(Peer(answers(IDR=answer)), **options).identify()

    assert identity.serial == serial
    assert identity.model.startswith("CM-512m3")


@pytest.mark.parametrize(
    "answer", [b"OK00,CM-2600d,1.0,1\r", b"X-RITE MA68II 3.02\r\n", b"ER00\r"]
)
def test_other_instrument_is_told_apart(answer):
    peer = Peer(answers(IDR=answer))

    with pytest.raises(InstrumentError, match="answered") as caught:
        driver(peer).identify()

    assert answer.strip().decode() == caught.value.code


def test_family_member_is_a_wrong_instrument():
    peer = Peer(answers(IDR=b"OK00,CM-2600d,1.0,1\r"))

    with pytest.raises(
        WrongInstrumentError, match=r"not a CM-512m3: it answered 'OK00"
    ):
        driver(peer).identify()


@pytest.mark.parametrize(
    ("answer", "state"),
    [(b"OK00,0,1\r", "valid"), (b"OK00,0,0\r", "needed"), (b"OK02,1,1\r", "valid")],
)
def test_calibration_state_is_asked(answer, state):
    assert driver(Peer(answers(STR=answer))).calibration() == state


def test_uncalibrated_instrument_is_not_told_to_measure():
    peer = Peer(answers(STR=b"OK00,0,0\r"))

    with pytest.raises(NeedsCalibrationError, match="calibrate it on its white plate"):
        measured(peer)

    assert peer.sent == [b"STR\r"]


def test_charging_lamp_is_waited_for_by_the_operator():
    peer = Peer(answers(STR=b"OK00,1,1\r"))

    with pytest.raises(InstrumentError, match="lamp is charging: wait ten seconds"):
        measured(peer)

    assert peer.sent == [b"STR\r"]


@pytest.mark.parametrize(
    ("first", "order"),
    [("zero", [b"UZC\r", b"CAL\r"]), ("white", [b"CAL\r", b"UZC\r"])],
)
def test_order_of_calibration_is_an_option(peer, first, order):
    driver(peer, calibrate_first=first).calibrate(peer.sentences.append)

    assert peer.sent == [*order, b"STR\r"]
    assert len(peer.sentences) == 2


def test_calibration_that_does_not_hold_is_refused():
    peer = Peer(answers(STR=b"OK00,0,0\r"))

    with pytest.raises(InstrumentError, match="calibration failed: clean the white"):
        driver(peer).calibrate(peer.sentences.append)


def test_each_step_waits_for_the_operator(peer):
    class Operator:
        def __init__(self):
            self.done = []

        def __call__(self, sentence):
            raise AssertionError(sentence)

        def confirm(self, sentence):
            self.done.append((sentence[:4], len(peer.sent)))

    operator = Operator()
    driver(peer).calibrate(operator)

    assert operator.done == [("Hold", 0), ("Set ", 1)]


def test_remark_is_told_and_the_reading_kept():
    peer = Peer(answers(MES=b"OK02,00001\r"))

    assert np.allclose(measured(peer).spectra.factors, GOLDEN)
    assert peer.sentences[-1] == "The instrument remarks OK02 to MES."


@pytest.mark.parametrize("place", range(6))
def test_error_anywhere_ends_the_measurement(place):
    more = answers()[b"&\r"]
    more[place] = b"ER10\r"

    with pytest.raises(InstrumentError, match="'ER10' to '&'") as caught:
        measured(Peer(answers(more=more)))

    assert caught.value.code == "ER10"


@pytest.mark.parametrize("place", [0, 2, 4])
@pytest.mark.parametrize("damage", [slice(0, 221), slice(0, 100), slice(0, 12)])
def test_partial_spectrum_is_never_accepted(place, damage):
    more = answers()[b"&\r"]
    more[place] = more[place][damage].rstrip(b"\r") + b"\r"
    if more[place] == answers()[b"&\r"][place]:
        more[place] = more[place][:-2] + b"\r"

    with pytest.raises(ProtocolError, match="2 whole spectra of 3: measure again"):
        measured(Peer(answers(more=more)))


def test_spectrum_that_comes_twice_is_noticed():
    more = answers()[b"&\r"]
    more[2] = more[0]

    with pytest.raises(ProtocolError, match="two geometries hold the same values"):
        measured(Peer(answers(more=more)))


def test_effect_paint_above_white_is_kept():
    more = answers()[b"&\r"]
    more[0] = spectrum(120.0 + BANDS)

    assert measured(Peer(answers(more=more))).spectra.factors[0, 0] == pytest.approx(
        1.2
    )


def test_echo_and_line_feeds_do_no_harm():
    table = {
        command: [one.replace(b"\r", b"\r\n") for one in answer]
        if isinstance(answer, list)
        else answer
        for command, answer in answers().items()
    }

    assert np.allclose(measured(Peer(table, echo=True)).spectra.factors, GOLDEN)


@settings(deadline=None, max_examples=30)
@given(cuts=st.lists(st.integers(1, 250), min_size=1, max_size=20))
def test_any_chunking_gives_the_same_reading(cuts):
    assert np.allclose(
        measured(Peer(answers(), cuts=tuple(cuts))).spectra.factors, GOLDEN
    )


def test_silence_in_place_of_a_reading_is_named():
    with pytest.raises(LinkTimeoutError, match="nothing within 30 s"):
        measured(Peer(answers(MES=b"")))


def test_previous_reading_once_more_is_refused(peer):
    peer.answers[b"&\r"] *= 2
    reader = driver(peer)
    reader.measure(peer.sentences.append)

    with pytest.raises(InstrumentError, match="previous reading once more"):
        reader.measure(peer.sentences.append)


def reading_of(measurement, now):
    return Reading(measurement, Instrument("K", "C"), now, "simulated", sample="s")


def test_readings_serve_solid_colours_only(peer, aware_now):
    reading = reading_of(measured(peer), aware_now)

    assert normalise(reading, finish="solid").finish == "solid"
    with pytest.raises(ReadingError, match="declare the paint solid"):
        normalise(reading, finish="metallic")


def test_45_degree_light_is_an_option(peer, aware_now):
    reading = reading_of(measured(peer, looks_from="45"), aware_now)

    assert [one.code for one in reading.measurement.geometries] == [
        *("45as25", "45as45", "45as75"),
    ]
    assert len(normalise(reading, finish="metallic").samples) == 3


def test_driver_says_it_never_met_hardware():
    info = load_driver("km_cm512").INFO

    assert not info.hardware_tested
    assert info.label == "Konica Minolta CM-512m3A, CM-512m3"


def test_blanks_within_a_spectrum_were_spliced_in() -> None:
    fields = ["010.00"] * 31
    spliced = [*fields[:6], "000.00  ", *fields[7:]]

    assert percents(",".join(["OK00", *fields]) + "   ") == [10.0] * 31
    assert percents(",".join(["OK00", *spliced])) == []
