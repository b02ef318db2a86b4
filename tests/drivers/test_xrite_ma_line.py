"""The driver over real pseudo-terminals, and from a capture of such a session."""

import os
import select
import threading
import time
import tty
from datetime import UTC, datetime

import numpy as np
import pytest

from paintlink.errors import InputError, LinkError
from paintlink.instrument import Link, SerialSettings, load_driver
from paintlink.links import CaptureWriter, open_serial, read_capture, replay
from tests.drivers import ma_peer as ma


class Terminal:
    """The scripted peer behind a real pseudo-terminal, served by a thread."""

    def __init__(self, peer):
        self.peer = peer
        self.master, slave = os.openpty()
        tty.setraw(slave)
        self.path = os.ttyname(slave)
        self.slave = slave
        self.stop_reader, self.stop_writer = os.pipe()
        self.thread = threading.Thread(target=self._serve)
        self.thread.start()

    def press(self, sentence):
        os.write(self.master, self.peer.report)

    def unplug(self, sentence=""):
        if not self.thread.is_alive():
            return
        os.write(self.stop_writer, b"x")
        self.thread.join()
        for descriptor in (self.master, self.slave, self.stop_reader, self.stop_writer):
            os.close(descriptor)

    def _serve(self):
        heard = b""
        while True:
            ready, _, _ = select.select([self.master, self.stop_reader], [], [])
            if self.stop_reader in ready:
                return
            heard += os.read(self.master, 4096)
            while b"\r" in heard:
                command, _, heard = heard.partition(b"\r")
                os.write(self.master, self.peer.answers.get(command + b"\r", b"?\r\n"))


@pytest.fixture
def terminal():
    terminal = Terminal(ma.Peer(ma.golden_answers(), report=ma.golden_report()))
    yield terminal
    terminal.unplug()


def test_reading_over_a_terminal_is_the_golden_one(terminal):
    stream = open_serial(terminal.path, SerialSettings())
    driver = load_driver("xrite_ma").create(Link(stream, clock=time.monotonic), {})

    reading = driver.measure(terminal.press)
    stream.close()

    golden = load_driver("xrite_ma").factors(ma.dump_text(ma.GOLDEN_HEX))
    assert np.array_equal(reading.spectra.factors[0], golden)


def test_unplug_while_waiting_for_the_press(terminal):
    stream = open_serial(terminal.path, SerialSettings())
    driver = load_driver("xrite_ma").create(Link(stream, clock=time.monotonic), {})

    with pytest.raises(LinkError, match=f"connection to {terminal.path} is lost"):
        driver.measure(terminal.unplug)

    stream.close()


@pytest.fixture
def captured(terminal, tmp_path):
    """Return a captured session of three calls, and its reading."""
    path = tmp_path / "session.jsonl"
    module = load_driver("xrite_ma")
    writer = CaptureWriter(
        path, driver="xrite_ma", options={}, started_at=datetime.now(UTC)
    )
    stream = open_serial(terminal.path, SerialSettings())
    driver = module.create(Link(stream, clock=time.monotonic, tap=writer.tap), {})
    writer.call("identify")
    driver.identify()
    writer.call("calibration")
    driver.calibration()
    writer.call("measure")
    reading = driver.measure(terminal.press)
    writer.close()
    stream.close()
    return path, reading


def test_replay_gives_the_reading_bit_for_bit(captured):
    path, reading = captured

    capture = read_capture(path)
    outcomes = list(replay(capture, load_driver(capture.driver)))

    assert [outcome.verb for outcome in outcomes] == [
        *("identify", "calibration", "measure"),
    ]
    assert outcomes[0].value.model == "MA68II"
    assert outcomes[1].value == "valid"
    again = outcomes[2].value
    assert again.raw == reading.raw
    assert again.geometries == reading.geometries
    assert again.spectra.factors.tobytes() == reading.spectra.factors.tobytes()


def test_replay_of_a_torn_capture_ends_as_an_unplug(captured):
    path, _ = captured
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) - 600])
    capture = read_capture(path)

    *_, last = replay(capture, load_driver("xrite_ma"))

    assert last.value is None
    with pytest.raises(LinkError, match="the capture of this call ends here"):
        raise last.error


def test_replay_with_another_driver_is_refused(captured):
    path, _ = captured
    path.write_text(path.read_text().replace('"sent": "79730d"', '"sent": "7a730d"'))

    with pytest.raises(
        InputError, match=r"holds 'zs\\r' \(sent\), but the driver sends"
    ):
        list(replay(read_capture(path), load_driver("xrite_ma")))
