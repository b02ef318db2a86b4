import json
import resource
from datetime import UTC, datetime

import pytest

from paintlink.errors import InputError, LinkError
from paintlink.links import Call, CaptureWriter, Event, ReplayStream, read_capture

STARTED_AT = datetime(2025, 3, 4, 5, 6, 7, tzinfo=UTC)


@pytest.fixture
def writer(tmp_path):
    ticks = iter(range(1000))
    writer = CaptureWriter(
        tmp_path / "session.jsonl",
        driver="xrite_ma",
        options={"press_timeout_s": 60.0, "sample_columns": (2, 4)},
        started_at=STARTED_AT,
        clock=lambda: float(next(ticks)),
    )
    yield writer
    writer.close()


def test_session_reads_back_as_written(writer, tmp_path):
    writer.call("identify")
    writer.tap("sent", b"v\r")
    writer.tap("received", bytes(range(256)))
    writer.tap("silence", b"")
    writer.call("measure")
    writer.close()

    capture = read_capture(tmp_path / "session.jsonl")

    assert (capture.driver, capture.started_at) == ("xrite_ma", STARTED_AT)
    assert capture.options == {"press_timeout_s": 60.0, "sample_columns": [2, 4]}
    assert capture.calls == (
        Call(
            "identify",
            (
                Event(2.0, "sent", b"v\r"),
                Event(3.0, "received", bytes(range(256))),
                Event(4.0, "silence", b""),
            ),
        ),
        Call("measure", ()),
    )


def test_every_line_is_on_disk_at_once(writer, tmp_path):
    writer.call("identify")
    writer.tap("sent", b"v\r")

    lines = (tmp_path / "session.jsonl").read_text().splitlines()

    assert json.loads(lines[-1]) == {"t": 2.0, "sent": "760d"}


def test_capture_never_overwrites_another(writer, tmp_path):
    with pytest.raises(FileExistsError, match=r"session\.jsonl"):
        CaptureWriter(
            tmp_path / "session.jsonl", driver="x", options={}, started_at=STARTED_AT
        )


def test_full_disk_ends_the_capture_only(writer, tmp_path, caplog):
    path = tmp_path / "session.jsonl"
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    writer.call("identify")
    resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 50, hard))
    try:
        writer.tap("received", bytes(100))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    writer.tap("received", bytes(100))

    assert caplog.messages == [f"{path}: the disk is full, the capture ends here"]
    assert read_capture(path).calls == (Call("identify", ()),)


def test_torn_last_line_is_left_out(writer, tmp_path):
    path = tmp_path / "session.jsonl"
    writer.call("identify")
    writer.tap("sent", b"v\r")
    path.write_bytes(path.read_bytes()[:-3])

    assert read_capture(path).calls == (Call("identify", ()),)


@pytest.mark.parametrize(
    "header",
    [b"", b"not JSON\n", b"[]\n", b"{}\n", b'{"paintlink-capture": 2}\n', b"\xff\n"],
)
def test_other_file_is_refused(tmp_path, header):
    path = tmp_path / "other"
    path.write_bytes(header)

    with pytest.raises(InputError, match=f"{path} is no capture of paintlink"):
        read_capture(path)


@pytest.mark.parametrize(
    "line",
    [
        "nonsense",
        "5",
        "[]",
        '{"t": 1, "sent": "xy"}',
        '{"t": "soon", "sent": "76"}',
        '{"t": 1}',
        '{"t": 1, "sent": "76", "received": "76"}',
        '{"t": 1, "call": "explode"}',
        '{"sent": "76"}',
        '{"t": 1, "sent": 7}',
    ],
)
def test_damaged_line_is_named(writer, tmp_path, line):
    path = tmp_path / "session.jsonl"
    writer.call("identify")
    path.write_text(path.read_text() + line + "\n")

    with pytest.raises(InputError, match=f"{path}, line 3: not a line of a capture"):
        read_capture(path)


def test_bytes_before_the_first_call_are_refused(writer, tmp_path):
    writer.tap("sent", b"v\r")

    with pytest.raises(InputError, match="line 2: not a line"):
        read_capture(tmp_path / "session.jsonl")


def replaying(*events):
    stream = ReplayStream()
    stream.play(Call("measure", tuple(Event(0.0, *event) for event in events)))
    return stream


def test_replay_answers_as_captured():
    stream = replaying(("sent", b"v\r"), ("received", b"X-"), ("received", b"RITE"))

    stream.write(b"v\r")

    assert [stream.read(1.0), stream.read(1.0)] == [b"X-", b"RITE"]
    assert stream.clock() == 0.0


def test_replayed_silence_lasts_until_the_link_has_waited():
    stream = replaying(("silence", b""), ("received", b"late"))

    pieces = [stream.read(0.5), stream.read(0.25)]
    stream.tap("silence", b"")

    assert pieces == [b"", b""]
    assert stream.clock() == 0.75
    assert stream.read(1.0) == b"late"


def test_other_command_than_captured_is_refused():
    with pytest.raises(InputError, match=r"holds 'v\\r' \(sent\).*sends 'ys\\r'"):
        replaying(("sent", b"v\r")).write(b"ys\r")


def test_command_out_of_turn_is_refused():
    with pytest.raises(InputError, match=r"holds a silence \(silence\).*sends 'v\\r'"):
        replaying(("silence", b"")).write(b"v\r")


def test_waiting_out_of_turn_is_refused():
    with pytest.raises(InputError, match="but the driver waits for an answer"):
        replaying(("sent", b"v\r")).read(1.0)


def test_end_of_the_capture_is_like_an_unplug():
    with pytest.raises(LinkError, match="capture of this call ends here"):
        replaying().read(1.0)
