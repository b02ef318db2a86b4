from __future__ import annotations

import threading
from pathlib import Path

import pytest

from paintlink.daemon.loans import Loan, borrowed
from paintlink.errors import LinkError


def test_service_lets_a_command_have_the_instrument(tmp_path: Path) -> None:
    loan = Loan(tmp_path, "bench")
    assert loan.hold()
    got, done = threading.Event(), threading.Event()

    def command() -> None:
        with borrowed(tmp_path, "bench"):
            got.set()
            done.wait(10.0)

    thread = threading.Thread(target=command)
    thread.start()
    while not loan.wanted():
        pass
    assert not got.is_set()
    loan.release()
    assert got.wait(10.0)

    assert not loan.hold()
    done.set()
    thread.join()
    assert loan.hold()
    loan.close()


def test_free_instrument_is_had_at_once(tmp_path: Path) -> None:
    with borrowed(tmp_path, "bench"), borrowed(tmp_path, "other"):
        pass


def test_second_command_is_told_who_holds_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("paintlink.daemon.loans.PATIENCE_S", 0.1)

    with (
        borrowed(tmp_path, "bench"),
        pytest.raises(LinkError, match="bench is in use by another paintlink command"),
        borrowed(tmp_path, "bench"),
    ):
        pass


def test_name_with_slashes_is_a_name(tmp_path: Path) -> None:
    with borrowed(tmp_path, "../bench / left"):
        assert len(list((tmp_path / "instruments").iterdir())) == 2
