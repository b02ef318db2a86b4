"""Libraries from colour specifications and files of other programs, and into them."""

from __future__ import annotations

import math
import re
import shutil
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from paintlink.errors import ExportError, LibraryError, SpecError
from paintlink.export.names import safe_name
from paintlink.intake import Item, read_any
from paintlink.library.incoming import (
    Collector,
    Incoming,
    Progress,
    TooManyRefusalsError,
    untold,
)
from paintlink.library.loading import SPECIFICATION
from paintlink.library.lookup import GLOSS_ANGLE_DEG, SYNTHETIC_MARK, paint_spec
from paintlink.library.rows import Conditions, RowError, Rows
from paintlink.spec import read_spec, read_spec_file, write_spec

if TYPE_CHECKING:
    from paintlink.library.shelf import Shelf
    from paintlink.model import ColorSpec, PaintTable

FILES_AT_ONCE = 256
"""Specifications turned into paints together."""

NO_CONDITIONS = Conditions(angles_deg=(15.0, 45.0, 110.0))
PLAIN_NAME = re.compile(r"[A-Za-z0-9_-]{1,60}")


def read_folder(folder: Path, *, progress: Progress = untold) -> Incoming:
    """The paints of all specifications (``*.xml``) in a folder, all or none of them.

    The library gets the aspecular angles of the first specification; each one is kept
    as a whole beside its paint.

    Raises
    ------
    ImportRefusedError
        When files are refused; holds their names and the reasons.
    LibraryError
        When the folder cannot be read or has no such file.
    """
    paths = _paths(folder)
    conditions = _first_conditions(paths)
    collector = Collector(str(folder), conditions)

    def convert(some: list[Path]) -> Rows:
        return _rows([_paint(path, conditions) for path in some], conditions)

    try:
        for start in range(0, len(paths), FILES_AT_ONCE):
            some = paths[start : start + FILES_AT_ONCE]
            collector.add(some, [path.name for path in some], convert)
            progress((start + len(some)) / len(paths))
    except TooManyRefusalsError:
        return collector.finish(stopped=True)
    return collector.finish()


def read_colours(path: Path, *, progress: Progress = untold) -> Incoming:
    """The paints of a file of any format that `paintlink import` reads, such as CxF.

    Its colours have to be at the same angles and for the same observer. A colour
    without a code of its own has its name for one.

    Raises
    ------
    ImportRefusedError
        When colours are refused; holds their names and the reasons.
    InputError
        When the file cannot be read.
    """
    items = read_any(path).items
    specs = [item.spec for item in items if item.spec is not None]
    conditions = _conditions(specs[0]) if specs else NO_CONDITIONS
    collector = Collector(str(path), conditions)

    def convert(some: list[Item]) -> Rows:
        return _rows([_coded(item, conditions) for item in some], conditions)

    try:
        for start in range(0, len(items), FILES_AT_ONCE):
            some = list(items[start : start + FILES_AT_ONCE])
            collector.add(some, [item.name for item in some], convert)
            progress((start + len(some)) / len(items))
    except TooManyRefusalsError:
        return collector.finish(stopped=True)
    return collector.finish()


def write_folder(
    folder: Path, shelf: Shelf, table: PaintTable, progress: Progress = untold
) -> None:
    """Write a specification of every paint into a new folder, whole or not at all.

    Raises
    ------
    ExportError
        When it exists, or cannot be written.
    """
    if folder.exists():
        msg = f"{folder} exists: choose another name, or remove it first"
        raise ExportError(msg)
    temporary = folder.with_name(f".{folder.name}.part")
    names = _file_names(table.codes)
    try:
        shutil.rmtree(temporary, ignore_errors=True)
        temporary.mkdir(parents=True)
        documents = shelf.specifications(table)
        for row, (name, document) in enumerate(zip(names, documents, strict=True)):
            spec = full_spec(table, row, document)
            (temporary / name).write_bytes(write_spec(spec))
            progress((row + 1) / len(names))
        temporary.rename(folder)
    except OSError as error:
        shutil.rmtree(temporary, ignore_errors=True)
        msg = f"{folder}: {error.strerror}; choose a folder you may write to"
        raise ExportError(msg) from error


def full_spec(table: PaintTable, row: int, document: str) -> ColorSpec:
    """The specification a paint was imported from, else one made of the table.

    Code, name and finish are those of the table, which may have been changed since.
    """
    plain = paint_spec(table, row)
    if not document:
        return plain
    spec = read_spec(document.encode(), source=f"{table.library} {plain.code}")
    if not set(plain.samples) <= set(spec.samples):
        return plain
    return replace(spec, code=plain.code, name=plain.name, finish=plain.finish)


def _paths(folder: Path) -> list[Path]:
    try:
        paths = sorted(path for path in folder.iterdir() if path.suffix == ".xml")
    except OSError as error:
        msg = f"{folder} cannot be read: {error.strerror}"
        raise LibraryError(msg) from error
    if not paths:
        msg = f"{folder} has no specification: its files have to end in .xml"
        raise LibraryError(msg)
    return paths


def _first_conditions(paths: list[Path]) -> Conditions:
    """What the first specification says that can be read."""
    for path in paths:
        try:
            return _conditions(read_spec_file(path))
        except SpecError:
            continue
    return NO_CONDITIONS


def _conditions(spec: ColorSpec) -> Conditions:
    return Conditions(
        angles_deg=spec.angles_deg,
        observer=spec.observer,
        synthetic=_synthetic(spec),
    )


def _paint(path: Path, conditions: Conditions) -> ColorSpec:
    try:
        return _fitting(read_spec_file(path), conditions)
    except SpecError as error:
        raise RowError(str(_sourceless(error))) from error


def _coded(item: Item, conditions: Conditions) -> ColorSpec:
    if item.spec is None:
        raise RowError(item.refused)
    spec = _fitting(item.spec, conditions)
    return spec if spec.code else replace(spec, code=item.name)


def _fitting(spec: ColorSpec, conditions: Conditions) -> ColorSpec:
    missing = set(conditions.angles_deg) - set(spec.angles_deg)
    if missing:
        msg = f"no Lab at {min(missing):g} degrees, which the first paint has"
        raise RowError(msg)
    if spec.observer != conditions.observer:
        msg = (
            f"observer {spec.observer} among paints for the {conditions.observer} "
            "degree observer: import them into a library of their own"
        )
        raise RowError(msg)
    if _synthetic(spec) != conditions.synthetic:
        msg = "synthetic and real paints in one folder: keep them apart"
        raise RowError(msg)
    return spec


def _sourceless(error: SpecError) -> SpecError:
    """The same error without the name of the file, which stands beside it."""
    return SpecError(
        error.what, line=error.line, element=error.element, value=error.value
    )


def _rows(specs: list[ColorSpec], conditions: Conditions) -> Rows:
    return Rows(
        codes=tuple(spec.code for spec in specs),
        names=tuple(spec.name.removesuffix(SYNTHETIC_MARK) for spec in specs),
        finishes=tuple(spec.finish for spec in specs),
        lab=np.array([spec.lab(*conditions.angles_deg) for spec in specs]),
        gloss_gu=np.array([_gloss(spec) for spec in specs]),
        extras={SPECIFICATION: tuple(write_spec(spec).decode() for spec in specs)},
    )


def _gloss(spec: ColorSpec) -> float:
    if spec.gloss is None or spec.gloss.angle_deg != GLOSS_ANGLE_DEG:
        return math.nan
    return spec.gloss.value_gu


def _synthetic(spec: ColorSpec) -> bool:
    simulated = spec.provenance is not None and spec.provenance.origin == "simulated"
    return simulated or spec.name.endswith(SYNTHETIC_MARK)


def _file_names(codes: tuple[str, ...]) -> list[str]:
    """A file name for each code: the code itself where any system can write it so."""
    from collections import Counter

    folded = Counter(code.casefold() for code in codes)
    return [
        f"{code}.xml"
        if PLAIN_NAME.fullmatch(code) and folded[code.casefold()] == 1
        else safe_name(code, suffix="xml", key=code)
        for code in codes
    ]
