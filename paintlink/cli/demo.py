"""`paintlink demo`: the whole line on simulated instruments."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from paintlink.cli.output import json_option, number_text, print_json

if TYPE_CHECKING:
    from paintlink.daemon.demo import Shop
    from paintlink.daemon.records import Job, Preview
    from paintlink.daemon.service import Service

READ_LIMIT_S = 60.0
WORK_LIMIT_S = 60.0
PRESS_ONCE_S = 0.2
PRESS_EVERY_S = 5.0


@click.command("demo", short_help="Run the whole line on simulated instruments.")
@click.option(
    "--dir",
    "folder",
    default="paintlink-demo",
    show_default=True,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for everything the demo writes.",
)
@click.option("--once", is_flag=True, help="One reading per instrument, then end.")
@click.option(
    "--no-web", is_flag=True, help="No web page (this version has none in any case)."
)
@click.option("--seed", type=int, help="Repeat the same panels and noise.")
@json_option
def command(
    folder: Path, once: bool, no_web: bool, seed: int | None, as_json: bool
) -> None:
    """Run the whole line on simulated instruments: no hardware, no configuration.

    Two instruments measure aged metallic panels over real pseudo-terminals. Each
    reading becomes a colour specification, ColorSnap names the nearest paint of a
    synthetic library, a job file lands in DIR/colornet, and a picture is drawn. A
    second run in the same folder goes on; it sends nothing twice.
    """
    del no_web
    from paintlink.daemon.demo import Shop
    from paintlink.daemon.service import Service

    shop = Shop(
        folder, seed=seed, press_every_s=PRESS_ONCE_S if once else PRESS_EVERY_S
    )
    service = Service(
        shop.settings, readings=1 if once else None, name_sample=shop.lay_next_panel
    )
    try:
        before = _newest(shop)
        service.start()
        try:
            jobs = _once(service, shop, before) if once else _follow(service, shop)
        finally:
            service.stop()
    finally:
        shop.close()
    if as_json:
        from paintlink.cli.jobs import job_document

        print_json([job_document(job) for job in jobs])
    elif jobs:
        print_readings(jobs)
        click.echo(
            "Simulated instruments and a synthetic library: no real paint is named.\n"
            f"Look around: paintlink jobs list --config {_shown(str(shop.config_path))}"
        )


def print_readings(jobs: tuple[Job, ...]) -> None:
    """Print one column for each reading: what was measured, found and delivered."""
    from rich.console import Console
    from rich.table import Table

    table = Table(show_header=False, show_lines=False, pad_edge=False)
    table.add_column(style="bold", no_wrap=True)
    for _ in jobs:
        table.add_column(overflow="fold")
    facts = [_facts(job) for job in jobs]
    for label in facts[0]:
        table.add_row(label, *(fact.get(label, "-") for fact in facts))
    Console().print(table)
    for job in jobs:
        for text in _delivered(job):
            click.echo(f"{job.source} delivered {text}")
        if job.preview:
            click.echo(f"{job.source} picture   {_picture(job.preview)}")


def _facts(job: Job) -> dict[str, str]:
    from paintlink.color import travel
    from paintlink.errors import JournalError

    if job.spec is None or job.spec.provenance is None or not job.matches:
        raise JournalError(f"job {job.token} ended early: {job.error or job.state}")
    spec, best = job.spec, job.matches[0]
    instrument = job.spec.provenance.instrument
    per_angle = " + ".join(f"{one.dE:.2f}" for one in best.differences)
    angles = "/".join(f"{angle:g}" for angle in best.angles_deg)
    indices = travel(spec)
    return {
        "instrument": f"{instrument.maker} {instrument.model} ({job.source})",
        "serial": instrument.serial,
        "sample": spec.name,
        **{
            f"Lab at {one.aspecular_deg:g}": "  ".join(f"{v:.2f}" for v in one.lab)
            for one in spec.samples
        },
        "Flop Index": number_text(indices.flop_index, 2),
        "nearest paint": f"{best.code} {best.name} ({best.finish})",
        "total": f"{best.total:.2f} = {per_angle}",
        "": f"{best.formula} at {angles}, D65/{best.observer}",
        "in words": best.words,
    }


def _delivered(job: Job) -> list[str]:
    return [
        _shown(f"{one.folder}/{one.name}") if one.name else f"{one.state}: {one.error}"
        for one in job.deliveries
    ]


def _picture(preview: Preview) -> str:
    if preview.state == "done":
        return _shown(preview.path)
    return f"{preview.state} {preview.note}".strip()


def _shown(path: str) -> str:
    """A path relative to where the user stands, when that is shorter."""
    whole, here = Path(path), Path.cwd()
    return str(whole.relative_to(here)) if whole.is_relative_to(here) else path


def _newest(shop: Shop) -> int:
    from paintlink.daemon.journal import Journal

    with Journal(shop.settings.journal_path) as journal:
        jobs = journal.jobs(limit=1)
    return jobs[0].id if jobs else 0


def _since(shop: Shop, job_id: int) -> tuple[Job, ...]:
    from paintlink.daemon.journal import Journal

    with Journal(shop.settings.journal_path) as journal:
        jobs = journal.jobs(limit=100)
    return tuple(reversed([job for job in jobs if job.id > job_id]))


def _once(service: Service, shop: Shop, before: int) -> tuple[Job, ...]:
    from paintlink.errors import LinkTimeoutError

    if not service.wait_until_read(READ_LIMIT_S):
        msg = f"a simulated instrument gave no reading within {READ_LIMIT_S:g} s"
        raise LinkTimeoutError(msg)
    service.wait_until_done(WORK_LIMIT_S)
    return _since(shop, before)


def _follow(service: Service, shop: Shop) -> tuple[Job, ...]:
    """Print each reading as it is done, until Ctrl-C; nothing is left to print."""
    shown = _newest(shop)
    click.echo(f"A panel every {PRESS_EVERY_S:g} s for each instrument; Ctrl-C ends.")
    try:
        while not service.stopped.wait(1.0):
            done = [job for job in _since(shop, shown) if job.state == "done"]
            for job in done:
                print_readings((job,))
                shown = max(shown, job.id)
    except KeyboardInterrupt:
        click.echo("stopped", err=True)
    return ()
