"""`paintlink formulation`: answers, panels, and how a formula comes nearer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import json_option, number_text, print_json, print_table
from paintlink.cli.state import config_option, settings_of

if TYPE_CHECKING:
    from paintlink.config import Settings
    from paintlink.daemon.journal import Journal
    from paintlink.daemon.records import Job
    from paintlink.formulation import Step


@click.group("formulation", short_help="Answers, panels, and how a formula converges.")
def command() -> None:
    """Look at formulas, link sprayed panels, accept or reject."""


@command.command("list")
@json_option
@config_option
def list_formulations(as_json: bool, config: Path | None) -> None:
    """List the jobs that were answered, the newest first."""
    with _journal(settings_of(config)) as journal:
        found = [_summary(journal, token) for token in journal.formulas.formulating()]
    if as_json:
        print_json(found)
    elif found:
        print_table(tuple(found[0]), [tuple(map(str, one.values())) for one in found])
    else:
        click.echo("No answers yet. They are expected in the folder answers/.")


@command.command("show")
@click.argument("job")
@click.option(
    "--plot",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the convergence as a picture (PNG or SVG).",
)
@click.option(
    "--preview",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write a split picture (PNG): target left, newest predicted colour right.",
)
@json_option
@config_option
def show(
    *,
    job: str,
    plot: Path | None,
    preview: Path | None,
    as_json: bool,
    config: Path | None,
) -> None:
    """Show how the formulation of JOB converges: per iteration and per angle."""
    settings = settings_of(config)
    with _journal(settings) as journal:
        found = _job(journal, job)
        steps = _steps(journal, settings, found)
        minutes = journal.formulas.minutes_to_accepted(found.id)
        states = {one.iteration: one.state for one in journal.formulas.of_job(found.id)}
    if plot is not None:
        from paintlink.formulation import plot_convergence

        plot_convergence(steps, found.spec.name if found.spec else job, plot)
    if preview is not None:
        _write_preview(found, steps, preview)
    if as_json:
        print_json({
            "job": found.token,
            "minutes_to_accepted": minutes,
            "iterations": [_document(one, states) for one in steps],
        })
        return
    _print(found, steps, states, minutes)


@command.command("panel")
@click.argument("job")
@click.argument("panel")
@config_option
def panel(job: str, panel: str, config: Path | None) -> None:
    """Say that the job PANEL is the measured panel of the newest formula of JOB.

    A reading whose sample name begins with the id of JOB is linked by itself.
    """
    from paintlink.daemon.formulation import Booth

    settings = settings_of(config)
    with _journal(settings) as journal:
        root, sprayed = _job(journal, job), _job(journal, panel)
        booth = Booth(journal, settings.formulation, settings.answering_route)
        booth.judge(sprayed, root)
        last = journal.events(_job(journal, job))[-1]
    click.echo(f"{root.token}: {last.kind} {last.text}")


@command.command("accept")
@click.argument("job")
@config_option
def accept(job: str, config: Path | None) -> None:
    """Accept the newest formula of JOB, whatever its panels say."""
    _decide(job, config, "accepted", "by command")


@command.command("reject")
@click.argument("job")
@click.argument("reason")
@config_option
def reject(job: str, reason: str, config: Path | None) -> None:
    """Reject the newest formula of JOB for a REASON; a resend may bring another."""
    _decide(job, config, "rejected", reason)


def _decide(token: str, config: Path | None, state: Any, why: str) -> None:
    from paintlink.errors import ConfigError

    with _journal(settings_of(config)) as journal:
        found = _job(journal, token)
        proposal = journal.formulas.open_proposal(found.id)
        if proposal is None:
            msg = f"job {found.token} has no open formula"
            raise ConfigError(msg)
        journal.formulas.decide(proposal, state, why)
    click.echo(f"{found.token}: formula of iteration {proposal.iteration} {state}")


def _print(
    job: Job, steps: tuple[Step, ...], states: Mapping[int, str], minutes: float | None
) -> None:
    from paintlink.formulation import best_step

    rows = [
        (
            str(one.iteration),
            number_text(one.predicted_mean, 2),
            number_text(one.measured_mean, 2),
            number_text(one.best_mean, 2),
            _per_angle(one),
            ", ".join(
                f"{part.toner} {part.parts:g}{' new' if part.added else ''}"
                for part in one.proposal.formula.components
            ),
            states.get(one.iteration, ""),
        )
        for one in steps
    ]
    columns = (
        "iteration", "predicted", "panel", "best", "per angle", "formula", "state",
    )  # fmt: skip
    title = f"{job.token}: CIEDE2000 to the target, mean over the angles"
    print_table(columns, rows, title=title)
    best = best_step(steps)
    if best is not None:
        click.echo(f"best panel: iteration {best.iteration}")
    if minutes is not None:
        click.echo(f"{minutes:.1f} minutes from reading to accepted formula")


def _per_angle(step: Step) -> str:
    errors = step.measured or step.predicted
    return "  ".join(f"{one.aspecular_deg:g}: {one.dE00:.2f}" for one in errors)


def _document(step: Step, states: Mapping[int, str]) -> dict[str, Any]:
    formula = step.proposal.formula.components
    return {
        "iteration": step.iteration,
        "state": states.get(step.iteration, ""),
        "formula": {one.toner: one.parts for one in formula},
        "predicted": [one._asdict() for one in step.predicted],
        "measured": [one._asdict() for one in step.measured],
        "predicted_mean": step.predicted_mean,
        "measured_mean": step.measured_mean,
        "best_mean": step.best_mean,
    }


def _write_preview(job: Job, steps: tuple[Step, ...], path: Path) -> None:
    from paintlink.cli.files import write_new
    from paintlink.cli.preview import cache_folder
    from paintlink.errors import ConfigError
    from paintlink.preview import render, to_png

    if job.spec is None or not steps:
        msg = f"job {job.token} has no predicted colour yet"
        raise ConfigError(msg)
    predicted = replace(job.spec, samples=steps[-1].proposal.predicted, spectra=())
    picture = render([job.spec, predicted], cache_dir=cache_folder())
    write_new(path, to_png(picture), replace=True)


def _summary(journal: Journal, token: str) -> dict[str, Any]:
    job = _job(journal, token)
    answers = journal.formulas.of_job(job.id)
    minutes = journal.formulas.minutes_to_accepted(job.id)
    return {
        "job": token,
        "sample": job.spec.name if job.spec else job.source,
        "iterations": len(answers),
        "panels": len(journal.formulas.panels(job.id)),
        "state": answers[-1].state if answers else "",
        "minutes": number_text(minutes),
    }


def _steps(journal: Journal, settings: Settings, job: Job) -> tuple[Step, ...]:
    from paintlink.daemon.formulation import Booth

    return Booth(journal, settings.formulation, settings.answering_route).steps(job)


def _job(journal: Journal, token: str) -> Job:
    from paintlink.cli.jobs import find_job

    return find_job(journal, token)


def _journal(settings: Settings) -> Journal:
    from paintlink.daemon.journal import Journal

    return Journal(settings.journal_path)
