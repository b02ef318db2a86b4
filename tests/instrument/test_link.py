import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.errors import (
    CancelledError,
    LinkError,
    LinkTimeoutError,
    ProtocolError,
)
from paintlink.instrument import BUFFER_LIMIT, Link, fixed, up_to

THREE_BYTES = 3


def three_bytes(buffer: bytes) -> int:
    return THREE_BYTES if len(buffer) >= THREE_BYTES else 0


def test_frame_is_put_together_from_pieces(scripted):
    link, _ = scripted(b"a", b"b", b"cd", b"ef")

    frames = [link.receive(three_bytes, 1.0), link.receive(three_bytes, 1.0)]

    assert frames == [b"abc", b"def"]


def test_bytes_after_a_frame_are_kept(scripted):
    link, stream = scripted(b"abcdef")

    link.receive(three_bytes, 1.0)

    assert link.receive(three_bytes, 0.0) == b"def"
    assert stream.now_s == 0.0


def test_silence_ends_in_a_timeout_with_what_came(scripted):
    link, stream = scripted(b"ab")

    with pytest.raises(LinkTimeoutError, match=r"only 'ab' within 2 s.*baud") as caught:
        link.receive(three_bytes, 2.0)

    assert caught.value.partial == b"ab"
    assert stream.now_s == pytest.approx(2.0)


def test_nothing_at_all_is_said_plainly(scripted):
    link, _ = scripted()

    with pytest.raises(LinkTimeoutError, match=r"sent nothing within 0\.5 s"):
        link.read_line(0.5)


def test_incomplete_frame_does_not_taint_the_next(scripted):
    link, _ = scripted(b"ab", 2.0, b"cde")

    with pytest.raises(LinkTimeoutError, match="only 'ab'"):
        link.receive(three_bytes, 1.0)

    assert link.receive(three_bytes, 5.0) == b"cde"


def test_drip_does_not_outlast_the_deadline(scripted):
    link, stream = scripted(*[b"x", 0.04] * 100)

    with pytest.raises(LinkTimeoutError, match="within 1 s"):
        link.receive(lambda _buffer: 0, 1.0)

    assert stream.now_s == pytest.approx(1.0, abs=0.05)


def test_zero_timeout_still_looks_once(scripted):
    link, _ = scripted(b"abc")

    assert link.receive(three_bytes, 0.0) == b"abc"


def test_silence_stands_for_a_line_end(scripted):
    link, stream = scripted(b"12O", 0.1, b"K")

    frame = link.receive(up_to(rb"OK[\r\n]"), 5.0, idle_s=0.2)

    assert frame == b"12OK"
    assert 0.3 <= stream.now_s <= 0.36


def test_silence_in_the_middle_is_no_end(scripted):
    link, _ = scripted(b"12", 0.5, b"OK")

    assert link.receive(up_to(rb"OK[\r\n]"), 5.0, idle_s=0.2) == b"12OK"


@pytest.mark.parametrize("end", [b"\r", b"\n", b"\r\n"])
def test_line_ends_in_any_terminator(scripted, end):
    link, stream = scripted(b"ONE" + end + b"TWO" + end)

    lines = [link.read_line(1.0), link.read_line(1.0)]

    assert lines == ["ONE", "TWO"]
    assert stream.now_s == 0.0


def test_line_without_terminator_ends_in_silence(scripted):
    link, stream = scripted(b"OK")

    assert link.read_line(5.0) == "OK"
    assert 0.2 <= stream.now_s <= 0.26


def test_split_terminator_is_one_terminator(scripted):
    link, _ = scripted(b"ONE\r", b"\nTWO\r", b"\n")

    assert [link.read_line(1.0), link.read_line(1.0)] == ["ONE", "TWO"]
    with pytest.raises(LinkTimeoutError, match="sent nothing"):
        link.read_line(1.0)


def test_bytes_outside_ascii_survive_a_line(scripted):
    link, _ = scripted(b"\xff\x80 OK\r")

    assert link.read_line(1.0).encode("latin-1") == b"\xff\x80 OK"


@settings(deadline=None)
@given(
    lines=st.lists(st.text("ABC 123", min_size=1).filter(str.strip), min_size=1),
    ends=st.lists(st.sampled_from([b"\r", b"\n", b"\r\n"]), min_size=1),
    cuts=st.lists(st.integers(1, 9), min_size=1),
)
def test_chunking_never_changes_the_lines(lines, ends, cuts):
    ends = [ends[index % len(ends)] for index in range(len(lines))]
    data = b"".join(line.encode() + end for line, end in zip(lines, ends, strict=True))
    link = Link(Chunks(data, cuts), clock=lambda: 0.0)

    assert [link.read_line(1.0) for _ in lines] == [line.lstrip() for line in lines]


class Chunks:
    """Delivers everything at once in pieces of the given sizes."""

    def __init__(self, data: bytes, cuts: list[int]) -> None:
        self.data = data
        self.cuts = cuts

    def write(self, data: bytes) -> None:
        self.data += data

    def read(self, timeout_s: float) -> bytes:
        size = self.cuts[len(self.data) % len(self.cuts)]
        piece, self.data = self.data[:size], self.data[size:]
        return piece

    def close(self) -> None:
        self.data = b""


def test_waiting_leaves_the_data_in_place(scripted):
    link, _ = scripted(30.0, b"REPORT\r")

    link.wait_for_data(60.0)

    assert link.read_line(0.0) == "REPORT"


def test_late_line_end_is_no_data(scripted):
    link, stream = scripted(b"OK\r", b"\n", 10.0, b"X")
    link.read_line(1.0)

    link.wait_for_data(60.0)

    assert stream.now_s == pytest.approx(10.0)


@pytest.mark.parametrize("pieces", [(b"OK\r\nOK\r\n",), (b"O", b"K", b"\r\n"), ()])
def test_last_answer_once_more_is_no_data(scripted, pieces):
    link, stream = scripted(*pieces, 10.0, b"REPORT\r")

    link.wait_for_data(60.0, after=b"OK")

    assert stream.now_s == pytest.approx(10.0)
    assert link.drain(idle_s=0.1, limit_s=1.0).endswith(b"REPORT\r")


def test_request_drops_what_came_before_it(scripted):
    link, stream = scripted(b"old", ..., b"ne", b"w+")

    assert link.request(b"?", three_bytes, 1.0) == b"new"
    assert stream.sent == [b"?"]
    assert link.drain(idle_s=0.0, limit_s=1.0) == b"+"


def test_wait_for_data_runs_out(scripted):
    link, stream = scripted(b"\r\n")

    with pytest.raises(LinkTimeoutError, match="sent nothing within 300 s"):
        link.wait_for_data(300.0)

    assert stream.now_s == pytest.approx(300.0)


def test_drain_collects_until_silence(scripted):
    link, stream = scripted(b"a", 0.2, b"b", 0.2, b"c", 0.4, b"late")

    assert link.drain(idle_s=0.3, limit_s=10.0) == b"abc"
    assert 0.7 <= stream.now_s <= 0.76


def test_drain_gives_up_on_a_chatterer(scripted):
    link, _ = scripted(*[b"x", 0.1] * 200)

    with pytest.raises(ProtocolError, match="still sending after 5 s") as caught:
        link.drain(idle_s=0.3, limit_s=5.0)

    assert caught.value.raw.startswith(b"xxxx")


def test_discard_takes_no_time(scripted):
    link, stream = scripted(b"old", b"older", 1.0, b"new\r")

    link.discard()

    assert stream.now_s == 0.0
    assert link.read_line(2.0) == "new"


def test_flood_is_refused_and_forgotten(scripted):
    link, _ = scripted(*[bytes(4096)] * 20, 1.0, b"OK\r")

    with pytest.raises(ProtocolError, match="more than 65536 bytes") as caught:
        link.receive(lambda _buffer: 0, 60.0)

    assert len(caught.value.raw) <= BUFFER_LIMIT + 4096
    link.discard()
    assert link.read_line(2.0) == "OK"


def test_flood_while_draining_is_refused(scripted):
    link, _ = scripted(*[bytes(4096)] * 20)

    with pytest.raises(ProtocolError, match="more than 65536 bytes"):
        link.drain(idle_s=0.3, limit_s=60.0)


def test_cancellation_is_noticed_within_a_fifth_second(scripted):
    stop_s = 7.0
    link, stream = scripted(cancelled=lambda: stream.now_s >= stop_s)

    with pytest.raises(CancelledError, match="stopped while waiting"):
        link.wait_for_data(300.0)

    assert stream.now_s <= stop_s + 0.2
    assert stream.longest_wait_s <= 0.2


def test_tap_sees_bytes_and_silences(scripted):
    seen = []
    link, _ = scripted(
        b"OK", tap=lambda direction, data: seen.append((direction, data))
    )

    link.send(b"ys\r")
    link.read_line(1.0)

    assert seen == [("sent", b"ys\r"), ("received", b"OK"), ("silence", b"")]


def test_line_under_watch_keeps_what_arrives(scripted):
    link, stream = scripted(0.3, b"<01>", 5.0)

    link.watch(1.0)

    assert stream.now_s == pytest.approx(1.0)
    assert link.receive(lambda data: 4 if len(data) >= 4 else 0, 0.1) == b"<01>"


def test_line_under_watch_tells_of_the_unplug(scripted):
    link, stream = scripted()

    def gone(timeout_s):
        raise LinkError("unplugged")

    stream.read = gone

    with pytest.raises(LinkError, match="unplugged"):
        link.watch(1.0)


def test_frame_of_fixed_size_is_found_behind_junk(scripted):
    link, _ = scripted(b"??", b"AB", b"CDx")
    frame = link.receive(fixed(3, lambda data: data.startswith(b"B")), 1.0)

    assert frame[-3:] == b"BCD"
    assert link.drain(0.0, 1.0) == b"x"


def test_clock_that_cannot_get_over_its_rounding_ends_all_the_same(scripted):
    link, stream = scripted()
    stream.now_s = 3.0000000000000004e5

    with pytest.raises(LinkTimeoutError, match=r"within 0\.7 s"):
        link.receive(lambda data: 0, 0.7)
