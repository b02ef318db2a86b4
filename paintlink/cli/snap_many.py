"""The nearest paints of every target in a folder or a table."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from paintlink.model import PaintTable
    from paintlink.snap import Options
    from paintlink.snap.grown import Mask

STANDARD_OUTPUT = "-"


@dataclass(frozen=True, slots=True)
class Result:
    """One target with its list, or with what is wrong with it."""

    target: str
    rows: tuple[dict[str, Any], ...] = ()
    error: str = ""


def snap_many(
    source: Path,
    table: PaintTable,
    options: Options,
    mask: Mask | None,
    *,
    output: Path | None,
    as_json: bool,
) -> None:
    """Write the lists of all targets; those that cannot be used are told at the end.

    Raises
    ------
    InputError
        After everything else was written, when a target could not be used.
    """
    if source.is_dir():
        results, count = _folder(source, table, options, mask)
    else:
        results, count = _table(source, table, options, mask)
    refused = []
    with _opened(output) as file:
        write = _json_lines(file) if as_json else _csv_rows(file)
        for result in _watched(results, count):
            if result.error:
                refused.append(result)
            else:
                write(result)
    click.echo(f"{count - len(refused)} of {count} targets compared", err=True)
    if refused:
        from paintlink.errors import InputError

        told = "\n".join(f"  {one.target}: {one.error}" for one in refused)
        msg = f"{len(refused)} of {count} targets were left out:\n{told}"
        raise InputError(msg)


def _folder(
    folder: Path, table: PaintTable, options: Options, mask: Mask | None
) -> tuple[Iterator[Result], int]:
    from paintlink.errors import InputError

    files = sorted(folder.glob("*.xml"))
    if not files:
        msg = f"{folder} holds no specification: name a folder with .xml files"
        raise InputError(msg)
    return (_file(path, table, options, mask) for path in files), len(files)


def _file(path: Path, table: PaintTable, options: Options, mask: Mask | None) -> Result:
    from paintlink.errors import InputError
    from paintlink.snap import nearest
    from paintlink.spec import read_spec_file

    try:
        spec = read_spec_file(path)
        matches = nearest(
            spec,
            table,
            top=options.top,
            formula=options.formula,
            angles_deg=options.angles_deg,
            mask=mask,
        )
    except InputError as error:
        return Result(path.name, error=str(error))
    rows = tuple(
        {
            "target": path.stem,
            "rank": match.rank,
            "code": match.code,
            "total": match.total,
            **{f"dE_{one.aspecular_deg:g}": one.dE for one in match.differences},
            "formula": match.formula,
            "estimated_deg": _listed(match.estimated_deg),
            "library": match.library,
            "generation": match.generation,
        }
        for match in matches
    )
    return Result(path.stem, rows)


def _table(
    path: Path, table: PaintTable, options: Options, mask: Mask | None
) -> tuple[Iterator[Result], int]:
    """All rows at once: they share their angles, and so one search index."""
    from paintlink.library.csv_file import read_csv
    from paintlink.model import ColorSpec, Lab, Sample
    from paintlink.snap.many import nearest_rows

    incoming = read_csv(path)
    conditions = incoming.conditions
    first = ColorSpec(
        name=path.stem,
        observer=conditions.observer,
        samples=tuple(
            Sample(angle, Lab(*values))
            for angle, values in zip(
                conditions.angles_deg, incoming.blocks[0].lab[0].tolist(), strict=True
            )
        ),
    )
    codes = [code for block in incoming.blocks for code in block.codes]
    lab = [block.lab for block in incoming.blocks]
    found = nearest_rows(first, lab, table, options, mask)
    return map(_row_result, codes, found), len(codes)


def _row_result(target: str, rows: list[dict[str, Any]]) -> Result:
    return Result(target, tuple({"target": target, **row} for row in rows))


def _listed(angles_deg: Iterable[float]) -> str:
    return "/".join(f"{angle:g}" for angle in angles_deg)


@contextmanager
def _opened(output: Path | None) -> Iterator[IO[str]]:
    """The output file, which appears whole or not at all; or standard output."""
    if output is None or str(output) == STANDARD_OUTPUT:
        yield sys.stdout
        return
    from paintlink.errors import ExportError

    temporary = output.with_name(f".{output.name}.part")
    try:
        with temporary.open("w", encoding="utf-8", newline="") as file:
            yield file
        temporary.replace(output)
    except OSError as error:
        msg = f"{output}: {error.strerror}; choose a folder you may write to"
        raise ExportError(msg) from error
    finally:
        temporary.unlink(missing_ok=True)


def _csv_rows(file: IO[str]) -> Any:
    writer = csv.writer(file)
    written: list[tuple[str, ...]] = []

    def _write(result: Result) -> None:
        for row in result.rows:
            if tuple(row) not in written:
                writer.writerow(row)
                written.append(tuple(row))
            writer.writerow(row.values())

    return _write


def _json_lines(file: IO[str]) -> Any:
    def _write(result: Result) -> None:
        document = {"target": result.target, "matches": result.rows}
        file.write(json.dumps(document, ensure_ascii=False) + "\n")

    return _write


def _watched(results: Iterable[Result], count: int) -> Iterable[Result]:
    """The results, behind a bar where there are many and a person watches."""
    if count < 100 or not sys.stderr.isatty():
        return results
    from rich.console import Console
    from rich.progress import track

    console = Console(stderr=True)
    return track(results, "Comparing", total=count, console=console, transient=True)
