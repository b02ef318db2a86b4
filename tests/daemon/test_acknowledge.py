"""Nobody is told of a reading before it is stored."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from paintlink.config import InstrumentSettings
from paintlink.daemon.instruments import InstrumentWorker
from paintlink.daemon.journal import Journal
from paintlink.errors import JournalError
from paintlink.model import Reading
from tests.daemon.conftest import make_reading

SETTINGS = InstrumentSettings(name="bench", driver="xrite_ma", port="/dev/null")


class Calibrated:
    """A clock by which no calibration is due."""

    def due(self) -> None:
        return None


def worker(path: Path, told: list[str]) -> InstrumentWorker:
    made = InstrumentWorker(
        SETTINGS, path, stop=threading.Event(), wake_line=lambda: told.append("line")
    )
    made._journal = Journal(path)
    return made


def test_stored_reading_is_told_of(tmp_path: Path) -> None:
    told: list[str] = []
    one = worker(tmp_path / "journal.db", told)

    one._accept(make_reading(), Calibrated())  # type: ignore[arg-type]

    assert told == ["line"]
    assert len(one._journal.jobs()) == 1


def test_reading_that_cannot_be_stored_is_told_to_nobody(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[str] = []
    one = worker(tmp_path / "journal.db", told)

    def refuse(reading: Reading, *, source: str) -> str:
        raise JournalError("disk I/O error")

    monkeypatch.setattr(one._journal, "accept_reading", refuse)

    with pytest.raises(JournalError, match="disk I/O error"):
        one._accept(make_reading(), Calibrated())  # type: ignore[arg-type]
    assert told == []
