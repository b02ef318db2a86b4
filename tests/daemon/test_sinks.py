"""Events posted to another program, a real server on loopback."""

from __future__ import annotations

import hashlib
import hmac
import json
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from paintlink.config import SinkSettings
from paintlink.daemon.journal import Journal
from paintlink.daemon.sinks import SinkWorker
from tests.daemon.conftest import make_spec


class Listener(HTTPServer):
    """A program that keeps what it is told, once it is willing to."""

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.answers: list[int] = []
        self.told: list[tuple[dict[str, object], dict[str, str]]] = []
        self.bodies: list[bytes] = []

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.server_port}/hook"


class Handler(BaseHTTPRequestHandler):
    server: Listener

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        code = self.server.answers.pop(0) if self.server.answers else 204
        if code == 204:
            self.server.bodies.append(body)
            self.server.told.append((json.loads(body), dict(self.headers)))
        self.send_response(code)
        if code == 302:
            self.send_header("Location", self.server.url)
        self.end_headers()

    def log_message(self, *args: object) -> None:
        pass


@pytest.fixture
def listener() -> Iterator[Listener]:
    with Listener() as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        yield server
        server.shutdown()
        thread.join()


class Clock:
    now = 1000.0

    def __call__(self) -> float:
        return self.now


def worker(journal: Journal, listener: Listener, **changes: object) -> SinkWorker:
    sink = SinkSettings(name="hook", url=listener.url, **changes)  # type: ignore[arg-type]
    made = SinkWorker(journal, sink, Clock())
    journal.accept_file("a.xml", "hash", make_spec())
    (job,) = journal.jobs()
    journal.fail(job.id, "no paint")
    return made


def drain(sink: SinkWorker) -> None:
    while sink.step():
        pass


def test_every_event_is_told_once_in_order(
    journal: Journal, listener: Listener
) -> None:
    drain(worker(journal, listener))

    (job,) = journal.jobs()
    assert [told["kind"] for told, _ in listener.told] == ["file", "failed"]
    assert {told["job"] for told, _ in listener.told} == {job.token}
    assert [headers["X-Paintlink-Event"] for _, headers in listener.told] == ["1", "2"]
    assert all(len(str(told["chain"])) == 64 for told, _ in listener.told)


@pytest.mark.parametrize("answer", [500, 404, 302])
def test_refused_event_is_told_again_and_keeps_its_place(
    journal: Journal, listener: Listener, answer: int
) -> None:
    listener.answers = [answer, answer]
    sink = worker(journal, listener)

    drain(sink)
    too_early = list(listener.told)
    sink._clock.now += 1.0  # type: ignore[attr-defined]
    drain(sink)
    still = list(listener.told)
    sink._clock.now += 2.0  # type: ignore[attr-defined]
    drain(sink)

    assert (too_early, still) == ([], [])
    assert [told["kind"] for told, _ in listener.told] == ["file", "failed"]


def test_absent_program_loses_nothing(journal: Journal, listener: Listener) -> None:
    sink = worker(journal, listener)
    lost = SinkSettings(name="hook", url="http://127.0.0.1:9/nobody")
    absent = SinkWorker(journal, lost, Clock())

    drain(absent)
    sink._clock.now += 300.0  # type: ignore[attr-defined]
    drain(sink)

    assert [told["kind"] for told, _ in listener.told] == ["file", "failed"]


def test_only_the_wanted_kinds_are_told(journal: Journal, listener: Listener) -> None:
    drain(worker(journal, listener, kinds=("failed",)))

    assert [told["kind"] for told, _ in listener.told] == ["failed"]


def test_posts_are_signed_with_the_shared_secret(
    journal: Journal, listener: Listener
) -> None:
    drain(worker(journal, listener, secret="tell nobody"))

    body, (_, headers) = listener.bodies[0], listener.told[0]
    digest = hmac.new(b"tell nobody", body, hashlib.sha256).hexdigest()
    assert headers["X-Paintlink-Signature"] == f"sha256={digest}"


def test_new_sink_hears_nothing_of_the_past(
    journal: Journal, listener: Listener
) -> None:
    journal.accept_file("old.xml", "old", make_spec("old"))
    sink = SinkSettings(name="late", url=listener.url)
    late = SinkWorker(journal, sink, Clock())
    journal.accept_file("new.xml", "new", make_spec("new"))

    drain(late)

    assert [told["text"] for told, _ in listener.told] == ["new.xml"]
