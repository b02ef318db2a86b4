"""Hints: welcome when they come, never needed."""

from __future__ import annotations

import logging
import random
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from paintlink.daemon import hints
from paintlink.daemon.hints import Hints
from paintlink.intake import Mount

LIMIT_S = 10.0


class Nobody:
    """A watcher that never tells anything."""

    def schedule(self, handler: Callable[[], None], folder: Path) -> None:
        pass

    def start(self) -> None:
        pass

    def stop(self) -> None:
        pass


class Unreliable(hints.Observing):
    """Drops every second event and tells the others twice, by chance."""

    def __init__(self) -> None:
        super().__init__()
        self.chance = random.Random(3)

    def schedule(self, handler: Callable[[], None], folder: Path) -> None:
        def tell() -> None:
            if self.chance.random() < 0.5:
                handler()
                handler()

        super().schedule(tell, folder)


class Exhausted(Nobody):
    def start(self) -> None:
        raise OSError(24, "inotify instance limit reached")


def test_new_file_wakes_the_worker(tmp_path: Path) -> None:
    woken = threading.Event()
    watching = Hints()
    watching.watch(tmp_path, woken.set)
    watching.start()
    try:
        (tmp_path / "a.xml").write_text("<a/>")
        assert woken.wait(LIMIT_S)
    finally:
        watching.stop()


def test_system_without_watches_left_is_no_fault(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    watching = Hints(Exhausted)
    watching.watch(tmp_path, lambda: None)

    with caplog.at_level(logging.WARNING):
        watching.start()
    watching.stop()

    assert "they are looked into" in caplog.text


def test_shares_and_missing_folders_are_not_watched(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hints, "mount_of", lambda folder: Mount(folder, "cifs"))
    made: list[object] = []
    watching = Hints(lambda: made.append(1) or Nobody())
    watching.watch(tmp_path, lambda: None)
    watching.watch(tmp_path / "gone", lambda: None)

    watching.start()

    assert made == []
