"""The person at the terminal, as a driver speaks to one."""

from __future__ import annotations

import sys

import click


class Operator:
    """Prints each sentence; waits for Enter where the host starts something.

    Without a terminal nobody can press Enter: it goes on at once.
    """

    def __call__(self, sentence: str) -> None:
        """Print a sentence."""
        click.secho(sentence, fg="cyan", err=True)

    def confirm(self, sentence: str) -> None:
        """Print a sentence and wait for Enter."""
        if not sys.stdin.isatty():
            self(sentence)
            return
        click.secho(f"{sentence} Then press Enter.", fg="cyan", err=True)
        sys.stdin.readline()
