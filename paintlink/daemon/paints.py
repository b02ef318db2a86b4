"""The paint library that the line compares readings with."""

from __future__ import annotations

from paintlink.config import Settings
from paintlink.model import PaintTable


def known_paints(settings: Settings) -> PaintTable:
    """The library that ``[snap] library`` names, as it is now.

    From here on this process keeps its search trees in the state folder, so that the
    next one maps a large library's instead of growing it again.

    Raises
    ------
    LibraryError
        When there is none of that name, or it cannot be read.
    """
    from paintlink.library import Shelf
    from paintlink.snap import INDEXES

    INDEXES.folder = settings.indexes_folder
    return Shelf(settings.library_path).table(settings.snap.library)
