"""A driver and the simulator that belongs to it."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any, cast

from paintlink.errors import ConfigError
from paintlink.instrument import (
    DriverInfo,
    DriverModule,
    describe_options,
    drivers,
    load_driver,
    modules_in_group,
)

SIMULATOR_GROUP = "paintlink.simulators"
HASTE_S = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class Subject:
    """What is examined.

    Parameters
    ----------
    kit
        The package ``paintlink_simulators``: faults, ports, panels.
    """

    driver: DriverModule
    simulator: Any
    kit: Any
    options: Mapping[str, object] = field(default_factory=dict)

    @property
    def id(self) -> str:
        """The id of the driver."""
        return self.driver.INFO.id

    @property
    def harmful(self) -> frozenset[str]:
        """Faults that this protocol cannot stand, although others can."""
        return frozenset(getattr(self.simulator, "HARMFUL", ()))


def subjects() -> dict[str, Subject]:
    """Every driver that is registered, by id.

    Raises
    ------
    ConfigError
        When one has no simulator.
    """
    return {driver_id: subject(driver_id) for driver_id in sorted(drivers())}


def subject(name: str, simulator: str | None = None) -> Subject:
    """A driver by its id, or by the path of its module, with its simulator.

    Parameters
    ----------
    simulator
        Path of the simulator's module; the registered one of the same id if left out.

    Raises
    ------
    ConfigError
        When one of the two cannot be found or used.
    """
    driver = _imported(name) if "." in name else load_driver(name)
    driver = cast("DriverModule", driver)
    info = getattr(driver, "INFO", None)
    if info is None or not callable(getattr(driver, "create", None)):
        msg = f"{name} is no driver: it needs INFO (DriverInfo) and create()"
        raise ConfigError(msg)
    registered = modules_in_group(SIMULATOR_GROUP)
    found = _imported(simulator) if simulator else registered.found.get(info.id)
    if found is None:
        msg = (
            f"driver {info.id} has no simulator to be examined with: write one, or "
            "name its module with --simulator"
        )
        raise ConfigError(msg)
    return Subject(driver, found, _kit(registered.found), _hasty(info))


def _hasty(info: DriverInfo) -> dict[str, object]:
    """Options with which a driver waits for the operator as short as it can."""
    return {
        option.name: max(HASTE_S, option.minimum or 0.0)
        for option in describe_options(info.options)
        if option.name.endswith("press_timeout_s")
    }


def _kit(simulators: Mapping[str, ModuleType]) -> ModuleType:
    packages = {str(one.__package__) for one in simulators.values()}
    own = sorted(packages, key=lambda name: name != "paintlink_simulators")
    if not own:
        msg = "no simulators are installed: install paintlink again"
        raise ConfigError(msg)
    return importlib.import_module(own[0])


def _imported(path: str) -> ModuleType:
    try:
        return importlib.import_module(path)
    except Exception as error:
        msg = f"{path} cannot be imported: {type(error).__name__}: {error}"
        raise ConfigError(msg) from error
