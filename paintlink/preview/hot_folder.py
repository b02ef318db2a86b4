"""A folder in which every colour that is dropped gets its picture beside it."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from paintlink import __version__
from paintlink.errors import PaintlinkError
from paintlink.model import ColorSpec
from paintlink.preview.picture import Picture, facts
from paintlink.preview.png import to_png

OURS = (".png", ".json", ".tmp")
SETTLED_S = 0.5
"""How long a file must be left alone before it counts as whole."""


class Drawn(NamedTuple):
    """What became of one file.

    Parameters
    ----------
    pictures
        Names of the pictures beside it.
    error
        Why there are none; empty when all is well.
    """

    source: Path
    pictures: tuple[str, ...]
    error: str


class HotFolder:
    """Draws what lies in a folder; ``NAME.json`` says what was done with ``NAME``.

    The original is never touched. A file is drawn again when its content changes.

    Parameters
    ----------
    read
        Colours of a file; raises `PaintlinkError` when there are none.
    draw
        The picture of a colour.
    now
        Seconds of the clock that file times are in.
    """

    def __init__(
        self,
        folder: Path,
        read: Callable[[Path], Sequence[ColorSpec]],
        draw: Callable[[ColorSpec], Picture],
        now: Callable[[], float] = time.time,
    ) -> None:
        self._folder = folder
        self._read = read
        self._draw = draw
        self._now = now
        self._settled: dict[Path, tuple[int, int, int]] = {}

    def step(self) -> Drawn | None:
        """What became of the next file; None when none is waiting."""
        paths = sorted(self._folder.iterdir())
        self._settled = {
            one: self._settled[one] for one in paths if one in self._settled
        }
        for path in paths:
            digest = self._waiting(path)
            if digest:
                return self._drawn(path, digest)
        return None

    def _waiting(self, path: Path) -> str:
        """Hash of the content of a whole file without its picture, else empty."""
        hidden = path.name.startswith(".") or path.suffix.lower() in OURS
        if hidden or not path.is_file() or path.is_symlink():
            return ""
        try:
            return self._new_content(path)
        except OSError:
            return ""

    def _new_content(self, path: Path) -> str:
        """Hash of what was not drawn yet; files that stay as they are cost a look."""
        told = _beside(path, ".json")
        status = path.stat()
        stamp = (status.st_mtime_ns, status.st_ctime_ns, status.st_size)
        settling = self._now() - status.st_mtime < SETTLED_S
        if settling or (self._settled.get(path) == stamp and told.exists()):
            return ""
        with path.open("rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
        if _known(told) != digest:
            return digest
        self._settled[path] = stamp
        return ""

    def _drawn(self, path: Path, digest: str) -> Drawn:
        pictures: list[dict[str, Any]] = []
        error = ""
        try:
            colours = self._read(path)
            for number, spec in enumerate(colours, start=1):
                ending = ".png" if len(colours) == 1 else f".{number}.png"
                picture = self._draw(spec)
                _write(_beside(path, ending), to_png(picture))
                pictures.append({"file": path.name + ending, **facts(picture)})
        except (PaintlinkError, OSError) as trouble:
            error = str(trouble)
        document = {
            "source": path.name,
            "sha256": digest,
            "pictures": pictures,
            "error": error,
            "version": __version__,
        }
        text = json.dumps(document, indent=2, ensure_ascii=False) + "\n"
        _write(_beside(path, ".json"), text.encode())
        return Drawn(path, tuple(one["file"] for one in pictures), error)


def _known(path: Path) -> str:
    """Hash of the content a file of ours speaks of."""
    try:
        document = json.loads(path.read_bytes())
        return str(document["sha256"])
    except (OSError, ValueError, KeyError, TypeError):
        return ""


def _beside(path: Path, ending: str) -> Path:
    return path.with_name(path.name + ending)


def _write(path: Path, data: bytes) -> None:
    temporary = path.with_name(f".{path.name}.tmp")
    temporary.write_bytes(data)
    temporary.replace(path)
