"""Libraries from files of other programs."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from paintlink.intake import read_any
from paintlink.library import Shelf, paint_spec
from tests.cli.conftest import Run
from tests.intake.fixtures.cxf3 import document


def test_colours_of_a_cxf_file_become_paints(run: Run, tmp_path: Path) -> None:
    names = tuple(f"Basalt {number}" for number in range(1, 8))
    (tmp_path / "book.cxf").write_bytes(document(names))

    done = run("library", "import", "book.cxf", "--into", "Book", "--json")

    assert json.loads(done.stdout)["paints"] == 7
    table = Shelf(tmp_path / "home/.local/state/paintlink/library.db").table("Book")
    assert table.codes == names
    specs = read_any(tmp_path / "book.cxf").specs
    assert np.array_equal(table.lab, [spec.lab() for spec in specs])
    assert paint_spec(table, 0).angles_deg == (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)


def test_imported_colour_keeps_its_spectra(run: Run, tmp_path: Path) -> None:
    (tmp_path / "book.cxf").write_bytes(document(("A", "B")))
    run("library", "import", "book.cxf", "--into", "Book")

    run("library", "show", "B", "-l", "Book", "-o", "b.xml")
    done = run("validate", "b.xml", "--json")

    assert done.returncode == 0
    assert b"<spectrum " in (tmp_path / "b.xml").read_bytes()


def test_refused_colours_are_named(run: Run, tmp_path: Path) -> None:
    (tmp_path / "book.cxf").write_bytes(document(("A", "B", "A")))

    done = run("library", "import", "book.cxf", "--into", "Book")

    assert done.returncode == 3
    assert "A: the code 'A' stands already in A: keep one of the two" in done.stderr


def test_damaged_file_is_refused(run: Run, tmp_path: Path) -> None:
    (tmp_path / "book.cxf").write_bytes(document()[:-200])

    done = run("library", "import", "book.cxf", "--into", "Book")

    assert done.returncode == 3
    assert "book.cxf" in done.stderr
