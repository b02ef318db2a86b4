"""The journal against a real SQLite file."""

from __future__ import annotations

import sqlite3
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from paintlink.daemon.arrivals import reading_key
from paintlink.daemon.journal import Journal
from paintlink.daemon.records import InstrumentStatus, Job, Preview
from paintlink.errors import JournalError
from paintlink.model import AngleDifference, Match
from tests.daemon.conftest import NOON, make_reading, make_spec

MATCH = Match(
    rank=1,
    paint_id=7,
    code="RM209",
    name="Ruby",
    finish="metallic",
    total=3.25,
    differences=(AngleDifference(15.0, 3.25, 1.0, 2.0, 0.1, 0.2, 0.3),),
    words="face 1.0 lighter",
    formula="cie76",
    angles_deg=(15.0,),
    observer="10",
    library="stand-in",
    generation="abc",
)


def matched_job(journal: Journal, routes: tuple[str, ...] = ("colornet",)) -> Job:
    token = journal.accept_file("a.xml", "hash", make_spec())
    job = the_job(journal, token)
    folders = [(route, f"/routes/{route}") for route in routes]
    journal.set_matched(job, make_spec(), [MATCH], folders)
    return the_job(journal, token)


def the_job(journal: Journal, token: str) -> Job:
    job = journal.job(token)
    assert job is not None
    return job


def test_reading_comes_back_bit_for_bit(journal: Journal) -> None:
    reading = make_reading(raw=bytes(range(256)))

    token = journal.accept_reading(reading, source="bench")

    job = the_job(journal, token)
    assert job.reading_id is not None
    back = journal.reading(job.reading_id)
    assert back.measurement.raw == reading.measurement.raw
    assert back.measurement.spectra is not None
    assert reading.measurement.spectra is not None
    np.testing.assert_array_equal(
        back.measurement.spectra.factors, reading.measurement.spectra.factors
    )
    assert back.measurement.geometries == reading.measurement.geometries
    assert back.measurement.gloss == reading.measurement.gloss
    assert back.measurement.texture == reading.measurement.texture
    assert (back.instrument, back.taken_at, back.calibration, back.sample) == (
        reading.instrument,
        reading.taken_at,
        reading.calibration,
        reading.sample,
    )


def test_same_reading_twice_is_one_job(journal: Journal) -> None:
    first = journal.accept_reading(make_reading(), source="bench")

    second = journal.accept_reading(make_reading(), source="bench")

    assert first == second
    assert len(journal.jobs()) == 1


def test_equal_values_at_another_time_are_new(journal: Journal) -> None:
    reading = make_reading()
    later = replace(reading, taken_at=NOON.replace(second=1))

    tokens = {journal.accept_reading(one, source="bench") for one in (reading, later)}

    assert len(tokens) == 2
    assert reading_key(reading) != reading_key(later)


def test_stored_reading_outlives_the_connection(tmp_path: Path) -> None:
    path = tmp_path / "journal.db"
    with Journal(path) as journal:
        token = journal.accept_reading(make_reading(), source="bench")

    with Journal(path) as again:
        assert the_job(again, token).state == "received"


def test_journal_syncs_each_commit_to_disk(journal: Journal) -> None:
    modes = {
        name: journal._db.one(f"PRAGMA {name}")[0]  # type: ignore[index]
        for name in ("journal_mode", "synchronous", "foreign_keys")
    }

    assert modes == {"journal_mode": "wal", "synchronous": 2, "foreign_keys": 1}


def test_oldest_waiting_job_comes_first(journal: Journal) -> None:
    first = journal.accept_file("a.xml", "1", make_spec("a"))
    journal.accept_file("b.xml", "2", make_spec("b"))

    waiting = journal.waiting("specified")

    assert waiting is not None
    assert waiting.token == first


def test_matches_and_deliveries_come_back(journal: Journal) -> None:
    job = matched_job(journal, ("colornet", "archive"))

    assert job.state == "matched"
    assert job.matches == (MATCH,)
    assert [one.route for one in job.deliveries] == ["colornet", "archive"]
    assert {one.state for one in job.deliveries} == {"pending"}


def test_matching_again_opens_no_second_delivery(journal: Journal) -> None:
    job = matched_job(journal)

    journal.set_matched(job, make_spec(), [MATCH], [("colornet", "/routes/colornet")])

    again = the_job(journal, job.token)
    assert len(again.deliveries) == 1
    assert len(again.matches) == 1


def test_interrupted_delivery_comes_before_new_ones(journal: Journal) -> None:
    matched_job(journal, ("a", "b"))
    first = journal.deliveries.due(0.0)
    assert first is not None
    journal.deliveries.set_publishing(first, "job.xml", "digest")

    due = journal.deliveries.due(0.0)

    assert due is not None
    assert (due.id, due.state, due.name) == (first.id, "publishing", "job.xml")


def test_postponed_delivery_keeps_state_and_waits(journal: Journal) -> None:
    matched_job(journal)
    delivery = journal.deliveries.due(0.0)
    assert delivery is not None
    staged = journal.deliveries.set_publishing(delivery, "job.xml", "digest")

    journal.deliveries.postpone(staged, 100.0, "the folder is full")

    assert journal.deliveries.due(99.0) is None
    due = journal.deliveries.due(100.0)
    assert due is not None
    assert (due.state, due.attempts, due.error) == (
        "publishing",
        1,
        "the folder is full",
    )
    assert journal.deliveries.next_retry_s() == 100.0


def test_nothing_is_staged_beside_an_unsettled_delivery(journal: Journal) -> None:
    journal.accept_file("a.xml", "1", make_spec("a"))
    journal.accept_file("b.xml", "2", make_spec("b"))
    for folder in ("/same", "/same"):
        job = journal.waiting("specified")
        assert job is not None
        journal.set_matched(job, make_spec(), [MATCH], [("colornet", folder)])
    first = journal.deliveries.due(0.0)
    assert first is not None
    staged = journal.deliveries.set_publishing(first, "job.xml", "digest")
    journal.deliveries.postpone(staged, 100.0, "the share is away")

    blocked = journal.deliveries.due(50.0)
    journal.deliveries.settle(staged, "written", "job.xml")
    freed = journal.deliveries.due(50.0)

    assert blocked is None
    assert freed is not None
    assert freed.id != first.id


def test_written_delivery_is_no_longer_due(journal: Journal) -> None:
    job = matched_job(journal)
    delivery = journal.deliveries.due(0.0)
    assert delivery is not None

    journal.deliveries.settle(delivery, "written", "job.xml")

    assert journal.deliveries.due(1e12) is None
    assert the_job(journal, job.token).state == "done"
    assert [one.id for one in journal.deliveries.lying()] == [delivery.id]


def test_resend_adds_a_numbered_copy(journal: Journal) -> None:
    job = matched_job(journal)
    journal.finish(job, "every route served")

    journal.resend(the_job(journal, job.token), "colornet")

    again = the_job(journal, job.token)
    assert [one.copy for one in again.deliveries] == [1, 2]
    assert again.state == "matched"


def test_resend_to_unknown_route_is_refused(journal: Journal) -> None:
    job = matched_job(journal)

    with pytest.raises(JournalError, match="has no delivery for the route nowhere"):
        journal.resend(job, "nowhere")


def test_retry_brings_failed_job_back(journal: Journal) -> None:
    token = journal.accept_reading(make_reading(), source="bench")
    journal.fail(the_job(journal, token).id, "no 45 degree illumination")

    journal.retry(the_job(journal, token))

    job = the_job(journal, token)
    assert (job.state, job.error) == ("received", "")


def test_history_tells_everything_in_order(journal: Journal) -> None:
    job = matched_job(journal)
    journal.fail(job.id, "broken")

    kinds = [event.kind for event in journal.events(job)]

    assert kinds == ["file", "matched", "failed"]


def test_preview_is_requested_once_and_kept(journal: Journal) -> None:
    job = matched_job(journal)
    journal.request_preview(job)
    journal.request_preview(job)

    waiting = journal.waiting_preview()
    assert waiting is not None
    journal.set_preview(Preview(job.id, "done", "/p.png", "cpu"))

    assert waiting.id == job.id
    assert journal.waiting_preview() is None
    assert the_job(journal, job.token).preview == Preview(
        job.id, "done", "/p.png", "cpu"
    )


def test_instrument_state_is_seen_by_others(journal: Journal) -> None:
    journal.set_instrument(InstrumentStatus("bench", "opening", "opening the port"))
    journal.set_instrument(InstrumentStatus("bench", "ready", "press", "X-Rite MA68"))

    with Journal(journal.path) as other:
        statuses = other.instruments()

    assert [(one.state, one.identity) for one in statuses] == [("ready", "X-Rite MA68")]


@pytest.mark.parametrize("token", ["", "%", "_", "zzzzzz"])
def test_token_that_names_no_job_finds_none(journal: Journal, token: str) -> None:
    matched_job(journal)

    assert journal.job(token) is None


def test_unmistakable_beginning_of_token_finds_job(journal: Journal) -> None:
    job = matched_job(journal)

    found = journal.job(job.token[:4])

    assert found is not None
    assert found.token == job.token


def test_failed_transaction_leaves_nothing_behind(journal: Journal) -> None:
    journal.accept_file("a.xml", "same hash", make_spec())

    with pytest.raises(sqlite3.IntegrityError):  # a bug, and not the disk's fault
        journal.accept_file("b.xml", "same hash", make_spec())

    assert len(journal.jobs()) == 1


def test_newer_journal_is_refused_by_name(tmp_path: Path) -> None:
    path = tmp_path / "journal.db"
    Journal(path).close()
    with sqlite3.connect(path) as connection:
        connection.execute("PRAGMA user_version=99")
    connection.close()

    with pytest.raises(JournalError, match=r"newer paintlink \(version 99"):
        Journal(path)


def test_file_that_is_no_journal_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "journal.db"
    path.write_bytes(b"this is not SQLite " * 100)

    with pytest.raises(JournalError, match=r"is damaged .* a copy is kept in"):
        Journal(path)


def test_folder_that_cannot_be_made_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")

    with pytest.raises(JournalError, match="cannot open the journal"):
        Journal(tmp_path / "file" / "journal.db")


def test_state_of_an_instrument_costs_no_sync_and_readings_still_do(
    journal: Journal,
) -> None:
    journal.set_instrument(InstrumentStatus("bench", "ready", "press"))

    assert journal.instruments()[0].text == "press"
    assert journal._db.one("PRAGMA synchronous")[0] == 2  # type: ignore[index]
