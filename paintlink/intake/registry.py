"""Importers found as drivers are: through entry points, the file name is the id."""

from __future__ import annotations

from functools import cache
from types import ModuleType
from typing import cast

from paintlink.instrument import modules_in_group
from paintlink.intake.contract import Importer, ImporterInfo

IMPORTER_GROUP = "paintlink.importers"


@cache
def importers() -> dict[str, Importer]:
    """Every usable importer by id."""
    found = modules_in_group(IMPORTER_GROUP).found
    return {
        name: cast("Importer", module)
        for name, module in sorted(found.items())
        if not _fault(name, module)
    }


def importer_failures() -> dict[str, str]:
    """Why each unusable importer is left out, by id."""
    modules = modules_in_group(IMPORTER_GROUP)
    faults = {name: _fault(name, module) for name, module in modules.found.items()}
    return modules.failures | {name: fault for name, fault in faults.items() if fault}


def _fault(name: str, module: ModuleType) -> str:
    info = getattr(module, "INFO", None)
    callables = [getattr(module, part, None) for part in ("sniff", "read")]
    if not isinstance(info, ImporterInfo) or not all(map(callable, callables)):
        return (
            f"{module.__name__} is no importer: it needs INFO (ImporterInfo), sniff() "
            "and read()"
        )
    if info.id != name:
        return f"{module.__name__} says its id is {info.id!r}: it must be the file name"
    return ""
