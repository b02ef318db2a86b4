"""Drivers found through entry points: the file name is the id."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator
from importlib.metadata import EntryPoint, entry_points
from types import ModuleType
from typing import NamedTuple, cast

from paintlink.errors import ConfigError
from paintlink.instrument._contract import DriverInfo, DriverModule
from paintlink.instrument._text import did_you_mean

DRIVER_GROUP = "paintlink.drivers"


class Modules(NamedTuple):
    """Modules by id, and a sentence for each one that cannot be used."""

    found: dict[str, ModuleType]
    failures: dict[str, str]


def modules_in_group(group: str) -> Modules:
    """Return the public modules of every package an entry point of ``group`` names.

    A broken module costs only itself. When two packages hold the same id, the one that
    ships with paintlink stands.
    """
    modules = Modules({}, {})
    for entry in sorted(entry_points(group=group), key=_own_first):
        try:
            names = [*_module_names(_import(entry.value))]
        except ConfigError as fault:
            modules.failures[entry.value] = str(fault)
            continue
        for name in names:
            _add(modules, name, f"{entry.value}.{name}")
    return modules


def drivers() -> dict[str, DriverModule]:
    """Return every usable driver by id."""
    found = modules_in_group(DRIVER_GROUP).found
    return {
        name: cast("DriverModule", module)
        for name, module in found.items()
        if not _fault(name, module)
    }


def failures() -> dict[str, str]:
    """Return why each unusable driver is left out, by id."""
    modules = modules_in_group(DRIVER_GROUP)
    faults = {name: _fault(name, module) for name, module in modules.found.items()}
    return modules.failures | {name: fault for name, fault in faults.items() if fault}


def load_driver(driver_id: str) -> DriverModule:
    """Return the driver with this id.

    Raises
    ------
    ConfigError
        When there is none, or when it is broken.
    """
    known = drivers()
    if driver_id in known:
        return known[driver_id]
    fault = failures().get(driver_id)
    if fault:
        raise ConfigError(fault)
    hint = did_you_mean(driver_id, known) or ";"
    msg = f"unknown driver {driver_id!r}{hint} known: {', '.join(sorted(known))}"
    raise ConfigError(msg)


def _own_first(entry: EntryPoint) -> tuple[bool, str]:
    return entry.dist is None or entry.dist.name != "paintlink", entry.value


def _import(path: str) -> ModuleType:
    try:
        return importlib.import_module(path)
    except (Exception, SystemExit) as error:
        msg = f"{path} cannot be imported: {type(error).__name__}: {error}"
        raise ConfigError(msg) from error


def _module_names(package: ModuleType) -> Iterator[str]:
    if not hasattr(package, "__path__"):
        msg = f"{package.__name__} is a module: the entry point must name a package"
        raise ConfigError(msg)
    for module in pkgutil.iter_modules(package.__path__):
        if not module.ispkg and not module.name.startswith("_"):
            yield module.name


def _add(modules: Modules, name: str, path: str) -> None:
    if name in modules.found:
        modules.failures[path] = (
            f"{path} is left out: {modules.found[name].__name__} has the same id"
        )
        return
    try:
        modules.found[name] = _import(path)
    except ConfigError as fault:
        modules.failures[name] = str(fault)


def _fault(name: str, module: ModuleType) -> str:
    info = getattr(module, "INFO", None)
    if not isinstance(info, DriverInfo) or not callable(
        getattr(module, "create", None)
    ):
        return (
            f"{module.__name__} is no driver: it needs INFO (DriverInfo) and create()"
        )
    if info.id != name:
        return f"{module.__name__} says its id is {info.id!r}: it must be the file name"
    return ""
