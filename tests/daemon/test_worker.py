from __future__ import annotations

import logging
import threading
from collections.abc import Callable

import pytest

from paintlink.daemon import worker as worker_module
from paintlink.daemon.worker import Worker
from paintlink.errors import JournalError, JournalFullError

LIMIT_S = 10.0


def run(step: Callable[[], bool], stop: threading.Event) -> Worker:
    worker = Worker("test", lambda: step, stop=stop, idle_s=0.01)
    worker.start()
    return worker


def test_worker_is_idle_only_without_work() -> None:
    stop, left = threading.Event(), [3]

    def step() -> bool:
        left[0] -= 1
        return left[0] >= 0

    worker = run(step, stop)
    idle = worker.idle.wait(LIMIT_S)
    stop.set()
    worker.join(LIMIT_S)

    assert idle
    assert left[0] < 0
    assert not worker.is_alive()


def test_untrusted_journal_ends_the_service(caplog: pytest.LogCaptureFixture) -> None:
    stop = threading.Event()

    def step() -> bool:
        raise JournalError("disk I/O error")

    worker = run(step, stop)
    worker.join(LIMIT_S)

    assert stop.is_set()
    assert "the journal cannot be trusted" in caplog.text


def test_program_fault_is_logged_and_work_goes_on(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker_module, "PAUSE_AFTER_FAULT_S", 0.0)
    stop, again, calls = threading.Event(), threading.Event(), []

    def step() -> bool:
        calls.append(1)
        if len(calls) == 1:
            raise ZeroDivisionError
        again.set()
        return False

    with caplog.at_level(logging.ERROR):
        worker = run(step, stop)
        survived = again.wait(LIMIT_S)
    stop.set()
    worker.join(LIMIT_S)

    assert survived
    assert "a fault of the program" in caplog.text
    assert "ZeroDivisionError" in caplog.text


def test_full_disk_is_waited_out(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker_module, "PAUSE_AFTER_FAULT_S", 0.0)
    stop, again, calls = threading.Event(), threading.Event(), []

    def step() -> bool:
        calls.append(1)
        if len(calls) == 1:
            raise JournalFullError("database or disk is full")
        again.set()
        return False

    worker = run(step, stop)
    survived = again.wait(LIMIT_S)
    stop.set()
    worker.join(LIMIT_S)

    assert survived
    assert "nothing can be stored" in caplog.text
