"""The inbox at work: real files, a real journal."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from paintlink.daemon.inbox import InboxWorker
from paintlink.daemon.journal import Journal
from paintlink.intake import Inbox, InboxFolders
from paintlink.spec import write_spec
from tests.daemon.conftest import make_spec
from tests.intake.fixtures.mat12_xlsx import book, document, saved


class Counter:
    """A clock that is later at each look."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        self.now += 1.0
        return self.now


@pytest.fixture
def folders(tmp_path: Path) -> InboxFolders:
    made = InboxFolders.below(tmp_path)
    made.create()
    return made


@pytest.fixture
def worker(journal: Journal, folders: InboxFolders) -> InboxWorker:
    inbox = Inbox(folders, quiet_s=0.5, max_bytes=1 << 20, clock=Counter())
    return InboxWorker(journal, inbox)


def work(worker: InboxWorker) -> None:
    worker.step()
    while worker.step():
        pass


def test_specification_becomes_a_job(
    worker: InboxWorker, journal: Journal, folders: InboxFolders
) -> None:
    (folders.inbox / "a.xml").write_bytes(write_spec(make_spec("from a file")))

    work(worker)

    (job,) = journal.jobs()
    assert job.state == "specified"
    assert job.spec == make_spec("from a file")
    assert (folders.done / "a.xml").exists()


def test_finish_is_filled_in_where_a_file_names_none(
    journal: Journal, folders: InboxFolders
) -> None:
    inbox = Inbox(folders, quiet_s=0.5, max_bytes=1 << 20, clock=Counter())
    pearl = replace(make_spec("pearl"), finish="pearl")
    for spec in (make_spec("unnamed"), pearl):
        (folders.inbox / f"{spec.name}.xml").write_bytes(write_spec(spec))

    work(InboxWorker(journal, inbox, finish="metallic"))

    finishes = {job.spec.name: job.spec.finish for job in journal.jobs() if job.spec}
    assert finishes == {"unnamed": "metallic", "pearl": "pearl"}


def test_broken_file_is_kept_with_its_reason(
    worker: InboxWorker, journal: Journal, folders: InboxFolders
) -> None:
    (folders.inbox / "a.xml").write_bytes(b"<not a specification")

    work(worker)

    assert journal.jobs() == ()
    assert (folders.failed / "a.xml").read_bytes() == b"<not a specification"
    reason = (folders.failed / "a.xml.reason.txt").read_text()
    assert "a.xml" in reason
    assert "line 1" in reason


def test_same_content_again_is_a_duplicate(
    worker: InboxWorker, journal: Journal, folders: InboxFolders
) -> None:
    for name in ("a.xml", "b.xml"):
        (folders.inbox / name).write_bytes(write_spec(make_spec()))
        work(worker)

    assert len(journal.jobs()) == 1
    reason = (folders.duplicate / "b.xml.reason.txt").read_text()
    assert reason == "the same content was accepted before as a.xml\n"


def test_stop_between_journal_and_move_is_no_duplicate(
    worker: InboxWorker, journal: Journal, folders: InboxFolders
) -> None:
    (folders.inbox / "a.xml").write_bytes(write_spec(make_spec()))
    work(worker)
    (folders.done / "a.xml").rename(folders.working / "a.xml")

    work(worker)

    assert len(journal.jobs()) == 1
    assert (folders.done / "a.xml").exists()
    assert not list(folders.duplicate.iterdir())


def test_vendor_file_becomes_one_job_for_each_reading(
    worker: InboxWorker, journal: Journal, folders: InboxFolders
) -> None:
    (folders.inbox / "qc.xlsx").write_bytes(document())

    work(worker)

    jobs = journal.jobs()
    assert {job.spec.name for job in jobs if job.spec} == {"Basalt 7", "Basalt 8"}
    assert {job.state for job in jobs} == {"specified"}
    assert all(job.reading_id for job in jobs)
    assert (folders.done / "qc.xlsx").exists()


def test_reading_that_arrives_in_a_second_file_keeps_its_job(
    worker: InboxWorker, journal: Journal, folders: InboxFolders
) -> None:
    for names in (("Basalt 7",), ("Basalt 7", "Basalt 8")):
        (folders.inbox / "qc.xlsx").write_bytes(saved(book(names)))
        work(worker)

    assert len(journal.jobs()) == 2


def test_colour_left_out_of_a_file_is_told_beside_it(
    worker: InboxWorker, journal: Journal, folders: InboxFolders
) -> None:
    made = book(("whole", "cut"))
    made["Color Data"].delete_rows(27, 2)
    made["Spectral Data"].delete_rows(26, 2)
    (folders.inbox / "qc.xlsx").write_bytes(saved(made))

    work(worker)

    assert len(journal.jobs()) == 1
    reason = (folders.done / "qc.xlsx.reason.txt").read_text()
    assert reason.startswith("1 of 2 colours left out: cut: the reading has")


def test_file_without_a_usable_colour_fails(
    worker: InboxWorker, journal: Journal, folders: InboxFolders
) -> None:
    made = book(("cut",))
    made["Color Data"].delete_rows(15, 2)
    made["Spectral Data"].delete_rows(14, 2)
    (folders.inbox / "qc.xlsx").write_bytes(saved(made))

    work(worker)

    assert journal.jobs() == ()
    reason = (folders.failed / "qc.xlsx.reason.txt").read_text()
    assert "qc.xlsx: the reading has 10 geometries" in reason
