"""How the columns of a foreign table map to a reading."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Profile:
    """Placeholder until tables arrive."""

    name: str
