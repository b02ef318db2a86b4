"""A peer for any driver: fixed answers to fixed commands, one after another."""

from collections.abc import Mapping

from paintlink.instrument import Driver, Link, load_driver
from tests.drivers import ma_peer


class Peer(ma_peer.Peer):
    """As `ma_peer.Peer`; an answer may also be a list: one for each time it is asked.

    The last answer of a list stays.
    """

    def write(self, data: bytes) -> None:
        self.sent.append(data)
        self.say(data + b"\n" if self.echo else b"")
        answer = self.answers.get(data, b"")
        if isinstance(answer, list):
            answer = answer.pop(0) if len(answer) > 1 else answer[0]
        self.say(answer)


def connect(
    driver_id: str, peer: Peer, options: Mapping[str, object] | None = None
) -> Driver:
    """Return the driver on a link to the peer."""
    return load_driver(driver_id).create(Link(peer, clock=peer.clock), options or {})
