"""Faults of the program itself: one of them stops one job, not the line behind it."""

from __future__ import annotations

import logging
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from paintlink.errors import JournalError

log = logging.getLogger(__name__)

# No single job is to blame for these, and the next one would meet them too.
OF_NO_JOB = (JournalError, OSError, MemoryError)


@contextmanager
def put_aside(what: str, mark: Callable[[str], object]) -> Iterator[None]:
    """Log a fault of the program inside, and have ``mark`` keep it in words.

    What no single job is to blame for comes through: the journal, files, memory.
    """
    try:
        yield
    except OF_NO_JOB:
        raise
    except Exception as error:
        log.exception("%s: a fault of the program; the work goes on", what)
        mark(in_words(error))


def in_words(error: Exception) -> str:
    """A fault with its place, for the person who will report it."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{Path(place.filename).name} line {place.lineno}"
    return f"a fault of the program ({type(error).__name__}: {error}; {where})"


class Batch:
    """How much work to take at once: after a fault one by one, until it is found."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._singly = 0

    @property
    def size(self) -> int:
        """How much to take next."""
        return 1 if self._singly else self._limit

    @contextmanager
    def tried(
        self, taken: Sequence[object], what: str, mark: Callable[[str], object]
    ) -> Iterator[None]:
        """Put the work aside when it was taken alone; else have it taken singly."""
        self._singly = max(0, self._singly - 1)

        def blame(fault: str) -> None:
            if len(taken) == 1:
                mark(fault)
            else:
                self._singly = len(taken)

        with put_aside(what, blame):
            yield
