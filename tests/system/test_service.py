"""The service with real pseudo-terminals, folders, journal and pictures."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from paintlink.config import (
    InboxSettings,
    InstrumentSettings,
    PreviewSettings,
    RouteSettings,
    Settings,
    SiteSettings,
    StateSettings,
)
from paintlink.daemon import deliverer
from paintlink.daemon.hints import Watcher
from paintlink.daemon.journal import Journal
from paintlink.daemon.records import Job
from paintlink.daemon.service import Service
from paintlink.errors import ConfigError
from paintlink.spec import write_spec
from paintlink_simulators import PtyPort
from tests.conformance.bench import panel, simulator_module
from tests.daemon.conftest import make_spec
from tests.daemon.test_hints import Nobody, Unreliable

LIMIT_S = 30.0


def settings(folder: Path, ports: dict[str, str]) -> Settings:
    (folder / "colornet").mkdir(exist_ok=True)
    return Settings(
        site=SiteSettings(folder=folder),
        state=StateSettings(folder=folder / "state"),
        inbox=InboxSettings(folder=folder / "inbox", poll_s=0.1, quiet_s=0.2),
        instruments=tuple(
            InstrumentSettings(name=name, driver="xrite_ma", port=port, readings=1)
            for name, port in ports.items()
        ),
        routes=(
            RouteSettings(
                name="colornet",
                folder=folder / "colornet",
                format="colornet",
                accept=("real", "simulated"),
            ),
        ),
        preview=PreviewSettings(size=128, backend="cpu"),
    )


def simulator(seed: int, *, calibrated: bool = True) -> object:
    return simulator_module("xrite_ma").create(
        panel(), clock=time.monotonic, seed=seed, calibrated=calibrated
    )


def wait_for(condition: Callable[[], bool]) -> bool:
    """Whether the condition came true; looks every 50 ms, as a person would."""
    deadline = time.monotonic() + LIMIT_S
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.05)
    return True


class Running:
    """A service and a journal to look at it."""

    def __init__(self, told: Settings, **options: object) -> None:
        self.service = Service(told, **options)  # type: ignore[arg-type]
        self.service.start()
        self.journal = Journal(told.journal_path)

    def jobs(self, state: str = "done") -> list[Job]:
        return [job for job in self.journal.jobs() if job.state == state]

    def stop(self) -> None:
        self.service.stop()
        self.journal.close()


@pytest.fixture
def start() -> Iterator[Callable[..., Running]]:
    running: list[Running] = []

    def go(told: Settings, **options: object) -> Running:
        running.append(Running(told, **options))
        return running[-1]

    yield go
    for one in running:
        one.stop()


def test_two_instruments_work_side_by_side(
    tmp_path: Path, start: Callable[..., Running]
) -> None:
    with (
        PtyPort(simulator(1), auto_press_after_s=0.05) as one,
        PtyPort(simulator(2), auto_press_after_s=0.05) as two,
    ):
        told = settings(tmp_path, {"one": one.path, "two": two.path})
        running = start(told, readings=3)

        assert running.service.wait_until_read(LIMIT_S)
        assert wait_for(lambda: len(running.jobs()) == 6)

    sources = [job.source for job in running.jobs()]
    assert (sources.count("one"), sources.count("two")) == (3, 3)
    assert len(list((tmp_path / "colornet").glob("SIM-*.xml"))) == 6


def test_instrument_comes_back_after_replug(
    tmp_path: Path, start: Callable[..., Running]
) -> None:
    link = tmp_path / "by-id"
    with PtyPort(simulator(3), link=link, auto_press_after_s=0.05) as port:
        running = start(settings(tmp_path, {"bench": str(link)}))
        assert wait_for(lambda: len(running.jobs()) >= 1)

        port.unplug()
        assert wait_for(
            lambda: (
                {s.state for s in running.journal.instruments()} & {"lost", "absent"}
                != set()
            )
        )
        before = len(running.journal.jobs(limit=1000))
        port.replug()

        assert wait_for(lambda: len(running.journal.jobs(limit=1000)) > before)


def test_uncalibrated_instrument_is_calibrated_first(
    tmp_path: Path, start: Callable[..., Running]
) -> None:
    uncalibrated = simulator(4, calibrated=False)
    with PtyPort(uncalibrated, auto_press_after_s=0.05) as port:
        running = start(settings(tmp_path, {"bench": port.path}), readings=1)

        assert running.service.wait_until_read(LIMIT_S)
        assert wait_for(lambda: len(running.jobs()) == 1)


def test_dropped_file_is_delivered_and_drawn(
    tmp_path: Path, start: Callable[..., Running]
) -> None:
    running = start(settings(tmp_path, {}))
    (tmp_path / "inbox" / "a.xml").write_bytes(write_spec(make_spec()))

    assert wait_for(lambda: len(running.jobs()) == 1)
    assert wait_for(
        lambda: "done" in {p and p.state for p in [running.jobs()[0].preview]}
    )

    (job,) = running.jobs()
    assert job.preview is not None
    picture = Path(job.preview.path)
    assert picture.read_bytes().startswith(b"\x89PNG")
    words = json.loads(picture.with_suffix(".json").read_text())
    assert words["paints"][0]["name"] == "bonnet"
    assert (tmp_path / "done" / "a.xml").exists()


def test_file_in_the_preview_folder_gets_its_picture_and_no_job(
    tmp_path: Path, start: Callable[..., Running]
) -> None:
    running = start(settings(tmp_path, {}))
    folder = tmp_path / "previews"
    (folder / "a.xml").write_bytes(write_spec(make_spec()))
    (folder / "b.xml").write_text("no colour")

    assert wait_for(lambda: len(list(folder.glob("*.json"))) == 2)

    told = {path.name: json.loads(path.read_text()) for path in folder.glob("*.json")}
    assert told["a.xml.json"]["pictures"][0]["file"] == "a.xml.png"
    assert (folder / "a.xml.png").read_bytes().startswith(b"\x89PNG")
    assert "b.xml" in told["b.xml.json"]["error"]
    assert not running.journal.jobs()


def test_work_left_over_goes_on_at_next_start(
    tmp_path: Path, start: Callable[..., Running]
) -> None:
    told = settings(tmp_path, {})
    with Journal(told.journal_path) as journal:
        journal.accept_file("a.xml", "hash", make_spec())

    running = start(told, roles=("line",))

    assert wait_for(lambda: len(running.jobs()) == 1)
    assert len(list((tmp_path / "colornet").glob("*.xml"))) == 1


def test_second_service_on_the_same_state_is_refused(
    tmp_path: Path, start: Callable[..., Running]
) -> None:
    told = settings(tmp_path, {})
    start(told)

    with pytest.raises(ConfigError, match="another paintlink already runs"):
        Service(told).start()


def test_stop_ends_every_thread_quickly(
    tmp_path: Path, start: Callable[..., Running]
) -> None:
    with PtyPort(simulator(5)) as port:
        running = start(settings(tmp_path, {"bench": port.path}))
        assert wait_for(
            lambda: "ready" in {s.state for s in running.journal.instruments()}
        )

        running.service.stop()

        threads = [*running.service._workers, *running.service._instruments]
        assert not any(thread.is_alive() for thread in threads)


@pytest.mark.parametrize("watcher", [Nobody, Unreliable])
def test_files_arrive_without_trustworthy_events(
    tmp_path: Path, start: Callable[..., Running], watcher: Callable[[], Watcher]
) -> None:
    running = start(settings(tmp_path, {}), make_watcher=watcher)
    for number in range(5):
        path = tmp_path / "inbox" / f"{number}.xml"
        path.write_bytes(write_spec(make_spec(f"bonnet {number}")))

    assert wait_for(lambda: len(running.jobs()) == 5)
    assert len(list((tmp_path / "colornet").glob("*.xml"))) == 5
    assert list((tmp_path / "duplicate").glob("*.*")) == []


def test_hung_folder_delays_no_other_route(
    tmp_path: Path, start: Callable[..., Running], monkeypatch: pytest.MonkeyPatch
) -> None:
    told = settings(tmp_path, {})
    (tmp_path / "archive").mkdir()
    archive = replace(
        told.routes[0], name="archive", folder=tmp_path / "archive", format="json"
    )
    told = replace(told, routes=(*told.routes, archive))
    released, real = threading.Event(), deliverer.stage_many

    def hangs(folder: Path, *rest: object, **options: object) -> None:
        if folder.name == "colornet":
            released.wait(LIMIT_S)
        real(folder, *rest, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(deliverer, "stage_many", hangs)
    start(told)
    (tmp_path / "inbox" / "a.xml").write_bytes(write_spec(make_spec()))
    try:
        assert wait_for(lambda: len(list((tmp_path / "archive").glob("*.json"))) == 1)
        assert list((tmp_path / "colornet").glob("*.xml")) == []
    finally:
        released.set()
    assert wait_for(lambda: len(list((tmp_path / "colornet").glob("*.xml"))) == 1)
