"""What happens to a journal before anything is stored in it."""

from __future__ import annotations

import random
import shutil
import sqlite3
from pathlib import Path

import pytest

from paintlink.daemon import opening, schema
from paintlink.daemon.journal import Journal
from paintlink.errors import ConfigError, JournalError
from paintlink.intake import Mount, mount_of
from tests.daemon.conftest import make_reading

MOUNTS = r"""
22 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw
40 22 0:40 / /mnt/two\040words rw - nfs4 server:/x rw
41 22 0:41 / /mnt/hot rw shared:7 - cifs //server/hot rw
42 22 0:42 / /mnt/hot rw - ext4 /dev/sdb1 rw
"""


def stopped_uncleanly(folder: Path, readings: int = 5) -> Path:
    """A journal as a kill leaves it: its last commits are in the log only."""
    with Journal(folder / "running.db") as journal:
        for number in range(readings):
            reading = make_reading(raw=b"raw %d" % number)
            journal.accept_reading(reading, source="bench")
        (folder / "killed").mkdir()
        for end in ("", "-wal"):
            target = folder / "killed" / f"journal.db{end}"
            shutil.copy(folder / f"running.db{end}", target)
    return folder / "killed" / "journal.db"


def flip(path: Path, offset: int, bit: int = 0) -> None:
    data = bytearray(path.read_bytes())
    data[offset] ^= 1 << bit
    path.write_bytes(data)


def fill(journal: Journal) -> None:
    for number in range(100):
        journal.accept_reading(make_reading(raw=b"%d" % number), source="bench")


def log_of(path: Path) -> Path:
    return path.with_name("journal.db-wal")


@pytest.mark.parametrize(
    ("folder", "kind"),
    [("/srv/state", "ext4"), ("/mnt/two words/state", "nfs4"), ("/mnt/hot/x", "ext4")],
)
def test_mount_of_a_folder_is_the_visible_one(
    tmp_path: Path, folder: str, kind: str
) -> None:
    table = tmp_path / "mountinfo"
    table.write_text(MOUNTS)

    assert mount_of(Path(folder), table.with_name("mountinfo")).type == kind


def test_journal_on_a_network_share_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    share = Mount(tmp_path, "cifs")
    monkeypatch.setattr(opening, "mount_of", lambda folder: share)

    with pytest.raises(ConfigError, match=r"a network share \(cifs\).* disk of this"):
        Journal(tmp_path / "journal.db")


def test_kill_loses_nothing_of_the_log(tmp_path: Path) -> None:
    path = stopped_uncleanly(tmp_path)

    with Journal(path) as journal:
        assert len(journal.jobs()) == 5


def test_damage_in_the_file_is_kept_aside_and_refused(tmp_path: Path) -> None:
    path = stopped_uncleanly(tmp_path)
    Journal(path).close()
    flip(path, 4096 * 3 + 1, 6)
    opening.suspect_path(path).touch()
    before = path.read_bytes()

    with pytest.raises(JournalError, match=r"is damaged .*nothing was reset") as first:
        Journal(path)
    with pytest.raises(JournalError, match="is damaged"):
        Journal(path)

    (copy,) = (path.parent / "damaged").iterdir()
    assert str(copy) in str(first.value)
    assert (copy / "journal.db").read_bytes() == before
    assert path.read_bytes() == before


def test_flip_that_cuts_off_synced_commits_is_noticed(tmp_path: Path) -> None:
    path = stopped_uncleanly(tmp_path)
    size = log_of(path).stat().st_size
    flip(log_of(path), size // 2)

    with pytest.raises(JournalError, match="its log is damaged after frame"):
        Journal(path)


def test_flip_in_the_head_of_the_log_is_noticed(tmp_path: Path) -> None:
    path = stopped_uncleanly(tmp_path)
    flip(log_of(path), 13)

    with pytest.raises(JournalError, match="the header of its log is damaged"):
        Journal(path)


def test_torn_end_of_the_log_is_a_power_cut(tmp_path: Path) -> None:
    path = stopped_uncleanly(tmp_path)
    data = log_of(path).read_bytes()
    log_of(path).write_bytes(data[:-100] + bytes(100))

    with Journal(path) as journal:
        assert len(journal.jobs()) == 4


def test_damage_met_while_reading_is_checked_at_next_start(tmp_path: Path) -> None:
    path = stopped_uncleanly(tmp_path, readings=40)
    Journal(path).close()
    journal = Journal(path)
    data = bytearray(path.read_bytes())
    data[4096:] = random.Random(1).randbytes(len(data) - 4096)
    path.write_bytes(data)

    with pytest.raises(JournalError, match=r"cannot be read: .* malformed"):
        journal.jobs()
    journal.close()
    with pytest.raises(JournalError, match="is damaged"):
        Journal(path)


def test_log_stays_bounded_while_somebody_reads(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("paintlink.daemon.database.LOG_LIMIT_BYTES", 200_000)
    monkeypatch.setattr("paintlink.daemon.opening.BUSY_TIMEOUT_S", 0.05)
    path = tmp_path / "journal.db"
    with Journal(path) as journal:
        journal.accept_reading(make_reading(), source="bench")
        reader = sqlite3.connect(path)
        reader.execute("BEGIN").execute("SELECT * FROM jobs").fetchall()

        with pytest.raises(JournalError, match="keeps the journal open: end that"):
            fill(journal)
        reader.close()
        journal.accept_reading(make_reading(raw=b"last"), source="bench")

        assert path.with_name("journal.db-wal").stat().st_size < 200_000


def test_journal_of_the_first_version_is_carried_over(tmp_path: Path) -> None:
    path = tmp_path / "journal.db"
    old = sqlite3.connect(path)
    for statement in schema.migrations()[0]:
        old.execute(statement)
    old.execute("PRAGMA user_version=1")
    old.execute("INSERT INTO readings VALUES (1, 'k', 'bench', 't', '{}', x'00')")
    old.execute(
        "INSERT INTO jobs VALUES (1, 'abc', 1, 'bench', 'real', 'done', NULL, '', 't')"
    )
    old.execute("INSERT INTO events VALUES (1, 't', 1, 'done', '')")
    old.commit()
    old.close()

    with Journal(path) as journal:
        job = journal.job("abc")
        assert job is not None
        journal.fail(job.id, "again")

        assert [one.kind for one in journal.events(job)] == ["done", "failed"]
        assert journal._db.one("PRAGMA foreign_key_check") is None


def test_migrations_are_numbered_without_a_gap() -> None:
    assert schema.newest_version() == len(schema.migrations()) >= 2
