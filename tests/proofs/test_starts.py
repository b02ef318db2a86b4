"""It starts anyhow, or says why not: states a shop may be found in (P14)."""

from __future__ import annotations

import shutil
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from paintlink.daemon.journal import Journal
from paintlink.daemon.schema import migrations
from paintlink.errors import ConfigError, JournalError, PaintlinkError
from tests.daemon.conftest import make_spec
from tests.proofs.stages import READINGS, Stages

JUNK = b"\1" * 99
Damage = Callable[[Stages], None]

pytestmark = pytest.mark.timeout(120)


def state_of(stages: Stages) -> Path:
    return stages.settings.state_folder


def write(path: Path, data: bytes | str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data if isinstance(data, bytes) else data.encode())


def execute(stages: Stages, *statements: str) -> None:
    stages.journal().close()
    with closing(sqlite3.connect(stages.settings.journal_path)) as connection:
        for statement in statements:
            connection.execute(statement)
        connection.commit()


def halve(stages: Stages) -> None:
    execute(stages, "CREATE TABLE big AS SELECT zeroblob(99999)")
    path = stages.settings.journal_path
    path.write_bytes(path.read_bytes()[:50_000])
    write(state_of(stages) / "journal.suspect", b"")


def old_journal(stages: Stages, version: int) -> None:
    path = stages.settings.journal_path
    path.parent.mkdir(parents=True, exist_ok=True)
    with closing(sqlite3.connect(path)) as connection:
        for script in migrations()[:version]:
            for statement in script:
                connection.execute(statement)
        connection.execute(f"PRAGMA user_version={version}")
        connection.commit()


def delivery_of_a_lost_route(stages: Stages) -> None:
    with stages.journal() as journal:
        token = journal.accept_file("old.xml", "hash", make_spec())
        job = journal.job(token)
        assert job is not None
        journal.set_matched(job, make_spec(), [], [("gone", "/nowhere")])


STARTS_ANYHOW: dict[str, Damage] = {
    "nothing": lambda s: None,
    "no state folder": lambda s: shutil.rmtree(state_of(s), ignore_errors=True),
    "empty journal file": lambda s: write(s.settings.journal_path, b""),
    "journal of version 1": lambda s: old_journal(s, 1),
    "journal of version 2": lambda s: old_journal(s, 2),
    "stale lock after a kill": lambda s: write(state_of(s) / "journal.lock", b""),
    "stale role lock": lambda s: write(state_of(s) / "line.lock", b"4711"),
    "unfounded suspicion": lambda s: write(state_of(s) / "journal.suspect", b""),
    "log without a journal": lambda s: write(state_of(s) / "journal.db-wal", JUNK),
    "index without a journal": lambda s: write(state_of(s) / "journal.db-shm", JUNK),
    "half a backup": lambda s: write(state_of(s) / ".copy.db.part", JUNK),
    "garbage in staging": lambda s: write(s.hot / ".paintlink" / "junk", b"\0" * 5000),
    "token of another shop": lambda s: write(s.hot / ".paintlink" / "aaaa-1", b"<a/>"),
    "foreign files in the folder": lambda s: [
        write(s.hot / f"{n}.xml", b"<other/>") for n in range(50)
    ] and None,
    "folder gone": lambda s: shutil.rmtree(s.hot),
    "done folder gone": lambda s: shutil.rmtree(s.root / "done"),
    "file left in working": lambda s: write(s.root / "working" / "x.xml", b"<a/>"),
    "half a file carried over": lambda s: write(s.root / "working" / ".x.part", b"<"),
    "link in the inbox": lambda s: (s.root / "inbox" / "l").symlink_to("/etc/passwd"),
    "loop of links": lambda s: (s.root / "inbox" / "o.xml").symlink_to("o.xml"),
    "folder in the inbox": lambda s: (s.root / "inbox" / "d.xml").mkdir(),
    "unknown job in answers": lambda s: write(s.root / "answers" / "a.xml", b"<a/>"),
    "sink that is no more": lambda s: execute(
        s, "INSERT INTO sinks (name, last_event) VALUES ('gone', 99)"
    ),
    "route that is no more": lambda s: delivery_of_a_lost_route(s),
}  # fmt: skip

REFUSES: dict[str, tuple[Damage, str]] = {
    "newer journal": (
        lambda s: execute(s, "PRAGMA user_version=999"),
        "written by a newer paintlink",
    ),
    "text in place of the journal": (
        lambda s: write(s.settings.journal_path, "hello " * 999),
        "is damaged",
    ),
    "half a journal": (lambda s: halve(s), "is damaged"),
    "folder in place of the journal": (
        lambda s: s.settings.journal_path.mkdir(parents=True),
        "cannot",
    ),
    "file in place of the state folder": (
        lambda s: write(state_of(s), b"x"),
        "check .state. folder",
    ),
}


@pytest.mark.parametrize("name", list(STARTS_ANYHOW))
def test_it_starts_anyhow_and_delivers_everything(tmp_path: Path, name: str) -> None:
    stages = Stages(tmp_path / "shop")
    STARTS_ANYHOW[name](stages)
    stages.hot.mkdir(exist_ok=True)
    for folders in stages.inboxes.values():
        folders.create()

    for stage in ("intake", "inbox", "line", "route", "answers"):
        stages.run(stage)

    with stages.journal() as journal:
        done = [job for job in journal.jobs(limit=99) if job.reading_id]
        states = {one.state for job in done for one in job.deliveries}
    assert len(done) == READINGS
    assert states <= {"written"}


@pytest.mark.parametrize("name", list(REFUSES))
def test_it_refuses_to_start_and_changes_nothing(tmp_path: Path, name: str) -> None:
    damage, reason = REFUSES[name]
    stages = Stages(tmp_path / "shop")
    damage(stages)
    path = stages.settings.journal_path
    before = path.read_bytes() if path.is_file() else None

    with pytest.raises((JournalError, ConfigError), match=reason):
        Journal(path)

    assert (path.read_bytes() if path.is_file() else None) == before


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[site",
        "\0\0\0",
        "[site]\nfolder = 3\n",
        "\xef\xbb\xbf[site]\nfolder = 1",
        "[x]",
    ],
)
def test_half_written_configuration_is_named(tmp_path: Path, text: str) -> None:
    from paintlink.config import load_settings

    path = tmp_path / "paintlink.toml"
    path.write_text(text)
    try:
        load_settings(path, environ={"STATE_DIRECTORY": str(tmp_path / "state")})
    except PaintlinkError as error:
        assert "paintlink.toml" in str(error)  # noqa: PT017
    else:
        assert text == ""


@pytest.mark.parametrize(
    "number", [2_000, pytest.param(100_000, marks=pytest.mark.proof)]
)
def test_old_files_in_the_folder_delay_the_start_little(
    tmp_path: Path, number: int
) -> None:
    empty, full = Stages(tmp_path / "empty"), Stages(tmp_path / "full")
    for name in range(number):
        (full.hot / f"{name}.xml").touch()
    empty_s = seconds_to_deliver(empty)
    begun = time.perf_counter()
    names = sum(1 for _ in full.hot.iterdir())
    listing_s = time.perf_counter() - begun

    full_s = seconds_to_deliver(full)

    print(f"{full_s:.2f} s beside {number} files, {empty_s:.2f} s alone")  # noqa: T201
    shutil.rmtree(full.hot)
    assert names == number
    assert full_s < 20 * (empty_s + listing_s)


def seconds_to_deliver(stages: Stages) -> float:
    begun = time.perf_counter()
    for stage in ("intake", "line", "route"):
        stages.run(stage)
    return time.perf_counter() - begun


def test_second_start_is_told_apart_from_a_stale_lock(tmp_path: Path) -> None:
    from paintlink.daemon.roles import RoleLocks

    code = (
        "import sys; from pathlib import Path; from paintlink.daemon.roles import *;"
        "RoleLocks(Path(sys.argv[1]), ROLES); print('held', flush=True);"
        "sys.stdin.read()"
    )
    command = [sys.executable, "-c", code, str(tmp_path)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == b"held\n"
        with pytest.raises(ConfigError, match="another paintlink already runs"):
            RoleLocks(tmp_path, ("line",))
        other.kill()
        other.wait()

    RoleLocks(tmp_path, ("line",)).release()
