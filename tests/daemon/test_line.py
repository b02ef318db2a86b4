"""The line over a real journal, the bundled library and real folders."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import pytest

from paintlink.config import (
    InboxSettings,
    PreviewSettings,
    RouteSettings,
    Settings,
    SiteSettings,
    StateSettings,
)
from paintlink.daemon import deliverer
from paintlink.daemon.deliverer import Deliverer, staged_name
from paintlink.daemon.journal import Journal
from paintlink.daemon.line import Line
from paintlink.daemon.records import Job
from paintlink.export import load_formats, outcome, publish, stage
from paintlink.library import bundled
from paintlink.model import ColorSpec, Geometry, Lab, Sample
from tests.daemon.conftest import make_reading, make_spec


class Shop:
    def __init__(
        self, folder: Path, *formats: str, accept: tuple[str, ...] = ("real",)
    ):
        self.now = 1000.0
        self.folder = folder
        for name in formats:
            (folder / name).mkdir(parents=True)
        self.settings = Settings(
            site=SiteSettings(folder=folder),
            state=StateSettings(folder=folder / "state"),
            inbox=InboxSettings(folder=folder / "inbox"),
            routes=tuple(
                RouteSettings(
                    name=name,
                    folder=folder / name,
                    format=name,
                    accept=accept,  # type: ignore[arg-type]
                )
                for name in formats
            ),
            preview=PreviewSettings(enabled=False),
        )
        self.journal = Journal(self.settings.journal_path)
        self.line = self.new_line()

    def new_line(self) -> Line:
        return Line(
            self.journal,
            self.settings,
            table=bundled(),
            formats=load_formats(),
            clock=lambda: self.now,
        )

    def drain(self) -> None:
        while self.line.step():
            pass

    def job(self, token: str) -> Job:
        job = self.journal.job(token)
        assert job is not None
        return job

    def files(self, route: str) -> list[Path]:
        return sorted(p for p in (self.folder / route).iterdir() if p.is_file())


def token_of(shop: Shop, job_token: str) -> str:
    """Name of the staged file of a job's first delivery."""
    job = shop.job(job_token)
    return staged_name(job, job.deliveries[0])


@pytest.fixture
def shop(tmp_path: Path) -> Iterator[Shop]:
    opened = Shop(tmp_path, "colornet", "json")
    yield opened
    opened.journal.close()


def test_reading_reaches_every_route(shop: Shop) -> None:
    token = shop.journal.accept_reading(make_reading(), source="bench")

    shop.drain()

    job = shop.job(token)
    assert job.state == "done"
    assert {one.state for one in job.deliveries} == {"written"}
    document = json.loads(shop.files("json")[0].read_text())
    assert job.spec is not None
    assert job.spec.starting_paint is not None
    assert job.spec.starting_paint.code == job.matches[0].code
    assert job.matches[0].code in json.dumps(document)
    assert job.matches[0].code in shop.files("colornet")[0].read_text()


def test_nothing_is_delivered_again_by_a_new_line(shop: Shop) -> None:
    shop.journal.accept_reading(make_reading(), source="bench")
    shop.drain()
    for path in shop.files("colornet"):
        path.unlink()

    shop.line = shop.new_line()
    shop.drain()

    assert shop.files("colornet") == []


def test_unusable_reading_fails_with_its_reason(shop: Shop) -> None:
    reading = make_reading()
    geometries = tuple(Geometry(a, 15.0) for a in (15, 25, 45, 75, 110))
    broken = replace(
        reading, measurement=replace(reading.measurement, geometries=geometries)
    )
    token = shop.journal.accept_reading(broken, source="bench")

    shop.drain()

    job = shop.job(token)
    assert job.state == "failed"
    assert "45" in job.error
    assert job.reading_id is not None
    assert shop.journal.reading(job.reading_id).measurement.raw == b"\x00raw"


def test_specification_without_common_angles_fails_by_name(shop: Shop) -> None:
    labs = {-40.0: (60, 0, 0), -30.0: (50, 0, 0), -20.0: (40, 0, 0)}
    spec = ColorSpec("odd", tuple(Sample(a, Lab(*lab)) for a, lab in labs.items()))
    token = shop.journal.accept_file("odd.xml", "hash", spec)

    shop.drain()

    assert shop.job(token).state == "failed"
    assert "-40/-30/-20" in shop.job(token).error


def test_missing_folder_is_retried_until_it_is_back(shop: Shop) -> None:
    shutil.rmtree(shop.folder / "colornet")
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()
    waiting = shop.job(token)

    (shop.folder / "colornet").mkdir()
    shop.drain()
    too_early = shop.files("colornet")
    shop.now += 1.0
    shop.drain()

    assert waiting.state == "matched"
    assert {d.route: d.state for d in waiting.deliveries} == {
        "colornet": "pending",
        "json": "written",
    }
    assert "create it" in waiting.deliveries[0].error
    assert too_early == []
    assert len(shop.files("colornet")) == 1
    assert shop.job(token).state == "done"


def test_interrupted_before_rename_is_published_once(shop: Shop) -> None:
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.line.step()
    delivery = shop.journal.deliveries.due(shop.now)
    assert delivery is not None
    stage(Path(delivery.folder), token_of(shop, token), b"<job/>")
    shop.journal.deliveries.set_publishing(delivery, "job.xml", "digest")

    shop.line = shop.new_line()
    shop.drain()

    assert shop.job(token).state == "done"
    assert (shop.folder / "colornet" / "job.xml").read_bytes() == b"<job/>"


def test_interrupted_after_rename_is_never_written_again(shop: Shop) -> None:
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.line.step()
    delivery = shop.journal.deliveries.due(shop.now)
    assert delivery is not None
    folder = Path(delivery.folder)
    stage(folder, token_of(shop, token), b"<job/>")
    shop.journal.deliveries.set_publishing(delivery, "job.xml", "digest")
    publish(folder, token_of(shop, token), "job.xml").unlink()

    shop.line = shop.new_line()
    shop.drain()

    assert outcome(folder, token_of(shop, token)) == "published"
    assert shop.files("colornet") == []
    assert shop.job(token).state == "done"


def test_lost_staging_folder_asks_a_person(shop: Shop) -> None:
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.line.step()
    delivery = shop.journal.deliveries.due(shop.now)
    assert delivery is not None
    stage(Path(delivery.folder), token_of(shop, token), b"<job/>")
    shop.journal.deliveries.set_publishing(delivery, "job.xml", "digest")
    shutil.rmtree(Path(delivery.folder) / ".paintlink")

    shop.drain()

    states = {one.route: one for one in shop.job(token).deliveries}
    assert states["colornet"].state == "unknown"
    assert "look whether job.xml arrived" in states["colornet"].error
    assert shop.files("colornet") == []


def test_name_that_is_taken_asks_a_person(shop: Shop) -> None:
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()
    name = shop.files("colornet")[0].name
    again = shop.journal.accept_file("b.xml", "other", make_spec())
    shop.line.step()
    delivery = shop.journal.deliveries.due(shop.now)
    assert delivery is not None
    stage(Path(delivery.folder), token_of(shop, again), b"<other/>")
    shop.journal.deliveries.set_publishing(delivery, name, "digest")

    shop.drain()

    states = {one.route: one for one in shop.job(again).deliveries}
    assert states["colornet"].state == "failed"
    assert name in states["colornet"].error
    assert b"<other/>" not in shop.files("colornet")[0].read_bytes()
    assert outcome(Path(delivery.folder), token_of(shop, again)) == "published"
    assert shop.job(token).state == "done"


def test_failed_delivery_can_be_retried(shop: Shop) -> None:
    site = replace(shop.settings.routes[0], format="nosuch")
    good = shop.settings
    shop.settings = replace(good, routes=(site,))
    shop.line = shop.new_line()
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()
    failed = shop.job(token).deliveries[0]

    shop.settings = good
    shop.line = shop.new_line()
    shop.journal.retry(shop.job(token))
    shop.drain()

    assert failed.state == "failed"
    assert "no export format" in failed.error
    assert shop.job(token).deliveries[0].state == "written"


def test_taken_file_is_noticed(shop: Shop) -> None:
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()
    shop.files("colornet")[0].unlink()

    shop.line.look_at_folders()

    states = {one.route: one.state for one in shop.job(token).deliveries}
    assert states == {"colornet": "taken", "json": "written"}


def test_file_that_lies_too_long_raises_an_alarm(shop: Shop) -> None:
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()
    written = datetime.fromisoformat(shop.job(token).deliveries[0].written_at)
    shop.now = written.timestamp() + 15 * 60 - 5.0
    shop.line.look_at_folders()
    before = {one.state for one in shop.job(token).deliveries}

    shop.now += 10.0
    shop.line.look_at_folders()
    alarmed = shop.job(token).deliveries
    shop.files("colornet")[0].unlink()
    shop.line.look_at_folders()

    assert before == {"written"}
    assert {one.state for one in alarmed} == {"stale"}
    assert "is the other program running?" in alarmed[0].error
    states = {one.route: one for one in shop.job(token).deliveries}
    assert (states["colornet"].state, states["colornet"].error) == ("taken", "")


def test_vanished_folder_does_not_count_as_taken(shop: Shop) -> None:
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()
    shutil.rmtree(shop.folder / "colornet")

    shop.line.look_at_folders()

    assert {one.state for one in shop.job(token).deliveries} == {"written"}


def test_folder_of_another_route_is_never_looked_at(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()
    looked: list[str] = []
    monkeypatch.setattr(
        deliverer, "_changed_at", lambda route: looked.append(route.name)
    )
    only = Deliverer(
        shop.journal,
        shop.settings.routes,
        load_formats(),
        clock=lambda: shop.now,
        only="json",
    )

    only.look_at_folders()

    assert looked == ["json"]


def test_resend_writes_under_another_name(shop: Shop) -> None:
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.drain()

    shop.journal.resend(shop.job(token), "json")
    shop.drain()

    names = {path.name for path in shop.files("json")}
    assert len(names) == 2
    assert shop.job(token).state == "done"


def test_route_taken_out_of_the_configuration_waits(shop: Shop) -> None:
    token = shop.journal.accept_file("a.xml", "hash", make_spec())
    shop.line.step()
    shop.settings = replace(shop.settings, routes=shop.settings.routes[1:])

    shop.line = shop.new_line()
    shop.drain()

    states = {one.route: one for one in shop.job(token).deliveries}
    assert states["colornet"].state == "pending"
    assert "no longer in the configuration" in states["colornet"].error


def test_simulated_reading_is_kept_but_sent_nowhere(shop: Shop) -> None:
    token = shop.journal.accept_reading(
        make_reading(origin="simulated"), source="bench"
    )

    shop.drain()

    job = shop.job(token)
    assert (job.state, job.deliveries) == ("done", ())
    kinds = [event.text for event in shop.journal.events(job)]
    assert "no route accepts simulated readings" in kinds
    assert shop.files("colornet") == []
