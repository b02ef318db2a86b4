"""What a person sees of a long import, and what stopping it does."""

from __future__ import annotations

import os
import pty
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from paintlink.library import Shelf
from tests.library.csv_tables import HEADINGS, rows, write_csv


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    return {"HOME": str(tmp_path / "home"), "PATH": "/usr/bin:/bin", "COLUMNS": "100"}


def start(
    table: Path, environment: dict[str, str], stderr: int
) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "paintlink", "library", "import", str(table)]
    return subprocess.Popen(
        [*command, "--into", "Shop", "--encoding", "utf-8"],
        env=environment, stdout=subprocess.PIPE, stderr=stderr, preexec_fn=_stoppable,
    )  # fmt: skip


def _stoppable() -> None:
    """Undo what a shell does to programs in the background: they ignore Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def stopped(process: subprocess.Popen[bytes]) -> bytes:
    """What a program says that Ctrl-C stops; a pipe that stays silent can miss one."""
    while True:
        process.send_signal(signal.SIGINT)
        try:
            return process.communicate(timeout=5.0)[1]
        except subprocess.TimeoutExpired:
            continue


def test_progress_is_drawn_for_a_person(
    tmp_path: Path, environment: dict[str, str]
) -> None:
    table = write_csv(tmp_path / "paints.csv", rows(20_000))
    ours, theirs = pty.openpty()

    with start(table, {**environment, "TERM": "xterm"}, theirs) as process:
        os.close(theirs)
        seen = b""
        try:
            while piece := os.read(ours, 4096):
                seen += piece
        except OSError:  # the other end of a pty is gone
            pass
    os.close(ours)

    assert process.returncode == 0
    assert b"Reading" in seen
    assert b"Storing" in seen
    assert b"%" in seen


def test_stopped_import_says_that_nothing_changed(
    tmp_path: Path, environment: dict[str, str]
) -> None:
    table = tmp_path / "paints.csv"
    os.mkfifo(table)

    with (
        start(table, environment, subprocess.PIPE) as process,
        table.open("w") as file,  # waits until it is being read
    ):
        file.write(",".join(HEADINGS) + "\n")
        file.flush()
        said = stopped(process)

    assert process.returncode == 130
    assert b"stopped; the libraries stay as they were" in said
    path = tmp_path / "home/.local/state/paintlink/library.db"
    assert Shelf(path).own.present() == ()
