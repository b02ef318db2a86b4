"""How fast foreign files become specifications.

Usage: python benchmarks/importers.py. For the MA-T12 workbook: geometries per second
from bytes to specifications, as a share of what merely reading the cells costs in the
same run, with python-calamine (which paintlink uses) and openpyxl. For every format:
one fixture, and the same figure.
"""

from __future__ import annotations

import gc
import io
import sys
import time
from collections.abc import Callable
from importlib import import_module

from paintlink.intake import Import, importers, read_any
from tests.intake.fixtures import paint
from tests.intake.fixtures.mat12_xlsx import book, saved

READINGS = 834
ROUNDS = 5
SHEETS = ("Color Data", "Spectral Data")


def best_s(work: Callable[[], object], rounds: int = ROUNDS) -> float:
    """Least processor time one run of the work takes; it works on one core only."""
    times = []
    for _ in range(rounds):
        gc.collect()
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def cells_by_calamine(data: bytes) -> None:
    """Every cell of the two sheets, as Python values."""
    from python_calamine import CalamineWorkbook

    opened = CalamineWorkbook.from_filelike(io.BytesIO(data))
    for sheet in SHEETS:
        opened.get_sheet_by_name(sheet).to_python()


def cells_by_openpyxl(data: bytes) -> None:
    """The same with openpyxl in its fast mode."""
    from openpyxl import load_workbook

    opened = load_workbook(io.BytesIO(data), read_only=True)
    for sheet in SHEETS:
        for _ in opened[sheet].iter_rows(values_only=True):
            pass


def geometries(found: Import) -> int:
    """Number of geometries in everything a file held."""
    readings = [item.reading for item in found.items if item.reading]
    return sum(len(one.measurement.geometries) for one in readings)


def workbook() -> None:
    """The bar: a workbook of ten thousand geometries."""
    names = tuple(f"Basalt {number}" for number in range(READINGS))
    data = saved(book(names))
    found = read_any(data, name="qc.xlsx")
    count = geometries(found)
    if count != READINGS * len(paint.MA_T12) or len(found.specs) != READINGS:
        sys.exit("the workbook was not read whole")
    ours = best_s(lambda: read_any(data, name="qc.xlsx"))
    bare = best_s(lambda: cells_by_calamine(data))
    slow = best_s(lambda: cells_by_openpyxl(data), rounds=1)
    print(f"workbook of {count} geometries, {len(data) / 1e6:.1f} MB packed")
    print(f"  cells by calamine     {bare:6.2f} s  {count / bare:9.0f} geometries/s")
    print(f"  import                {ours:6.2f} s  {count / ours:9.0f} geometries/s")
    print(f"  cells by openpyxl     {slow:6.2f} s  {count / slow:9.0f} geometries/s")
    print(f"  import / bare reading {ours / bare:6.2f}")
    print(f"  openpyxl / import     {slow / ours:6.2f}")


def fixtures() -> None:
    """One small file of each format."""
    for format_id in importers():
        data = import_module(f"tests.intake.fixtures.{format_id}").document()
        found = read_any(data, name="fixture")
        spent = best_s(lambda data=data: read_any(data, name="fixture"), rounds=20)
        print(
            f"  {format_id:<15} {len(data):>7} bytes {len(found.items)} readings "
            f"{spent * 1e3:7.2f} ms"
        )


if __name__ == "__main__":
    workbook()
    fixtures()
