"""The audit chain: every step provable, every change noticed."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from paintlink.daemon.journal import Journal
from paintlink.daemon.keeping import clear_out
from paintlink.daemon.records import Preview
from paintlink.errors import JournalError
from tests.daemon.conftest import make_reading, make_spec
from tests.daemon.test_line import Shop


@pytest.fixture
def worked(tmp_path: Path) -> Shop:
    """A shop that delivered one reading and one file to two routes."""
    shop = Shop(tmp_path / "shop", "colornet", "json")
    shop.journal.accept_reading(make_reading(), source="bench")
    shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()
    return shop


def change(shop: Shop, sql: str) -> None:
    with closing(sqlite3.connect(shop.settings.journal_path)) as connection:
        assert connection.execute(sql).rowcount > 0
        connection.commit()


def test_untouched_journal_holds_everywhere(worked: Shop) -> None:
    assert list(worked.journal.trail.faults()) == []


def test_trail_leads_from_raw_bytes_to_files(worked: Shop) -> None:
    job = worked.journal.jobs(newest_first=False)[0]

    steps = list(worked.journal.trail.of_job(job.id))

    assert [one.step for one in steps] == [
        "raw bytes", "values", "specification", "delivery", "delivery",
    ]  # fmt: skip
    assert all("sha256" in one.text for one in steps)
    assert "still there" in steps[-1].text
    kinds = [event.kind for event in worked.journal.events(job)]
    assert kinds == [
        "reading", "specified", "matched", "staged", "written", "staged", "written",
        "done",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("sql", "step", "fault"),
    [
        ("UPDATE events SET text = 'x' WHERE id = 3", "history", "was changed"),
        ("UPDATE events SET at = '2020' WHERE id = 1", "history", "was changed"),
        (
            "UPDATE events SET job_id = 3 - job_id WHERE id = 2",
            "history",
            "was changed",
        ),
        ("UPDATE events SET facts = '{}' WHERE id = 1", "history", "was changed"),
        ("DELETE FROM events WHERE id = 2", "history", "was changed"),
        ("UPDATE readings SET raw = x'01'", "raw bytes", "was changed"),
        ("UPDATE readings SET document = '{}'", "values", "was changed"),
        ("UPDATE jobs SET spec = x'3c612f3e'", "specification", "was changed"),
        ("UPDATE deliveries SET sha256 = 'ab'", "delivery", "hash differs"),
    ],
)
def test_every_edited_row_is_noticed(
    worked: Shop, sql: str, step: str, fault: str
) -> None:
    change(worked, sql)

    faults = list(worked.journal.trail.faults())

    assert step in {one.step for one in faults}
    assert any(fault in one.fault for one in faults)


def test_changed_file_is_noticed(worked: Shop) -> None:
    worked.files("json")[0].write_text("{}")

    (fault,) = worked.journal.trail.faults()

    assert "was changed after it was delivered" in fault.fault


def test_each_flipped_bit_is_noticed_or_harmless(worked: Shop, tmp_path: Path) -> None:
    """One bit in each 997 bytes of the whole journal, one after another."""
    worked.journal.close()
    data = worked.settings.journal_path.read_bytes()
    before = contents(worked.settings.journal_path)
    silent = []
    for offset in range(0, len(data), 997):
        path = tmp_path / f"{offset}" / "journal.db"
        path.parent.mkdir()
        flipped = bytearray(data)
        flipped[offset] ^= 1 << offset % 8
        path.write_bytes(flipped)
        path.with_suffix(".suspect").touch()
        if not is_noticed(path) and contents(path) != before:
            silent.append(offset)

    assert silent == []


def is_noticed(path: Path) -> bool:
    try:
        with Journal(path) as journal:
            return list(journal.trail.faults()) != []
    except JournalError:
        return True


def contents(path: Path) -> list[object]:
    """What a reader of the journal could see in what the chain vouches for."""
    with closing(sqlite3.connect(path)) as connection:
        return [
            connection.execute(sql).fetchall()
            for sql in (
                "SELECT * FROM events ORDER BY id",
                "SELECT id, raw, document FROM readings ORDER BY id",
                "SELECT id, spec FROM jobs ORDER BY id",
            )
        ]


@pytest.mark.parametrize("facts", ["{", "[1]", "7"])
def test_unreadable_facts_are_a_change_like_any_other(worked: Shop, facts: str) -> None:
    change(worked, f"UPDATE events SET facts = '{facts}' WHERE id = 3")

    first = next(worked.journal.trail.faults())

    assert (first.step, first.fault) == ("history", "was changed")


def test_removed_by_retention_is_told_apart_from_changed(worked: Shop) -> None:
    removed = worked.journal.keeping.prune("9999-01-01")

    job = worked.journal.jobs(newest_first=False)[0]
    assert removed == []
    assert list(worked.journal.trail.faults()) == []
    assert job.matches == ()
    assert "removed by retention" in next(worked.journal.trail.of_job(job.id)).text
    assert worked.journal.keeping.prune("9999-01-01") == []


def test_retention_leaves_open_jobs_alone(tmp_path: Path) -> None:
    shop = Shop(tmp_path / "shop", "colornet")
    (tmp_path / "shop" / "colornet").rmdir()
    shop.journal.accept_reading(make_reading(), source="bench")
    shop.drain()

    shop.journal.keeping.prune("9999-01-01")

    (job,) = shop.journal.jobs()
    assert job.matches != ()
    assert shop.journal.reading(1).measurement.raw == b"\x00raw"


def test_old_jobs_are_cleared_out_and_recent_ones_kept(worked: Shop) -> None:
    picture = worked.folder / "old.png"
    picture.write_bytes(b"png")
    job = worked.journal.jobs(newest_first=False)[0]
    worked.journal.request_preview(job)
    worked.journal.set_preview(Preview(job.id, "done", str(picture)))
    later = datetime.now(UTC) + timedelta(days=31)
    keeping = worked.journal.keeping

    nothing = [clear_out(keeping, days, later) for days in (0, 32)]
    kept = picture.exists()
    clear_out(keeping, 30, later)

    assert (nothing, kept, picture.exists()) == ([False, False], True, False)
    assert list(worked.journal.trail.faults()) == []
