"""Damaged files of every format: a result or a named error, never anything else."""

from __future__ import annotations

import resource
from importlib import import_module

import pytest

from paintlink.errors import InputError
from paintlink.intake import Import, importers, read_any
from paintlink.intake.reading import FAULT
from tests.intake.mutations import crc, mutants

FORMATS = sorted(importers())
SHARE = 150
FULL = 5_000
HIGHEST_GROWTH_MIB = 300


def document(format_id: str) -> bytes:
    module = import_module(f"tests.intake.fixtures.{format_id}")
    data: bytes = module.document()
    return data


def peak_mib() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def outcome(format_id: str, data: bytes) -> str:
    """How one damaged file ends when this importer has to read it."""
    end = end_of(data, format_id)
    if isinstance(end, str):
        assert end.startswith("mutant"), f"no place in {end}"
        assert len(end) < 1500
        assert FAULT not in end, f"document {crc(data):08x}: {data[:300]!r}"
    return "refused" if isinstance(end, str) else "read"


def end_of(data: bytes, format_id: str) -> Import | str:
    """What comes of a file, read by one importer or by the one its content asks for."""
    try:
        return read_any(data, name="mutant", format_id=format_id)
    except InputError as error:
        return str(error)
    except BaseException as error:
        error.add_note(f"{format_id}, document {crc(data):08x}: {data[:300]!r}")
        raise


def examine(format_id: str, count: int, seed: int) -> dict[str, int]:
    counts = {"read": 0, "refused": 0}
    for number, data in enumerate(mutants(document(format_id), count, seed)):
        counts[outcome(format_id, data)] += 1
        if number % 5 == 0:
            end_of(data, "")
    return counts


@pytest.mark.parametrize("format_id", FORMATS)
def test_whole_fixture_is_read_by_its_own_importer(format_id: str) -> None:
    found = read_any(document(format_id), name="fixture")

    assert found.format_id == format_id
    assert found.items


@pytest.mark.parametrize("format_id", FORMATS)
def test_damaged_file_gives_a_result_or_a_named_error(format_id: str) -> None:
    counts = examine(format_id, SHARE, seed=1)

    assert counts["refused"] > SHARE / 20


@pytest.mark.proof
@pytest.mark.timeout(900)
@pytest.mark.parametrize("format_id", FORMATS)
def test_five_thousand_damaged_files_of_each_format(format_id: str) -> None:
    before = peak_mib()

    counts = examine(format_id, FULL, seed=2)

    assert sum(counts.values()) == FULL
    assert counts["refused"] > FULL / 20
    assert peak_mib() - before < HIGHEST_GROWTH_MIB
