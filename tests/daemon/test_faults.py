"""A fault of the program on one thing must not stop what waits behind it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from paintlink.config import PreviewSettings
from paintlink.daemon import deliverer, inbox, line, render
from paintlink.daemon.faults import Batch
from paintlink.daemon.inbox import InboxWorker
from paintlink.daemon.journal import Journal
from paintlink.daemon.render import Render
from paintlink.errors import JournalError
from paintlink.intake import Inbox, InboxFolders
from paintlink.spec import write_spec
from tests.daemon.conftest import make_spec
from tests.daemon.test_line import Shop

NAMES = [f"panel {number}" for number in range(5)]
BAD = "panel 1"
REPORTED = r"a fault of the program (ZeroDivisionError: of one; test_faults.py line "


def faulty(real: Callable[..., Any], is_bad: Callable[..., bool]) -> Callable[..., Any]:
    """The real function, with a bug that some arguments meet."""

    def wrapped(*args: Any, **options: Any) -> Any:
        if is_bad(*args):
            raise ZeroDivisionError("of one")
        return real(*args, **options)

    return wrapped


def names_bad(spec: Any, *_rest: Any) -> bool:
    return bool(spec.name == BAD)


@pytest.fixture
def shop(tmp_path: Path) -> Iterator[Shop]:
    opened = Shop(tmp_path, "json")
    for name in NAMES:
        opened.journal.accept_file(f"{name}.xml", name, make_spec(name))
    yield opened
    opened.journal.close()


def states(shop: Shop) -> dict[str, str]:
    return {
        job.source.removesuffix(".xml"): job.deliveries[0].state
        if job.deliveries
        else job.state
        for job in shop.journal.jobs()
    }


def all_but_bad(good: str, bad: str) -> dict[str, str]:
    return dict.fromkeys(NAMES, good) | {BAD: bad}


def test_fault_on_one_job_is_kept_and_the_line_goes_on(
    shop: Shop, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    with monkeypatch.context() as broken:
        broken.setattr(line, "match", faulty(line.match, names_bad))
        shop.drain()
    after = states(shop)
    (failed,) = shop.journal.jobs(state="failed")
    events = [(event.kind, event.text) for event in shop.journal.events(failed)]

    shop.journal.retry(failed)
    shop.drain()

    assert after == all_but_bad("written", "failed")
    assert failed.error.startswith(REPORTED)
    assert "`paintlink jobs retry` tries it again" in failed.error
    assert events[-1] == ("failed", failed.error)
    assert "Traceback" in caplog.text
    assert states(shop) == dict.fromkeys(NAMES, "written")
    assert len(shop.files("json")) == 5


def test_fault_in_storing_leaves_the_others_stored(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = shop.journal.set_matched
    bad = faulty(real, lambda job, *_: bool(job.spec.name == BAD))
    monkeypatch.setattr(shop.journal, "set_matched", bad)

    shop.drain()

    assert states(shop) == all_but_bad("written", "failed")
    assert list(shop.journal.trail.faults()) == []


def test_stored_job_that_cannot_be_read_stops_itself_only(shop: Shop) -> None:
    with shop.journal.transaction():
        shop.journal._db.run(
            "UPDATE jobs SET spec = ? WHERE source = ?", b"<no", f"{BAD}.xml"
        )

    shop.drain()

    assert shop.journal.counts() == {"done": 4, "failed": 1}


def test_fault_in_rendering_fails_one_delivery(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as broken:
        broken.setattr(deliverer, "render", faulty(deliverer.render, names_bad))
        shop.drain()
    after = states(shop)
    (bad,) = [job for job in shop.journal.jobs() if job.source == f"{BAD}.xml"]

    shop.journal.retry(bad)
    shop.drain()

    assert after == all_but_bad("written", "failed")
    assert bad.deliveries[0].error.startswith(REPORTED)
    assert states(shop) == dict.fromkeys(NAMES, "written")
    assert len(shop.files("json")) == 5


def test_fault_after_staging_never_writes_twice(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    def after_publishing(*args: Any) -> Any:
        real(*args)
        raise ZeroDivisionError("of one")

    real = deliverer.publish_many
    with monkeypatch.context() as broken:
        broken.setattr(deliverer, "publish_many", after_publishing)
        shop.drain()
    for path in shop.files("json"):
        path.unlink()

    shop.drain()

    assert states(shop) == dict.fromkeys(NAMES, "written")
    assert shop.files("json") == []


def test_fault_in_publishing_asks_a_person(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    always = faulty(deliverer.publish_many, lambda *_: True)
    bad = faulty(deliverer.publish, lambda _folder, token, _n: token.endswith("-2"))
    monkeypatch.setattr(deliverer, "publish_many", always)
    monkeypatch.setattr(deliverer, "publish", bad)

    shop.drain()

    (job,) = [job for job in shop.journal.jobs() if job.source == f"{BAD}.xml"]
    assert states(shop) == all_but_bad("written", "unknown")
    assert "look whether" in job.deliveries[0].error
    assert len(shop.files("json")) == 4


def test_fault_in_drawing_fails_one_picture(
    shop: Shop, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for job in shop.journal.jobs():
        shop.journal.request_preview(job)
    bad = faulty(render.render, lambda specs, **_: bool(specs[0].name == BAD))
    pictures = Render(
        shop.journal, PreviewSettings(size=64, backend="cpu"), tmp_path / "previews"
    )
    with monkeypatch.context() as broken:
        broken.setattr(render, "render", bad)
        while pictures.step():
            pass
    drawn = {job.source: job.preview for job in shop.journal.jobs()}

    (failed,) = [job for job in shop.journal.jobs() if job.source == f"{BAD}.xml"]
    shop.journal.retry(failed)
    again = shop.journal.waiting_preview()

    assert sorted(one.state for one in drawn.values() if one) == ["done"] * 4 + [
        "failed"
    ]
    assert failed.preview is not None
    assert failed.preview.note.startswith(REPORTED)
    assert again is not None
    assert again.id == failed.id


def test_fault_on_one_file_leaves_the_inbox_working(
    journal: Journal, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folders = InboxFolders.below(tmp_path)
    folders.create()
    for name in NAMES:
        (folders.inbox / f"{name}.xml").write_bytes(write_spec(make_spec(name)))
    now = iter(range(100))
    worker = InboxWorker(
        journal, Inbox(folders, quiet_s=0.5, max_bytes=9999, clock=lambda: next(now))
    )
    worker.step()  # each file has now been seen once
    bad = faulty(inbox.read_any, lambda data, **_: BAD.encode() in data)
    monkeypatch.setattr(inbox, "read_any", bad)

    while worker.step():
        pass

    assert len(journal.jobs()) == 4
    assert [path.name for path in folders.failed.glob("*.xml")] == [f"{BAD}.xml"]
    reason = (folders.failed / f"{BAD}.xml.reason.txt").read_text()
    assert reason.startswith(REPORTED)


def test_journal_that_cannot_be_trusted_is_no_fault_of_a_job(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_args: Any, **_options: Any) -> None:
        raise JournalError("disk I/O error")

    monkeypatch.setattr(shop.journal, "set_matched", refuse)

    with pytest.raises(JournalError, match="disk I/O error"):
        shop.drain()
    assert shop.journal.counts() == {"specified": 5}


def test_batch_is_taken_singly_after_a_fault_and_then_together_again() -> None:
    batch, blamed, sizes = Batch(8), list[str](), list[int]()
    for taken in ([1, 2, 3], [1], [2], [3], [4, 5]):
        with batch.tried(taken, "test", blamed.append):
            if 2 in taken:
                raise KeyError("two")
        sizes.append(batch.size)

    assert sizes == [1, 1, 1, 8, 8]
    assert len(blamed) == 1
    assert "KeyError: 'two'" in blamed[0]
