"""A progress bar where work is long and a person watches."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

WORTH_A_BAR = 5


@contextmanager
def bar(total: int, title: str) -> Iterator[Callable[[int], None]]:
    """A function that advances the bar by so many pieces of work; it may be too often.

    No bar is drawn for a handful of pieces, or when standard error is no terminal.
    """
    if total < WORTH_A_BAR or not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(title, total=total)
        yield lambda count: progress.advance(task, count)
