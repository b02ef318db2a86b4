"""No reading of a simulator leaves through a production route, however it is reached.

The configuration calls every instrument real: nobody thought of changing it.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from paintlink_simulators import (
    PtyPort,
    Rfc2217Port,
    TcpPort,
    UsbIpPort,
    UsbSocket,
    chn_cr30,
    km_cm512,
    xrite_ma,
    xrite_rci,
)
from tests.conformance.bench import SEED, panel

Reach = Callable[[Any, ExitStack], str]


def on_pty(simulator: Any, opened: ExitStack) -> str:
    return opened.enter_context(PtyPort(simulator, auto_press_after_s=0.05)).path


def on_tcp(simulator: Any, opened: ExitStack) -> str:
    return opened.enter_context(TcpPort(simulator, auto_press_after_s=0.05)).url


def on_rfc2217(simulator: Any, opened: ExitStack) -> str:
    return opened.enter_context(Rfc2217Port(simulator, auto_press_after_s=0.05)).url


def on_usbip(simulator: Any, opened: ExitStack) -> str:
    device = UsbSocket(xrite_rci.usb_function(simulator))
    opened.callback(device.close)
    return opened.enter_context(UsbIpPort([device])).url()


CASES: list[tuple[Any, Reach]] = [(xrite_ma, on_rfc2217), (xrite_rci, on_usbip)]
MORE: list[tuple[Any, Reach]] = [
    (xrite_ma, on_pty),
    (km_cm512, on_tcp),
    (chn_cr30, on_pty),
]


@pytest.fixture
def opened() -> Iterator[ExitStack]:
    with ExitStack() as stack:
        yield stack


@pytest.mark.parametrize(
    ("module", "reach"),
    [*CASES, *(pytest.param(*case, marks=pytest.mark.proof) for case in MORE)],
    ids=[f"{m.__name__}-{r.__name__}" for m, r in [*CASES, *MORE]],
)
def test_reading_stays_out_of_a_route_for_real_ones(
    module: Any, reach: Reach, opened: ExitStack, tmp_path: Path
) -> None:
    simulator = module.create(panel(), clock=time.monotonic, seed=SEED)
    driver = module.__name__.rpartition(".")[2]
    config = shop(tmp_path, driver, reach(simulator, opened))

    done = subprocess.run(
        [
            *(sys.executable, "-m", "paintlink", "measure", "bench"),
            *("--readings", "1", "--json", "--config", str(config)),
        ],
        capture_output=True,
        text=True,
        timeout=60.0,
        check=False,
    )

    assert done.returncode == 0, done.stderr
    job = json.loads(done.stdout)
    assert job["origin"] == "simulated"
    assert "production" not in {one["route"] for one in job["deliveries"]}
    assert not [path for path in (tmp_path / "production").iterdir() if path.is_file()]
    played = [path.name for path in (tmp_path / "playground").glob("*.xml")]
    assert all(name.startswith("SIM-") for name in played)
    # One reading that does arrive where it may; the others lack angles to be delivered.
    assert bool(played) == (module is xrite_ma)


def shop(folder: Path, driver: str, port: str) -> Path:
    """A configuration with a route for real readings and one that takes any."""
    routes = {"production": '["real"]', "playground": '["real", "simulated"]'}
    text = (
        '[site]\nfolder = "."\n[state]\nfolder = "state"\n[preview]\nsize = 128\n'
        f'[[instrument]]\nname = "bench"\ndriver = "{driver}"\nport = "{port}"\n'
        'origin = "real"\n'
    )
    for name, accept in routes.items():
        (folder / name).mkdir()
        text += (
            f'[[route]]\nname = "{name}"\nfolder = "{name}"\nformat = "colornet"\n'
            f"accept = {accept}\n"
        )
    path = folder / "paintlink.toml"
    path.write_text(text)
    return path
