"""One reading by hand, through the same journal and line as the service."""

from __future__ import annotations

import time
from collections.abc import Callable

from paintlink.config import Settings
from paintlink.daemon.journal import Journal
from paintlink.daemon.line import Line
from paintlink.daemon.paints import known_paints
from paintlink.daemon.records import Job
from paintlink.daemon.render import Render
from paintlink.daemon.roles import RoleLocks
from paintlink.errors import ConfigError, JournalError
from paintlink.export import load_formats
from paintlink.model import Reading

SERVICE_LIMIT_S = 30.0
LOOK_EVERY_S = 0.1


def process(settings: Settings, reading: Reading, source: str) -> Job:
    """The job of a reading, worked on here or by the service that runs already.

    The reading is stored first; whatever happens later, it is not lost.
    """
    with Journal(settings.journal_path) as journal:
        token = journal.accept_reading(reading, source=source)
        try:
            locks = RoleLocks(settings.state_folder, ("line", "render"))
        except ConfigError:
            return _wait_for_service(journal, token)
        try:
            render = Render(journal, settings.preview, settings.previews_folder)
            _run(_line(journal, settings))
            _run(render)
        finally:
            locks.release()
        return _job(journal, token)


def work_off(
    settings: Settings, journal: Journal, on_step: Callable[[], None] = lambda: None
) -> bool:
    """Take everything down the line that waits; False when a service does that.

    Pictures are left to the service: there may be thousands.

    Parameters
    ----------
    on_step
        Called after each step of the line.
    """
    try:
        locks = RoleLocks(settings.state_folder, ("line",))
    except ConfigError:
        return False
    line = _line(journal, settings)
    try:
        while line.step():
            on_step()
    finally:
        locks.release()
    return True


def _line(journal: Journal, settings: Settings) -> Line:
    return Line(
        journal,
        settings,
        table=known_paints(settings),
        formats=load_formats(settings.formats_folder),
        clock=time.time,
    )


def _run(worker: Line | Render) -> None:
    while worker.step():
        pass


def _wait_for_service(journal: Journal, token: str) -> Job:
    deadline = time.monotonic() + SERVICE_LIMIT_S
    while time.monotonic() < deadline:
        job = _job(journal, token)
        if job.state in {"done", "failed"}:
            return job
        time.sleep(LOOK_EVERY_S)
    return _job(journal, token)


def _job(journal: Journal, token: str) -> Job:
    job = journal.job(token)
    if job is None:
        msg = f"the journal lost job {token}: run `paintlink jobs list`"
        raise JournalError(msg)
    return job
