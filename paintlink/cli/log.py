"""Logging as an operator reads it: one line a fact, on standard error."""

from __future__ import annotations

import logging


def set_up_logging(level: str) -> None:
    """Send the program's log to standard error at a level such as ``info``."""
    logging.basicConfig(
        level=level.upper(), format="%(asctime)s %(levelname)s %(name)s: %(message)s"
    )
