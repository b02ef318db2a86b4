"""Simulated instruments on real pseudo-terminals, and the shop they stand in.

The panels are sprayed by a virtual booth after formulas of the bundled library that
have aged a little, so that the line has something to find.
"""

from __future__ import annotations

import importlib
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from paintlink.config import (
    InboxSettings,
    InstrumentSettings,
    RouteSettings,
    Settings,
    SiteSettings,
    StateSettings,
)
from paintlink.errors import ConfigError
from paintlink.instrument import modules_in_group
from paintlink.library import book

SIMULATOR_GROUP = "paintlink.simulators"
AGEING = 0.06  # standard deviation of the logarithm of each toner's strength
CONFIG = """\
# The shop of `paintlink demo`. Folders are relative to this file.
[site]
name = "demo"
folder = "."

[state]
folder = "state"

[[route]]
name = "colornet"
folder = "colornet"
format = "colornet"
accept = ["simulated"]
"""


@dataclass(frozen=True, slots=True)
class SimulatedInstrument:
    """One instrument of the demo."""

    name: str
    driver: str
    model: str
    serial: str


INSTRUMENTS = (
    SimulatedInstrument("bench", "xrite_ma", "MA68II", "SIM-4711"),
    SimulatedInstrument("spray booth", "xrite_ma", "MA68", "SIM-0815"),
)


class Shop:
    """A body shop in a folder: simulated instruments, their panels, one route.

    Parameters
    ----------
    folder
        Everything is kept below it; a second demo goes on where the first ended. The
        file ``config_path`` in it shows the shop to the other commands.
    seed
        Decides panels and noise; None takes a new one.
    press_every_s
        How long after arming the simulated operator presses the instrument.
    """

    def __init__(
        self, folder: Path, *, seed: int | None = None, press_every_s: float
    ) -> None:
        self._rng = np.random.default_rng(seed)
        self._package, modules = _simulators()
        self._booth = self._package.SprayBooth(seed=int(self._rng.integers(2**31)))
        self._ports: dict[str, Any] = {}
        self._simulators: dict[str, Any] = {}
        for one in INSTRUMENTS:
            self._simulators[one.name] = modules[one.driver].create(
                self._panel()[1],
                clock=time.monotonic,
                seed=int(self._rng.integers(2**31)),
                model=one.model,
            )
            self._ports[one.name] = self._package.PtyPort(
                self._simulators[one.name], auto_press_after_s=press_every_s
            )
        self.settings = _settings(folder.resolve(), self._ports)
        self.config_path = self.settings.site_folder / "paintlink.toml"
        self.config_path.write_text(CONFIG, encoding="utf-8")

    def close(self) -> None:
        """Unplug every instrument."""
        for port in self._ports.values():
            port.close()

    def lay_next_panel(self, instrument: str) -> str:
        """Name of a new panel, laid under the instrument."""
        name, panel = self._panel()
        self._simulators[instrument].panel = panel
        return name

    def _panel(self) -> tuple[str, Any]:
        """Name and panel of an aged effect paint."""
        table = book().table
        effect = [row for row, one in enumerate(table.finishes) if one != "solid"]
        row = int(self._rng.choice(effect))
        formula = book().formula(row)
        strengths = np.exp(self._rng.normal(0.0, AGEING, len(formula))).tolist()
        aged = {
            one.code: one.parts * strength
            for one, strength in zip(formula, strengths, strict=True)
        }
        name = f"{table.names[row]}, aged"
        return name, self._booth.spray(aged, name)


def _simulators() -> tuple[Any, dict[str, Any]]:
    modules = modules_in_group(SIMULATOR_GROUP)
    missing = {one.driver for one in INSTRUMENTS} - set(modules.found)
    if missing:
        faults = "; ".join(modules.failures.values())
        msg = f"no simulator {', '.join(missing)}: install paintlink again. {faults}"
        raise ConfigError(msg)
    package = modules.found[INSTRUMENTS[0].driver].__package__
    return importlib.import_module(str(package)), dict(modules.found)


def _settings(folder: Path, ports: dict[str, Any]) -> Settings:
    route_folder = folder / "colornet"
    route_folder.mkdir(parents=True, exist_ok=True)
    return Settings(
        site=SiteSettings(name="demo", folder=folder),
        state=StateSettings(folder=folder / "state"),
        inbox=InboxSettings(folder=folder / "inbox", poll_s=1.0),
        instruments=tuple(
            InstrumentSettings(
                name=one.name,
                driver=one.driver,
                port=ports[one.name].path,
                serial=one.serial,
                origin="simulated",
                readings=1,
            )
            for one in INSTRUMENTS
        ),
        routes=(
            RouteSettings(
                name="colornet",
                folder=route_folder,
                format="colornet",
                accept=("simulated",),
            ),
        ),
    )
