"""Frames of 60 bytes with a checksum: docs/wire/chn_cr30.md, section 2."""

from paintlink import errors
from paintlink.instrument import Link, fixed

SIZE, PAYLOAD = 60, slice(0, 58)
TRIGGER = b"\xbb\x01\x00"
# A repeated request is "not implemented", unless the answer follows on it.
ECHO_S = 1.0


def exchange(link: Link, head: bytes, timeout_s: float, *others: bytes) -> bytes:
    """Return the frame that answers ``head``, or one of ``others`` that came by itself.

    Frames with a wrong checksum or another head are passed over.
    """
    body = head.ljust(58, b"\0") + b"\xff"
    request = body + bytes([sum(body) % 256])
    link.send(request)
    frame = receive(link, timeout_s, head, *others)
    if head == TRIGGER or frame[PAYLOAD] != request[PAYLOAD]:
        return frame
    try:
        return receive(link, ECHO_S, head, *others)
    except errors.LinkTimeoutError:
        msg = f"the instrument does not know the command {head.hex(' ')}"
        raise errors.InstrumentError(msg, code=head.hex()) from None


def receive(link: Link, timeout_s: float, *heads: bytes) -> bytes:
    """Return the next whole frame that begins with one of ``heads``."""

    def fits(frame: bytes) -> bool:
        return frame[:3] in heads and sum(frame[:59]) % 256 == frame[59]

    # Any baud rate works, and only replugging ends a silence after long idling.
    try:
        return link.receive(fixed(SIZE, fits), timeout_s)[-SIZE:]
    except errors.LinkTimeoutError as silence:
        msg = "the instrument is silent: plug it out and in again"
        raise errors.LinkTimeoutError(msg, partial=silence.partial) from silence
