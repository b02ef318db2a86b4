"""A fault of the configuration and the line that tells it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from paintlink.config._overlay import Overlay, variable
from paintlink.config._tables import Table, entries
from paintlink.config._texts import block, source_name


@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong and where; ``index`` counts the blocks of a repeated section."""

    section: str
    index: int | None
    key: str
    text: str

    def line(self, table: Table, given: Overlay, source: Path | None) -> str:
        """Place and fault: the variable it was given in, or the spot in the file."""
        if (self.section, self.key) in given:
            return f"environment: {variable(self.section, self.key)}: {self.text}"
        return f"{source_name(source)}: {self._head(table)}{self.text}"

    def _head(self, table: Table) -> str:
        if not self.section:
            return ""
        if self.index is None:
            return f"[{self.section}]: "
        blocks = dict(entries(table, self.section))
        name = blocks.get(self.index, {}).get("name")
        return f"{block(self.section, self.index, name)}: "
