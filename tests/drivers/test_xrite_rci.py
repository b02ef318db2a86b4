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
from paintlink.instrument import ReadingMemory, load_driver
from paintlink.model import Instrument, Reading
from tests.drivers.peer import Peer, connect

# docs/wire/xrite_rci.md, section 9.
SPECTRUM = bytes.fromhex(
    "07D00BB80FA0138817701B581F40232827102AF82EE032C836B03A983E80426846504A384E205208"
    "55F059D85DC061A8659069786D607148753079187D00"
)
GOLDEN = (2000 + 1000 * np.arange(31)) * 2 / 65535
OK = b"<00>"
SET_UP = [b"%sCF\r" % v for v in b"0008 0005 0207 020A 001A 0716".split()]
ASCII = ",".join(f"{100 * value:.2f}" for value in GOLDEN).encode()


def answers(model="DTP20", **changes):
    """Return the golden transcript; keywords replace answers, ``ping`` that of CR."""
    verbs = (
        *("CE", "RM", "CR", "UC", "10XD", "CA", "CB", "1CA", "01PB", "00PB", "3PB"),
        *("2PB", "0318CF", "011BCF", "001BCF", "02CD", "01ST"),
    )
    table = {
        b"\r": OK,
        **{verb.encode() + b"\r": OK for verb in verbs},
        **dict.fromkeys(SET_UP, OK),
        b"SV\r": f"X-Rite {model} V1.00\r\n".encode() + OK,
        b"GI\r": b"Serial Number: SIM00001\rOEM Serial #: 0\r" + OK,
        b"04SN\r": b"12345\r" + OK,
        b"CS\r": b"2\r" + OK,
        b"00GM\r": b"0\r" + OK,
        b"01GM\r": SPECTRUM,
        b"03TS\r": ASCII + b"\r\n" + OK,
    }
    names = {"ping": ""}
    return table | {
        names.get(name, name.lstrip("_")).encode() + b"\r": answer
        for name, answer in changes.items()
    }


def driver(peer, **options):
    return connect("xrite_rci", peer, options)


def measured(peer, **options):
    return driver(peer, **options).measure(peer.sentences.append)


@pytest.fixture
def peer():
    return Peer(answers())


def test_golden_session_gives_the_golden_spectrum(peer):
    reader = driver(peer)

    identity = reader.identify()
    opened = len(peer.sent)
    reading = reader.measure(peer.sentences.append)

    assert identity == Instrument("X-Rite", "DTP20", "SIM00001", "1.00")
    assert peer.sent[:opened] == [
        *(b"0PR\r", b"0PR\r", b"\r", b"CE\r", b"SV\r", *SET_UP, b"00GM\r"),
        b"GI\r",
    ]
    assert peer.sent[opened:] == [
        *(b"00GM\r", b"RM\r", b"0318CF\r", b"011BCF\r", b"01GM\r", b"001BCF\r"),
    ]
    assert np.allclose(reading.spectra.factors, GOLDEN, rtol=0, atol=1e-15)
    assert reading.raw == SPECTRUM
    assert [one.code for one in reading.geometries] == ["45_0"]


@pytest.mark.parametrize(
    ("word", "percent"),
    [
        *(("0CCD", 10.001), ("4000", 50.001), ("8000", 100.002), ("FFFF", 200.0)),
        ("3E3E", 48.627),
    ],
)
def test_published_words_give_the_published_percents(word, percent):
    peer = Peer(answers(_01GM=bytes.fromhex(word) * 31))

    reading = measured(peer, model="DTP20")

    assert 100 * reading.spectra.factors[0] == pytest.approx(percent, abs=5e-4)


def test_garbage_of_the_session_before_is_cleared():
    peer = Peer(answers())
    peer.say(b"41.2\t<28>" + SPECTRUM)

    assert driver(peer).identify().model == "DTP20"


def test_latched_error_of_the_session_before_is_cleared():
    peer = Peer(answers(ping=b"<28>", SV=[b"X-Rite DTP20 V1.00\r\n<00>"]))

    assert driver(peer).identify().model == "DTP20"


@pytest.mark.parametrize("code", [b"<28>", b"<A8>"])
def test_uncalibrated_instrument_says_so_and_is_cleared(code):
    peer = Peer(answers(RM=code))
    reader = driver(peer, model="DTP20")

    with pytest.raises(NeedsCalibrationError, match="RM with error 28 not") as caught:
        reader.measure(peer.sentences.append)

    assert caught.value.code == "28"
    assert peer.sent[-1] == b"CE\r"
    assert reader.calibration() == "needed"


def test_calibration_names_the_plaque_and_waits_until_it_is_done():
    peer = Peer(answers(CS=[b"4\r<00>", b"4\r<00>", b"2\r<00>"]))
    reader = driver(peer, model="DTP20")

    reader.calibrate(peer.sentences.append)

    assert peer.sent == [b"04SN\r", b"CR\r", b"CS\r", b"CS\r", b"CS\r"]
    assert peer.sentences == [
        "Set the instrument on its white plaque. Its number: 12345."
    ]
    assert reader.calibration() == "valid"


def test_calibration_that_failed_shows_in_the_next_answer():
    peer = Peer(answers(CS=b"<29>"))
    reader = driver(peer, model="DTP20")

    with pytest.raises(NeedsCalibrationError, match="error 29 calibration failed"):
        reader.calibrate(peer.sentences.append)

    assert reader.calibration() == "needed"


@pytest.mark.parametrize("status", [b"<01>", b"<02>", b"<03>", b"<04>"])
def test_status_of_the_second_generation_is_no_error(status):
    assert measured(Peer(answers(RM=status)), model="DTP20").raw == SPECTRUM


def test_status_of_the_second_generation_is_an_error_of_the_first():
    peer = Peer(answers("DTP22", RM=b"<01>"))

    with pytest.raises(InstrumentError, match="answered RM with error 01: repeat"):
        measured(peer, model="DTP22")

    assert peer.sent[-1] == b"CE\r"


def test_busy_instrument_is_asked_again():
    peer = Peer(answers(RM=[b"<14>", b"<14>", OK]))

    assert measured(peer, model="DTP20").raw == SPECTRUM
    assert peer.sent.count(b"RM\r") == 3


def test_instrument_that_stays_busy_is_refused():
    with pytest.raises(InstrumentError, match="error 14 busy"):
        measured(Peer(answers(RM=b"<14>")), model="DTP20")


def test_refusal_in_place_of_the_spectrum_is_read_as_one():
    peer = Peer(answers(_01GM=b"<42>"))

    with pytest.raises(InstrumentError, match="01GM with error 42 no reading"):
        measured(peer, model="DTP20")

    assert peer.sent[-2:] == [b"001BCF\r", b"CE\r"]
    assert peer.now_s < 1.0


@pytest.mark.parametrize(
    "data",
    [SPECTRUM[:61], SPECTRUM + b"\x01", SPECTRUM + b"\n", SPECTRUM * 2, SPECTRUM[:7]],
)
def test_spectrum_of_another_length_is_refused(data):
    peer = Peer(answers(_01GM=data))

    with pytest.raises(ProtocolError, match="measure again"):
        measured(peer, model="DTP20")

    assert peer.sent[-1] == b"001BCF\r"


def test_silence_in_place_of_the_spectrum_stays_silence():
    with pytest.raises(LinkTimeoutError, match="nothing within 5 s"):
        measured(Peer(answers(_01GM=b"")), model="DTP20")


def test_button_of_the_dtp20_shows_in_its_status():
    peer = Peer(
        answers(
            CS=[b"2\r<00>", b"2\r<00>", b"4\r<00>", b"6\r<00>"],
            _00GM=[b"3\r<00>", b"4\r<00>"],
        )
    )

    assert measured(peer, model="DTP20", trigger="button").raw == SPECTRUM
    assert b"RM\r" not in peer.sent


def test_reading_from_before_the_wait_is_not_taken_for_a_press():
    peer = Peer(answers(CS=b"6\r<00>", _00GM=[b"3\r<00>"] * 5 + [b"4\r<00>"]))

    assert measured(peer, model="DTP20", trigger="button").raw == SPECTRUM
    assert peer.sent.count(b"00GM\r") == 6


def test_nobody_at_the_button_ends_the_wait(peer):
    with pytest.raises(LinkTimeoutError, match="nobody pressed the button"):
        measured(peer, model="DTP20", trigger="button", press_timeout_s=2)


@pytest.mark.parametrize("status", [OK, b"busy" + OK])
def test_answer_without_its_number_is_refused(status):
    peer = Peer(answers(CS=status))

    with pytest.raises(ProtocolError, match=r"answered CS with .*, not a number"):
        driver(peer, model="DTP20").calibrate(peer.sentences.append)


def test_late_answer_to_an_earlier_command_is_no_version():
    peer = Peer(answers(SV=[OK, b"X-Rite DTP20 V1.00\r\n<00>"]))

    assert driver(peer).identify().model == "DTP20"


def test_echo_before_the_spectrum_is_left_out():
    assert (
        measured(Peer(answers(_01GM=b"01GM\r" + SPECTRUM)), model="DTP20").raw
        == SPECTRUM
    )


def fresh_spectra(count):
    return [SPECTRUM[2:] + bytes([1, number]) for number in range(count)]


@pytest.mark.parametrize(("before", "cleared"), [(0, 1), (7, 0)])
def test_memory_is_cleared_only_where_it_was_empty_before(before, cleared):
    counts = [b"%d\r<00>" % (before + number) for number in range(6)]
    peer = Peer(answers(_00GM=counts, _01GM=fresh_spectra(6)))
    reader = driver(peer)
    reader.identify()

    for _ in range(5):
        reader.measure(peer.sentences.append)

    assert peer.sent.count(b"02CD\r") == cleared


def test_memory_is_cleared_on_demand(peer):
    driver(peer, model="DTP20").clear()

    assert peer.sent[0] == b"02CD\r"


def test_full_memory_says_what_to_do():
    with pytest.raises(InstrumentError, match="37 memory full: take over its readings"):
        measured(Peer(answers(RM=b"<37>")), model="DTP20")


def test_stored_readings_are_numbered_and_stay(peer):
    other = SPECTRUM[2:] + b"\x01\x02"
    peer.answers |= {
        b"00GM\r": b"2\r<00>",
        b"00101GM\r": SPECTRUM,
        b"00201GM\r": other,
    }
    reader = driver(peer, model="DTP20")

    first, second = reader.stored()

    assert isinstance(reader, ReadingMemory)
    assert (first.record, first.raw) == ("stored 1", SPECTRUM)
    assert (second.record, second.raw) == ("stored 2", other)
    assert b"02CD\r" not in peer.sent


SERIAL = {
    "530": ({b"03TS\r": ASCII + b"\r\n<00>"}, [b"RM\r", b"01ST\r", b"03TS\r"]),
    "SP62": ({b"001GM\r": ASCII.replace(b",", b"\t") + b"\r\n<00>"}, [b"001GM\r"]),
    "CA22": (
        {
            b"1SR\r": b"".join(b"S%10.2f" % (100 * value) for value in GOLDEN)
            + b"\r\n<00>"
        },
        [b"1SR\r"],
    ),
    "DTP22": (
        {
            b"0SR\r": b"X41.24Y21.26Z1.93\r\n"
            + b"".join(b"S %.2f\r\n" % (100 * value) for value in GOLDEN)
            + b"<00>"
        },
        [b"0SR\r"],
    ),
}


@pytest.mark.parametrize("model", SERIAL)
@pytest.mark.parametrize("echo", [False, True])
def test_serial_models_read_out_in_their_own_way(model, echo):
    table, commands = SERIAL[model]
    peer = Peer(answers(model) | table, echo=echo)
    reader = driver(peer)

    identity = reader.identify()
    reading = reader.measure(peer.sentences.append)

    assert identity.model == model
    assert not set(SET_UP) & set(peer.sent)
    assert peer.sent[-len(commands) :] == commands
    assert np.allclose(reading.spectra.factors, GOLDEN, atol=5e-5)
    assert list(reader.stored()) == []


@pytest.mark.parametrize("model", SERIAL)
def test_serial_spectrum_with_a_value_missing_is_refused(model):
    table, _ = SERIAL[model]
    short = {command: answer.replace(b"6.10", b"") for command, answer in table.items()}

    with pytest.raises(ProtocolError, match="not 31 numbers: measure again"):
        measured(Peer(answers(model) | short), model=model)


@pytest.mark.parametrize(
    ("model", "on", "off"),
    [("530", b"01PB\r", b"00PB\r"), ("DTP22", b"3PB\r", b"2PB\r")],
)
@pytest.mark.parametrize("press", [b"<00>", b"<01>\r\n"])
def test_button_of_serial_models_is_an_unasked_answer(model, on, off, press):
    table, _ = SERIAL[model]
    press = press if model == "530" else b"<00>"
    peer = Peer(answers(model) | table | {on: (b"<00>", 2.0, press)})

    reading = measured(peer, model=model, trigger="button")

    assert np.allclose(reading.spectra.factors, GOLDEN, atol=5e-5)
    assert peer.sent[:2] == [on, off]


def test_refusal_at_the_button_is_told():
    peer = Peer(answers("530", _01PB=(b"<00>", 1.0, b"<28>")))

    with pytest.raises(
        NeedsCalibrationError, match="answered the button with error 28"
    ):
        measured(peer, model="530", trigger="button")


def test_black_calibration_follows_where_the_model_has_one():
    peer = Peer(answers("CA22"))

    driver(peer, model="CA22").calibrate(peer.sentences.append)

    assert peer.sent == [b"CA\r", b"CB\r"]
    assert [sentence[-12:] for sentence in peer.sentences] == [
        *("hite plaque.", " black trap."),
    ]


def test_unknown_name_needs_the_option():
    table = answers() | {b"SV\r": b"Ver 7.1\r\n<00>"}

    with pytest.raises(WrongInstrumentError, match="known by name: it answered 'Ver"):
        driver(Peer(table)).identify()
    assert driver(Peer(table), model="530").identify().model == "530"


@pytest.mark.parametrize("answer", [b"X-RITE MA68II 3.02\r\n", b"?\r\n", b""])
def test_other_dialect_is_no_rci(answer):
    peer = Peer(dict.fromkeys(answers(), answer))

    with pytest.raises((ProtocolError, LinkTimeoutError)):
        driver(peer).identify()


@settings(deadline=None, max_examples=30)
@given(cuts=st.lists(st.integers(1, 70), min_size=1, max_size=20))
def test_any_chunking_gives_the_same_reading(cuts):
    assert measured(Peer(answers(), cuts=tuple(cuts)), model="DTP20").raw == SPECTRUM


def test_readings_serve_solid_colours_only(peer, aware_now):
    instrument = Instrument("X-Rite", "DTP20")
    reading = Reading(
        measured(peer, model="DTP20"), instrument, aware_now, "simulated", sample="s"
    )

    assert len(normalise(reading, finish="solid").samples) == 3
    with pytest.raises(ReadingError, match="declare the paint solid"):
        normalise(reading)


def test_driver_is_found_on_usb_and_never_met_hardware():
    info = load_driver("xrite_rci").INFO

    assert info.usb.usb_id == "0765:d020"
    assert info.usb.out_endpoint is None
    assert not info.hardware_tested
