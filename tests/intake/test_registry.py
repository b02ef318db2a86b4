"""Importers are found as drivers are; one from elsewhere stands beside ours."""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from paintlink.errors import ConfigError, InputError
from paintlink.intake import importer_failures, importers, read_any

OURS = {
    "csv_table", "cxf3", "datacolor_qtx", "ma68_print", "mat12_xlsx", "paintlink_xml",
    "xrite_job_json", "xrite_mif",
}  # fmt: skip
IMPORTER = """
from paintlink.intake import Certainty, Contents, ImporterInfo
from paintlink.spec import read_spec

INFO = ImporterInfo("{id}", "Acme")

def sniff(source):
    return Certainty.SURE if source.data.startswith(b"ACME") else Certainty.NO

def read(source, options):
    {body}
"""


@pytest.fixture
def install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Callable[[str, str], None]]:
    """Install a distribution with one importer module."""
    monkeypatch.syspath_prepend(tmp_path)
    importers.cache_clear()

    def put(name: str, source: str) -> None:
        info = tmp_path / "acme_files-1.0.dist-info"
        info.mkdir()
        (info / "METADATA").write_text("Name: acme_files\nVersion: 1.0\n")
        (info / "entry_points.txt").write_text(
            "[paintlink.importers]\nany = acme_files\n"
        )
        (tmp_path / "acme_files").mkdir()
        (tmp_path / "acme_files" / "__init__.py").write_text("")
        (tmp_path / "acme_files" / f"{name}.py").write_text(textwrap.dedent(source))

    yield put
    importers.cache_clear()
    for name in [name for name in sys.modules if name.startswith("acme_files")]:
        del sys.modules[name]


def test_our_importers_are_found_by_their_file_names() -> None:
    assert importers().keys() == OURS
    assert importer_failures() == {}


def test_foreign_importer_reads_its_files(install: Callable[[str, str], None]) -> None:
    install("acme", IMPORTER.format(id="acme", body="raise source.fault('', 'cut')"))

    assert importers().keys() == {*OURS, "acme"}
    with pytest.raises(InputError, match="x: cut"):
        read_any(b"ACME 1", name="x")


def test_fault_of_an_importer_refuses_only_the_file(
    install: Callable[[str, str], None], caplog: pytest.LogCaptureFixture
) -> None:
    install("acme", IMPORTER.format(id="acme", body="return 1 / 0"))

    with pytest.raises(InputError, match=r"x: a fault of the program .*ZeroDivision"):
        read_any(b"ACME 1", name="x")
    assert "Traceback" in caplog.text


@pytest.mark.parametrize(
    ("source", "reason"),
    [
        ("x = 1", "is no importer: it needs INFO (ImporterInfo), sniff() and read()"),
        (IMPORTER.format(id="other", body="pass"), "says its id is 'other'"),
        ("import nothing_of_this_name", "ModuleNotFoundError"),
    ],
)
def test_broken_importer_is_left_out_with_its_reason(
    source: str, reason: str, install: Callable[[str, str], None]
) -> None:
    install("acme", source)

    assert importers().keys() == OURS
    assert reason in importer_failures()["acme"]


def test_unknown_format_gets_the_nearest_one_suggested() -> None:
    with pytest.raises(ConfigError, match="did you mean 'cxf3'"):
        read_any(b"x", format_id="cxf")


def test_format_can_be_forced() -> None:
    with pytest.raises(InputError, match="not well-formed XML"):
        read_any(b"a,b,c\n1,2,3\n", format_id="cxf3")


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "the file is empty: export it again"),
        (b"  \n", "the file is empty: export it again"),
        (b"\x89PNG\r\n\x1a\n" + bytes(100), "no file paintlink can import; it knows"),
        (b"PK\x03\x04" + bytes(100), "no file paintlink can import; it knows"),
        (b"x" * (33 << 20), "larger than 32 MiB: split the export"),
    ],
)
def test_other_files_are_told_apart(data: bytes, told: str) -> None:
    with pytest.raises(InputError, match=told):
        read_any(data, name="x")


def test_folders_and_pipes_are_refused_at_once(tmp_path: Path) -> None:
    import os

    os.mkfifo(tmp_path / "pipe")

    for path in (tmp_path, tmp_path / "pipe", tmp_path / "missing"):
        with pytest.raises(InputError, match=r"regular file|cannot be read|directory"):
            read_any(path)
