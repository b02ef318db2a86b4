"""Copies of the journal: whole, checked, and never a reason to send twice."""

from __future__ import annotations

from pathlib import Path

import pytest

from paintlink.daemon.backup import back_up, restore
from paintlink.daemon.journal import Journal
from paintlink.errors import ConfigError, JournalError
from tests.daemon.conftest import make_reading, make_spec
from tests.daemon.test_line import Shop


@pytest.fixture
def shop(tmp_path: Path) -> Shop:
    shop = Shop(tmp_path / "shop", "colornet", "json")
    shop.journal.accept_reading(make_reading(), source="bench")
    return shop


def test_backup_of_a_running_journal_is_whole(shop: Shop, tmp_path: Path) -> None:
    back_up(shop.journal, tmp_path / "copy.db")
    shop.drain()

    with Journal(tmp_path / "copy.db") as copy:
        assert [job.state for job in copy.jobs()] == ["received"]
        assert list(copy.trail.faults()) == []
    assert not list(tmp_path.glob("*.part"))


def test_backup_never_replaces_another(shop: Shop, tmp_path: Path) -> None:
    (tmp_path / "copy.db").write_text("precious")

    with pytest.raises(JournalError, match="exists: name a new file"):
        back_up(shop.journal, tmp_path / "copy.db")


def test_restored_journal_sends_nothing_twice(shop: Shop, tmp_path: Path) -> None:
    shop.line.step()
    back_up(shop.journal, tmp_path / "copy.db")
    shop.drain()
    for path in shop.files("colornet"):
        path.unlink()
    shop.journal.close()

    aside = restore(tmp_path / "copy.db", shop.settings.journal_path)
    shop.journal = Journal(shop.settings.journal_path)
    shop.line = shop.new_line()
    shop.drain()

    (job,) = shop.journal.jobs()
    assert {one.state for one in job.deliveries} == {"unknown"}
    assert "look whether it arrived" in job.deliveries[0].error
    assert shop.files("colornet") == []
    assert aside is not None
    with Journal(aside / "journal.db") as replaced:
        assert {one.state for one in replaced.jobs()[0].deliveries} == {"written"}


def test_restore_waits_for_nobody(shop: Shop, tmp_path: Path) -> None:
    back_up(shop.journal, tmp_path / "copy.db")

    with pytest.raises(ConfigError, match="is in use: stop paintlink first"):
        restore(tmp_path / "copy.db", shop.settings.journal_path)


def test_damaged_or_foreign_backup_is_refused(shop: Shop, tmp_path: Path) -> None:
    back_up(shop.journal, tmp_path / "copy.db")
    shop.journal.close()
    data = bytearray((tmp_path / "copy.db").read_bytes())
    data[4096 * 2 : 4096 * 3] = bytes(4096)
    (tmp_path / "copy.db").write_bytes(data)
    (tmp_path / "text.db").write_text("no journal " * 50)
    before = shop.settings.journal_path.read_bytes()

    with pytest.raises(JournalError, match=r"is damaged .*another backup"):
        restore(tmp_path / "copy.db", shop.settings.journal_path)
    with pytest.raises(JournalError, match="another backup"):
        restore(tmp_path / "text.db", shop.settings.journal_path)

    assert shop.settings.journal_path.read_bytes() == before


def test_restore_brings_back_a_damaged_journal(shop: Shop, tmp_path: Path) -> None:
    back_up(shop.journal, tmp_path / "copy.db")
    shop.journal.close()
    shop.settings.journal_path.write_bytes(b"gone " * 1000)
    with pytest.raises(JournalError, match="paintlink restore FILE"):
        Journal(shop.settings.journal_path)

    restore(tmp_path / "copy.db", shop.settings.journal_path)

    with Journal(shop.settings.journal_path) as journal:
        assert len(journal.jobs()) == 1


def test_restore_into_an_empty_place_sets_nothing_aside(tmp_path: Path) -> None:
    with Journal(tmp_path / "a.db") as journal:
        journal.accept_file("a.xml", "hash", make_spec())
        back_up(journal, tmp_path / "b.db")

    assert restore(tmp_path / "b.db", tmp_path / "new" / "journal.db") is None
