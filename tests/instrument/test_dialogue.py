import pytest

from paintlink.errors import InstrumentError, LinkTimeoutError, WrongInstrumentError
from paintlink.instrument import ask, did_you_mean, quoted


def test_command_ends_in_a_carriage_return(scripted):
    link, stream = scripted(..., b"OK\r\n")

    ask(link, "ys", "OK")

    assert stream.sent == [b"ys\r"]


def test_echo_of_the_command_is_skipped(scripted):
    link, _ = scripted(..., b"v\r\n", 1.5, b"X-RITE MA68\r\n")

    assert ask(link, "v", "X-RITE (.*)")[1] == "MA68"


def test_what_came_before_the_command_is_no_answer(scripted):
    link, _ = scripted(b"OK old\r\n", b"OK ol", ..., b"OK new\r\n")

    assert ask(link, "ys", "OK (.*)")[1] == "new"


def test_answer_may_spread_over_lines(scripted):
    link, _ = scripted(..., b"X-RITE\r\n", 0.3, b"MA68 3.02\r\n")

    assert ask(link, "v", "X-RITE MA68").string == "X-RITE MA68 3.02"


def test_other_answer_is_a_refusal_with_its_text(scripted):
    link, stream = scripted(..., b"?\r\n")

    with pytest.raises(
        InstrumentError, match=r"answered '\?' to 'ys', expected 'OK'.*try again"
    ) as caught:
        ask(link, "ys", "OK")

    assert caught.value.code == "?"
    assert stream.now_s < 1.0


def test_refusal_class_is_the_callers_choice(scripted):
    link, _ = scripted(..., b"OK00,CM-512\r")

    with pytest.raises(WrongInstrumentError, match="OK00,CM-512"):
        ask(link, "v", "X-RITE", refusal=WrongInstrumentError)


def test_no_answer_is_a_timeout(scripted):
    link, stream = scripted()

    with pytest.raises(LinkTimeoutError, match="sent nothing within 2 s"):
        ask(link, "ys", "OK")

    assert stream.now_s == pytest.approx(2.0)


def test_echo_alone_is_a_timeout(scripted):
    link, _ = scripted(..., b"ys\r\n")

    with pytest.raises(LinkTimeoutError, match="sent nothing"):
        ask(link, "ys", "OK")


def test_chatter_without_an_answer_ends(scripted):
    link, stream = scripted(..., *[b"BUSY\r\n", 0.4] * 1000)

    with pytest.raises(InstrumentError, match="BUSY BUSY"):
        ask(link, "ys", "OK")

    assert stream.now_s < 10.0


def test_slow_work_gets_its_time(scripted):
    link, _ = scripted(..., 50.0, b"...\r\n", 4.0, b"OK\r\n")

    assert ask(link, "yw", "OK", timeout_s=120.0, more_s=5.0)


@pytest.mark.parametrize(
    ("sent", "shown"),
    [
        (b"plain", "'plain'"),
        (b"\x1b[31m\r\nforged", r"'\x1b[31m\r\nforged'"),
        ("\u202eright to left", r"'\u202eright to left'"),
        (b"\xff", r"'\xff'"),
    ],
)
def test_device_text_is_quoted_harmlessly(sent, shown):
    assert quoted(sent) == shown


def test_long_device_text_is_cut():
    assert quoted("x" * 1000) == "'" + "x" * 61 + "...'"


def test_near_name_is_offered():
    assert did_you_mean("xrite_mb", ["xrite_ma", "chn_cr30"]) == (
        ", did you mean 'xrite_ma'?"
    )
    assert did_you_mean("zzz", ["xrite_ma"]) == ""
