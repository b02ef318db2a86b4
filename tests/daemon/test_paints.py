from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from paintlink.config import Settings, SnapSettings, default_settings
from paintlink.daemon.paints import known_paints
from paintlink.daemon.service import Service
from paintlink.errors import LibraryError
from paintlink.library import Shelf, bundled, paint_spec
from paintlink.library.csv_file import read_csv
from paintlink.library.headings import Profile
from paintlink.snap import INDEXES, nearest
from paintlink.snap.index import FIRST_QUESTION
from tests.library.csv_tables import rows, write_csv


@pytest.fixture
def settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Settings:
    monkeypatch.setattr(INDEXES, "folder", None)
    return default_settings(environ={"STATE_DIRECTORY": str(tmp_path / "state")})


def comparing_with(settings: Settings, library: str) -> Settings:
    return replace(settings, snap=SnapSettings(library=library))


def test_the_bundled_library_is_the_usual_one(settings: Settings) -> None:
    assert known_paints(settings) is bundled()


def test_an_own_library_is_compared_with_once_it_is_named(
    settings: Settings, tmp_path: Path
) -> None:
    table = write_csv(tmp_path / "paints.csv", rows(30))
    shelf = Shelf(settings.library_path)
    shelf.editor.import_paints("Shop", read_csv(table, Profile()), "add")

    found = known_paints(comparing_with(settings, "shop"))

    assert (found.library, len(found)) == ("Shop", 30)


def test_search_trees_outlast_the_process(settings: Settings) -> None:
    table = replace(known_paints(settings), library="Trees")
    target = paint_spec(table, 0, angles_deg=(15.0, 45.0, 110.0))

    for _ in range(FIRST_QUESTION + 1):
        nearest(target, table, formula="ciede2000")

    assert [path.suffix for path in settings.indexes_folder.iterdir()] == [".snap"]


def test_the_service_does_not_start_with_an_unknown_library(settings: Settings) -> None:
    unknown = comparing_with(settings, "Nowhere")

    with pytest.raises(LibraryError, match="Nowhere"):
        known_paints(unknown)
    with pytest.raises(LibraryError, match="Nowhere"):
        Service(unknown, roles=("line",)).start()
