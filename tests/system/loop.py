"""The formulation loop with everything real but the paint and the instrument.

Journal, line, folders and files are the product's; the formulation software is the
stand-in, which sees nothing but the files and knows the bundled paints; panels come
from a virtual booth.
"""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from paintlink.config import (
    FormulationSettings,
    InboxSettings,
    PreviewSettings,
    RouteSettings,
    Settings,
    SiteSettings,
    StateSettings,
)
from paintlink.daemon.formulation import AnswerWorker, Booth
from paintlink.daemon.journal import Journal
from paintlink.daemon.line import Line
from paintlink.daemon.records import Job
from paintlink.export import load_formats
from paintlink.intake import Inbox, InboxFolders
from paintlink.library import bundled
from paintlink.model import (
    Geometry,
    Instrument,
    Measurement,
    Reading,
    Spectra,
)
from paintlink_simulators.colornet import BundledBook, Watch
from paintlink_simulators.paint import Panel, Repeatability, SprayBooth, noisy
from tests.simulators.colornet.panels import ANGLES

NOON = datetime(2026, 11, 25, 12, 0, tzinfo=UTC)


class LoopShop:
    """A shop with formulation software and a booth, whose clock the test moves."""

    def __init__(
        self,
        folder: Path,
        booth: SprayBooth,
        rules: FormulationSettings,
    ) -> None:
        self.folder = folder
        for name in ("colornet", "taken", "answers"):
            (folder / name).mkdir(parents=True)
        self.now_s = 0.0
        self.booth = booth
        self.settings = Settings(
            site=SiteSettings(folder=folder),
            state=StateSettings(folder=folder / "state"),
            inbox=InboxSettings(folder=folder / "inbox"),
            routes=(
                RouteSettings(
                    name="colornet",
                    folder=folder / "colornet",
                    format="colornet",
                    accept=("real", "simulated"),
                ),
            ),
            formulation=rules,
            preview=PreviewSettings(enabled=False),
        )
        self.journal = Journal(self.settings.journal_path)
        self.line = Line(
            self.journal,
            self.settings,
            table=bundled(),
            formats=load_formats(),
            clock=lambda: self.now_s,
        )
        self.watch = Watch(
            folder / "colornet", folder / "taken", folder / "answers", BundledBook()
        )
        self.answers = AnswerWorker(self.journal, self._inbox(), rules, "colornet")
        self.judge = Booth(self.journal, rules, "colornet")

    def measure(
        self, panel: Panel, sample: str, noise: Repeatability, seed: int
    ) -> Job:
        """The job of one reading, as far as the line gets with it."""
        rng = np.random.default_rng(seed)
        measurement = Measurement(
            geometries=tuple(Geometry(angle) for angle in ANGLES.tolist()),
            spectra=Spectra(
                panel.wavelengths_nm, noisy(panel, rng, noise).factors_at(ANGLES)
            ),
            raw=sample.encode(),
        )
        instrument = Instrument("Virtual", "V3", "1")
        reading = Reading(measurement, instrument, datetime.now(UTC), "simulated")
        reading = replace(reading, sample=sample)
        token = self.journal.accept_reading(reading, source="bench")
        self.drain()
        return self.job(token)

    def formulate(self) -> None:
        """Let the formulation software answer everything that lies there."""
        while self.watch.step():
            pass
        self.take_answers()

    def take_answers(self) -> None:
        self.answers.step()
        self.now_s += 5.0
        while self.answers.step():
            pass

    def spray(self, job: Job) -> Panel:
        proposal = self.journal.formulas.open_proposal(job.id)
        assert proposal is not None
        assert proposal.answer.proposal is not None
        components = proposal.answer.proposal.formula.components
        return self.booth.spray({one.toner: one.parts for one in components})

    def drain(self) -> None:
        while self.line.step():
            pass

    def job(self, token: str) -> Job:
        job = self.journal.job(token)
        assert job is not None
        return job

    def kinds(self, job: Job) -> list[str]:
        return [event.kind for event in self.journal.events(job)]

    def states(self, job: Job) -> list[str]:
        return [one.state for one in self.journal.formulas.of_job(job.id)]

    def _inbox(self) -> Inbox:
        folders = InboxFolders.below(
            self.folder, self.settings.answers_folder, within="answers"
        )
        folders.create()
        return Inbox(folders, quiet_s=1.0, max_bytes=100_000, clock=lambda: self.now_s)
