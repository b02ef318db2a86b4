import errno
import os
import select
import socket
import termios
import threading
import time

import pytest
import serial
from serial import SerialException, rfc2217

from paintlink.errors import LinkError, LinkTimeoutError
from paintlink.instrument import Link, SerialSettings
from paintlink.links import SerialStream, open_serial
from paintlink.links.advice import cannot_open

LINE = SerialSettings()
EVERY_BYTE = bytes(range(256))


@pytest.fixture
def opened():
    """Return a function that opens an address and closes it after the test."""
    streams = []

    def open_it(address, settings=LINE):
        streams.append(open_serial(address, settings))
        return streams[-1]

    yield open_it
    for stream in streams:
        stream.close()


def gathered(stream, size):
    data = b""
    while len(data) < size and (piece := stream.read(2.0)):
        data += piece
    return data


def test_every_byte_value_passes_both_ways(opened, terminal):
    stream = opened(terminal.path)

    stream.write(EVERY_BYTE)
    os.write(terminal.master, EVERY_BYTE)

    assert os.read(terminal.master, 1024) == EVERY_BYTE
    assert gathered(stream, 256) == EVERY_BYTE


def test_silence_reads_as_nothing_in_time(opened, terminal):
    stream = opened(terminal.path)
    start = time.monotonic()

    data = stream.read(0.1)

    assert data == b""
    assert time.monotonic() - start >= 0.1


def test_look_without_patience_does_not_wait():
    class Idle:
        is_open = True
        in_waiting = 0

    assert SerialStream(Idle(), "/dev/ttyUSB0").read(0.0) == b""


def test_read_returns_what_is_there(opened, terminal):
    stream = opened(terminal.path)
    os.write(terminal.master, b"OK\r\n")

    assert stream.read(5.0) == b"OK\r\n"


def test_input_from_before_the_opening_is_dropped(opened, terminal):
    os.write(terminal.master, b"old report\r\n")
    stream = opened(terminal.path)
    os.write(terminal.master, b"new")

    assert stream.read(2.0) == b"new"


def test_unplug_while_reading_is_a_lost_link(opened, terminal):
    stream = opened(terminal.path)
    timer = threading.Timer(0.1, terminal.unplug)
    timer.start()

    with pytest.raises(LinkError, match=f"{terminal.path} is lost: check the plug"):
        stream.read(20.0)

    timer.join()


def test_unplug_before_writing_is_a_lost_link(opened, terminal):
    stream = opened(terminal.path)
    terminal.unplug()

    with pytest.raises(LinkError, match=f"{terminal.path} is lost: check the plug"):
        stream.write(b"v\r")
    with pytest.raises(LinkError, match="is lost"):
        stream.read(1.0)


def test_instrument_that_takes_nothing_is_noticed(terminal, monkeypatch):
    monkeypatch.setattr("paintlink.links.stream._WRITE_TIMEOUT_S", 0.1)
    stream = open_serial(terminal.path, LINE)

    with pytest.raises(LinkTimeoutError, match="takes no more bytes: switch"):
        stream.write(bytes(1_000_000))

    stream.close()


def test_close_never_fails(opened, terminal):
    stream = opened(terminal.path)
    terminal.unplug()

    stream.close()
    stream.close()

    with pytest.raises(LinkError, match="is lost"):
        stream.read(0.0)


def test_missing_device_is_named_with_a_next_step(tmp_path):
    missing = tmp_path / "ttyUSB7"

    with pytest.raises(LinkError, match=f"{missing} does not exist: plug the"):
        open_serial(str(missing), LINE)


@pytest.mark.parametrize("kind", ["file", "folder"])
def test_what_is_no_port_is_refused(tmp_path, kind):
    path = tmp_path / kind
    path.mkdir() if kind == "folder" else path.write_text("")

    with pytest.raises(LinkError, match=f"{path} is not a serial port: write a device"):
        open_serial(str(path), LINE)


def test_second_opening_names_the_holder(opened, terminal):
    opened(terminal.path)

    with pytest.raises(
        LinkError, match=rf"{terminal.path} is in use by .*\(process {os.getpid()}\): "
    ):
        open_serial(terminal.path, LINE)


def test_closing_lets_the_next_one_in(opened, terminal):
    opened(terminal.path).close()

    assert isinstance(opened(terminal.path), SerialStream)


@pytest.mark.parametrize("opened_before", [False, True])
@pytest.mark.parametrize(("bits", "parity"), [(7, "E"), (8, "E"), (7, "N")])
def test_parity_on_a_pseudo_terminal_is_refused(terminal, opened_before, bits, parity):
    if opened_before:
        open_serial(terminal.path, LINE).close()

    with pytest.raises(
        LinkError, match=f"refuses 9600 {bits}{parity}1: .*pseudo-terminal carries 8"
    ) as caught:
        open_serial(terminal.path, SerialSettings(bytesize=bits, parity=parity))

    # The port is free again although the traceback of the failure is still held.
    assert caught.tb
    open_serial(terminal.path, LINE).close()


@pytest.mark.parametrize(
    "address",
    [
        "ftp://host:1",
        "spy:///dev/null?file=/tmp/x",
        "socket://host",
        "socket://:7000",
        "rfc2217://host:port",
        "loop://x",
    ],
)
def test_unknown_address_is_refused(address):
    with pytest.raises(LinkError, match=r"no address of a port: write a device"):
        open_serial(address, LINE)


def test_loop_returns_what_was_sent(opened):
    stream = opened("loop://")

    stream.write(EVERY_BYTE)

    assert gathered(stream, 256) == EVERY_BYTE


@pytest.fixture
def server():
    """Return a listening TCP socket."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        yield listener


def address_of(listener, scheme="socket"):
    host, port = listener.getsockname()
    return f"{scheme}://{host}:{port}"


def test_every_byte_value_passes_a_tcp_link(opened, server):
    stream = opened(address_of(server))
    remote, _ = server.accept()

    with remote:
        stream.write(EVERY_BYTE)
        remote.sendall(EVERY_BYTE)

        assert remote.recv(1024) == EVERY_BYTE
        assert gathered(stream, 256) == EVERY_BYTE


def test_line_is_read_over_a_tcp_link(opened, server):
    stream = opened(address_of(server))
    remote, _ = server.accept()
    link = Link(stream, clock=time.monotonic)

    with remote:
        link.send(b"v\r")
        question = remote.recv(16)
        remote.sendall(b"X-RITE MA68II 3.02")

        assert question == b"v\r"
        assert link.read_line(2.0) == "X-RITE MA68II 3.02"


def test_server_that_goes_away_is_a_lost_link(opened, server):
    stream = opened(address_of(server))
    server.accept()[0].close()

    with pytest.raises(LinkError, match="is lost"):
        stream.read(5.0)


def test_nobody_listening_is_said(server):
    address = address_of(server)
    server.close()

    with pytest.raises(LinkError, match=r"cannot be reached \(Connection refused\): "):
        open_serial(address, LINE)


class RemotePort:
    """An RFC 2217 server, pyserial's own, in front of an echoing loop:// port."""

    def __init__(self, listener):
        self.port = serial.serial_for_url("loop://", timeout=0)
        self.listener = listener
        self.thread = threading.Thread(target=self._serve)
        self.going = True
        self.thread.start()

    def stop(self):
        self.going = False
        self.thread.join()

    def write(self, data):
        self.connection.sendall(data)

    def _serve(self):
        self.connection, _ = self.listener.accept()
        manager = rfc2217.PortManager(self.port, self)
        with self.connection:
            while self.going:
                ready, _, _ = select.select([self.connection], [], [], 0.01)
                data = self.connection.recv(1024) if ready else b""
                if ready and not data:
                    return
                self.port.write(b"".join(manager.filter(data)))
                self.write(b"".join(manager.escape(self.port.read(1024))))


@pytest.fixture
def remote_port(server):
    remote = RemotePort(server)
    yield remote
    remote.stop()


# pyserial's client names its thread the old way.
old_thread_names = pytest.mark.filterwarnings(
    "ignore:set(Daemon|Name):DeprecationWarning"
)


@old_thread_names
def test_bytes_and_settings_pass_an_rfc2217_link(opened, server, remote_port):
    settings = SerialSettings(baudrate=4800, dtr=False, rts=False)
    stream = opened(address_of(server, "rfc2217"), settings)

    stream.write(EVERY_BYTE)

    assert gathered(stream, 256) == EVERY_BYTE
    port = remote_port.port
    assert (port.baudrate, port.dtr, port.rts) == (4800, False, False)


@old_thread_names
def test_rfc2217_server_that_goes_away_is_a_lost_link(opened, server, remote_port):
    stream = opened(address_of(server, "rfc2217"))
    remote_port.stop()

    with pytest.raises(LinkError, match="is lost"):
        stream.read(5.0)


def test_flow_control_and_stop_bits_reach_the_port(opened, terminal):
    opened(terminal.path, SerialSettings(stopbits=2, rtscts=True))

    flags = termios.tcgetattr(terminal.master)

    assert flags[2] & termios.CSTOPB
    assert flags[2] & termios.CRTSCTS
    assert not flags[0] & (termios.IXON | termios.IXOFF)


@pytest.mark.parametrize(
    ("failure", "text"),
    [
        (OSError(errno.EIO, "I/O error"), "is lost"),
        (SerialException("write failed"), "is lost"),
        (ValueError("bad"), "is lost"),
    ],
)
def test_any_failure_of_the_port_is_a_lost_link(failure, text):
    class Broken:
        def read(self, size):
            raise failure

    with pytest.raises(LinkError, match=text) as caught:
        SerialStream(Broken(), "/dev/ttyUSB0").read(1.0)

    assert caught.value.__cause__ is failure


def test_failure_while_closing_is_swallowed():
    class Broken:
        closed = False

        def reset_output_buffer(self):
            raise termios.error(errno.EIO, "I/O error")

        def close(self):
            self.closed = True
            raise OSError(errno.EIO, "I/O error")

    port = Broken()

    SerialStream(port, "/dev/ttyUSB0").close()

    assert port.closed


def test_server_without_modem_lines_is_told_from_one_that_is_away():
    failure = SerialException("timeout while waiting for option 'control'")

    error = cannot_open("rfc2217://host:4001", LINE, failure)

    assert str(error) == (
        "rfc2217://host:4001 cannot set the DTR and RTS lines: write "
        "rfc2217://host:4001?ign_set_control"
    )
