"""`paintlink driver-test`: the exam every driver takes, for one of yours."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import json_option, print_json, print_table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from paintlink.conformance import Case, Result, Subject

WAYS = ("memory", "pty", "tcp", "rfc2217", "pyusb", "usb+ip")
FAILED = 1


@click.command("driver-test", short_help="Examine a driver under every fault.")
@click.argument("driver")
@click.option("--simulator", metavar="MODULE", help="Module of its simulator.")
@click.option(
    "--transport",
    "transports",
    multiple=True,
    type=click.Choice(WAYS),
    help="Only this connection; may be repeated.",
)
@click.option("--fault", "faults", multiple=True, help="Only this fault; likewise.")
@json_option
@click.pass_context
def command(
    ctx: click.Context,
    *,
    driver: str,
    simulator: str | None,
    transports: Sequence[str],
    faults: Sequence[str],
    as_json: bool,
) -> None:
    """Examine DRIVER, an id such as xrite_ma or a module such as shop.acme9.

    Its simulator is read under every fault: the reading must be whole and right, or be
    refused by one of paintlink's errors. In memory the fault begins at each of the
    first eight answers, and bytes arrive 1, 3 and 4096 at a time.

    Ends with 1 when an answer is wrong.
    """
    from paintlink.conformance import failed, rows, subject, transports_of

    found = subject(driver, simulator)
    ways = [way for way in transports_of(found) if not transports or way in transports]
    questions = _questions(found, ways, faults)
    results = _examined(found, questions, quiet=as_json)
    faulty = failed(results)
    if as_json:
        print_json([_document(one) for one in results])
    else:
        print_table(("driver", "fault", *ways), rows(results, ways))
        for line in faulty:
            click.secho(line, fg="red", err=True)
        click.echo(_conclusion(len(results), len(faulty)))
    ctx.exit(FAILED if faulty else 0)


def _questions(
    found: Subject, ways: Sequence[str], faults: Sequence[str]
) -> list[Case]:
    from paintlink.conformance import CHUNKS, EXCHANGES, cases

    known = {"", *found.kit.FAULTS, *found.kit.STATES}
    for fault in faults:
        if fault not in known:
            msg = f"there is no fault {fault!r}; known: {', '.join(sorted(known)[1:])}"
            raise click.BadParameter(msg, param_hint="--fault")
    full = {"exchanges": EXCHANGES, "chunks": CHUNKS}
    return [
        case
        for way in ways
        for case in cases(found, way, **(full if way == "memory" else {}))
        if not faults or case.fault in faults
    ]


def _examined(
    found: Subject, questions: Sequence[Case], *, quiet: bool
) -> list[Result]:
    from rich.progress import Progress

    from paintlink.conformance import examine, examine_all

    in_memory = [case for case in questions if case.transport == "memory"]
    on_wires = [case for case in questions if case.transport != "memory"]
    with Progress(transient=True, disable=quiet) as progress:
        tracked = progress.track(in_memory, description="in memory")
        results = [examine(found, case) for case in tracked]
        progress.add_task("on wires", total=None, visible=bool(on_wires))
        return results + examine_all((found, case) for case in on_wires)


def _document(result: Result) -> dict[str, Any]:
    from dataclasses import asdict

    return {**asdict(result.case), "verdict": result.verdict, "text": result.text}


def _conclusion(count: int, faulty: int) -> str:
    if faulty:
        return f"{faulty} of {count} readings are wrong: the lines above name them"
    return f"{count} readings, every one right or refused by name"
