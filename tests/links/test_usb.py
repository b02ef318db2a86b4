"""USB instruments through pyusb, over the user-space USB/IP client."""

import errno
import threading
import time

import pytest
import usb.core

from paintlink.errors import LinkError, LinkTimeoutError
from paintlink.instrument import Link, SerialSettings, UsbSettings, up_to
from paintlink.links import kind_of, open_link
from paintlink.links.usb_devices import find_device, usb_devices
from paintlink.links.usb_stream import UsbStream, open_usb
from paintlink.links.usbip_backend import UsbIpBackend
from paintlink.links.usbip_client import UsbIpClient
from tests.links.usbip_peer import BUSID, Peer

LINE = SerialSettings()
DTP20 = UsbSettings(0x0765, 0xD020)
SPECTRUM = bytes(range(62))


@pytest.fixture
def peer():
    peer = Peer({b"SV\r": [b"X-Rite DTP20\r<00>"], b"01GM\r": [SPECTRUM]})
    yield peer
    peer.close()


@pytest.fixture
def stream(peer):
    stream = open_link(peer.address, LINE, DTP20)
    yield stream
    stream.close()


def test_commands_go_out_as_control_transfers_and_answers_come_in(peer, stream):
    stream.write(b"SV\r")

    assert stream.read(2.0) == b"X-Rite DTP20\r<00>"
    assert peer.commands == [b"SV\r"]


def test_every_byte_value_passes_in(peer, stream):
    for start in range(0, 256, 64):
        peer.send(bytes(range(start, start + 64)))

    data = b""
    while len(data) < 256:
        data += stream.read(2.0)

    assert data == bytes(range(256))


def test_packet_is_never_lost_to_a_small_buffer(peer, stream):
    link = Link(stream, clock=time.monotonic)
    peer.send(b"Z" * 64)

    assert link.receive(lambda data: 62 if len(data) >= 62 else 0, 2.0) == b"Z" * 62


def test_link_talks_over_usb_as_over_a_line(stream):
    link = Link(stream, clock=time.monotonic)

    assert link.request(b"SV\r", up_to(rb"<..>"), 2.0) == b"X-Rite DTP20\r<00>"


def test_silence_reads_as_nothing_and_takes_the_transfer_back(peer, stream):
    start = time.monotonic()

    assert stream.read(0.1) == b""
    assert time.monotonic() - start >= 0.1
    assert peer.unlinks >= 1
    assert peer.pending == []


def test_packet_that_crosses_its_recall_is_kept(peer, stream):
    peer.late_packet = b"just in time"

    assert stream.read(0.05) == b"just in time"
    assert stream.read(0.05) == b""
    stream.write(b"SV\r")
    assert stream.read(2.0) == b"X-Rite DTP20\r<00>"


def test_stale_packets_are_dropped_on_opening(peer):
    peer.packets = [b"old", b"older"]

    stream = open_link(peer.address, LINE, DTP20)
    stream.write(b"SV\r")

    assert stream.read(2.0) == b"X-Rite DTP20\r<00>"
    stream.close()


def test_configuration_is_set_only_when_it_is_another(peer):
    for _ in range(2):
        open_link(peer.address, LINE, DTP20).close()

    assert peer.configurations == 1


def test_unplug_while_reading_is_a_lost_link(peer, stream):
    timer = threading.Timer(0.1, peer.unplug)
    timer.start()

    with pytest.raises(LinkError, match=r"usb\+ip:.*is lost: check the plug"):
        stream.read(20.0)

    timer.join()
    with pytest.raises(LinkError, match="is lost"):
        stream.write(b"SV\r")


def test_server_that_never_answers_is_noticed(peer, stream, monkeypatch):
    monkeypatch.setattr("paintlink.links.usbip_client.ANSWER_S", 0.1)
    peer.deaf_to_unlink = True

    with pytest.raises(LinkError, match="is lost"):
        stream.read(0.05)


def test_stalled_endpoint_is_an_error_and_works_after_it(peer, stream):
    peer.stall = True

    with pytest.raises(LinkError, match="refused a USB transfer: plug it out and in"):
        stream.read(1.0)
    stream.write(b"SV\r")

    assert stream.read(2.0) == b"X-Rite DTP20\r<00>"


def test_replugged_instrument_opens_again(peer, stream):
    peer.unplug()
    with pytest.raises(LinkError, match="is lost"):
        stream.read(1.0)
    stream.close()

    again = open_link(peer.address, LINE, DTP20)
    again.write(b"01GM\r")

    assert again.read(2.0) == SPECTRUM
    again.close()


def test_other_device_at_the_bus_id_is_refused(peer):
    with pytest.raises(
        LinkError, match="is a device 0765:d020, this driver is for 132b:0001"
    ):
        open_link(peer.address, LINE, UsbSettings(0x132B, 1))


def test_unknown_bus_id_names_what_is_exported(peer):
    address = peer.address.replace("/1-1", "/2-1")

    with pytest.raises(LinkError, match=r"not export this device; it exports 1-1"):
        open_link(address, LINE, DTP20)


def test_nobody_listening_is_said(peer):
    peer.close()

    with pytest.raises(LinkError, match=r"cannot be reached .*USB/IP server runs"):
        open_link(peer.address, LINE, DTP20)


def test_missing_endpoint_is_another_protocol(peer):
    with pytest.raises(LinkError, match="does not speak the protocol of this driver"):
        open_link(peer.address, LINE, UsbSettings(0x0765, 0xD020, in_endpoint=0x82))


@pytest.mark.parametrize(
    "address",
    ["usb://765:d020", "usb://0765", "usb+ip://host", "usb+ip://host:x/1-1", "usb://"],
)
def test_malformed_usb_address_is_refused(address):
    with pytest.raises(LinkError, match=r"is no address of a port such as usb"):
        open_link(address, LINE, DTP20)


def test_serial_instrument_has_no_usb_address():
    with pytest.raises(LinkError, match="has a serial line, not a USB protocol"):
        open_link("usb://0765:d020", LINE)


@pytest.mark.parametrize(
    ("address", "kind"),
    [
        ("/dev/ttyUSB0", "device"),
        ("socket://host:1", "network"),
        ("rfc2217://host:1", "network"),
        ("usb://0765:d020/1", "usb"),
        ("usb+ip://host/1-1", "usbip"),
    ],
)
def test_kind_of_an_address_is_in_its_scheme(address, kind):
    assert kind_of(address) == kind


@pytest.fixture
def backend(peer):
    """Return a back end of pyusb that holds the peer's device."""
    client = UsbIpClient(peer.host, peer.port, BUSID)
    yield UsbIpBackend(client)
    client.close()


def test_device_is_found_by_ids_and_serial_number(backend):
    stream = open_usb("usb://0765:D020/SIM00001", DTP20, backend=backend)
    stream.write(b"SV\r")

    assert stream.read(2.0) == b"X-Rite DTP20\r<00>"
    stream.close()


@pytest.mark.parametrize("address", ["usb://0765:d020/OTHER", "usb://0765:d021"])
def test_absent_device_is_said(backend, address):
    with pytest.raises(LinkError, match=f"{address} is not plugged in"):
        open_usb(address, DTP20, backend=backend)


def test_two_devices_need_a_serial_number(backend):
    class Twice(type(backend)):
        def enumerate_devices(self):
            return [self._client, self._client]

    backend.__class__ = Twice

    with pytest.raises(LinkError, match=r"fits 2 .*SIM00001, SIM00001.*write"):
        find_device(backend, 0x0765, 0xD020, "", address="usb://0765:d020")


def test_devices_are_listed_with_their_address(backend):
    (found,) = usb_devices({"0765:d020"}, backend)

    assert (found.address, found.description, found.problem) == (
        *("usb://0765:d020/SIM00001", "DTP20", ""),
    )


def test_device_of_a_known_maker_without_a_driver_is_told_of(backend):
    (found,) = usb_devices({"132b:0001"}, backend)

    assert found.address == ""
    assert found.problem.startswith("no driver for 0765:d020 of X-Rite: let its own")


class Broken:
    """A device of pyusb whose every call fails with one error."""

    bus = address = None

    def __init__(self, failure):
        self.failure = failure

    @property
    def _ctx(self):
        return self

    def __getattr__(self, name):
        def fail(*_):
            raise self.failure

        return fail


@pytest.mark.parametrize(
    ("failure", "text"),
    [
        (usb.core.USBError("gone", errno=errno.ENODEV), "is lost"),
        (usb.core.USBError("odd"), "is lost"),
        (ValueError("no langid"), "is lost"),
    ],
)
def test_any_failure_of_pyusb_is_a_lost_link(failure, text):
    stream = UsbStream(Broken(failure), DTP20, "usb://0765:d020")

    with pytest.raises(LinkError, match=text):
        stream.read(1.0)
    with pytest.raises(LinkError, match=text):
        stream.write(b"SV\r")


def test_instrument_that_takes_nothing_is_noticed():
    failure = usb.core.USBTimeoutError("timed out", errno=errno.ETIMEDOUT)
    stream = UsbStream(Broken(failure), DTP20, "usb://0765:d020")

    with pytest.raises(LinkTimeoutError, match="takes no more bytes: switch"):
        stream.write(b"SV\r")


@pytest.mark.parametrize(
    ("code", "text"),
    [
        (errno.EACCES, r"no permission .*60-paintlink.rules"),
        (errno.EBUSY, "in use by another program: close it there first"),
        (errno.ENODEV, "went away while it was opened"),
        (errno.EIO, "cannot be opened .*plug it out and in again"),
    ],
)
def test_each_failure_to_claim_has_its_sentence(code, text):
    from paintlink.links.usb_stream import claimed

    device = Broken(usb.core.USBError("why", errno=code))
    stream = UsbStream(device, DTP20, "usb://0765:d020")

    with pytest.raises(LinkError, match=text):
        claimed(stream, device, "usb://0765:d020")
