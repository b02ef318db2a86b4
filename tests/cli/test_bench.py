"""Instruments from the command line: borrowed, calibrated, watched."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from paintlink.cli import main
from paintlink.daemon.journal import Journal
from paintlink_simulators import PtyPort
from paintlink_simulators.ports.usbip import UsbIpPort
from paintlink_simulators.usb import RciFunction
from paintlink_simulators.usb.socket import UsbSocket
from tests.daemon.instrument_bench import simulator

Run = Callable[..., Result]

CONFIG = """
[site]
folder = "{folder}/site"
[state]
folder = "{folder}/state"
[preview]
enabled = false
[[instrument]]
name = "bench"
driver = "chn_cr30"
port = "{port}"
readings = 1
finish = "solid"
{more}
"""


@pytest.fixture
def port() -> Iterator[PtyPort]:
    with PtyPort(simulator("chn_cr30")) as port:
        yield port


@pytest.fixture
def configure(tmp_path: Path, port: PtyPort) -> Callable[..., Path]:
    def write(more: str = "") -> Path:
        path = tmp_path / "paintlink.toml"
        path.write_text(CONFIG.format(folder=tmp_path, port=port.path, more=more))
        return path

    return write


def run(config: Path, *words: str) -> Result:
    return CliRunner().invoke(main, [*words, "--config", str(config)])


def document(result: Result) -> Any:
    return json.loads(result.stdout)


def test_calibration_is_remembered_and_shown(configure: Callable[..., Path]) -> None:
    config = configure()

    result = run(config, "calibrate", "bench", "--done")

    assert result.output == "bench: calibration unknown, noted\n"
    with Journal(config.parent / "state" / "journal.db") as journal:
        assert journal.bench.last_calibration("CHNSpec CR30 SIM0000001")


def test_reading_of_a_solid_goes_down_the_line(configure: Callable[..., Path]) -> None:
    config = configure()
    run(config, "calibrate", "bench", "--done")

    result = run(config, "measure", "bench", "--sample", "grey", "--json")

    assert result.exit_code == 0, result.output
    assert "Warning" not in result.stderr
    assert document(result)["state"] == "done"


def test_old_calibration_is_warned_of(configure: Callable[..., Path]) -> None:
    result = run(configure(), "measure", "bench")

    assert "Warning: no calibration is on record: run `paintlink cal" in result.stderr


def test_old_calibration_blocks_where_the_shop_wants_it(
    configure: Callable[..., Path],
) -> None:
    result = run(configure('calibration_policy = "block"'), "measure", "bench")

    assert result.exit_code == 4
    assert "no calibration is on record" in result.output


def test_single_angle_serves_solids_only(configure: Callable[..., Path]) -> None:
    result = run(configure(), "measure", "bench", "--finish", "metallic", "--dry-run")

    assert result.exit_code == 3
    assert "declare the paint solid" in result.output


def test_tile_is_checked_and_its_drift_shown(configure: Callable[..., Path]) -> None:
    config = configure()

    first = document(run(config, "tile", "check", "bench", "green", "--json"))
    second = document(run(config, "tile", "check", "bench", "green", "--json"))
    log = document(run(config, "tile", "log", "CHNSpec CR30 SIM0000001", "--json"))

    assert first[0]["verdict"] == "first"
    assert second[0]["verdict"] == "steady"
    assert 0.0 < second[0]["drift"]["45.0"] < 0.5
    assert log == [*first, *second]


def test_devices_show_state_and_kinds(configure: Callable[..., Path]) -> None:
    found = document(run(configure(), "devices", "--json"))

    assert found["instruments"][0]["last_state"] == "never run"
    assert found["instruments"][0]["text"] == "start the service with `paintlink run`"
    assert {one["driver"] for one in found["kinds"]} >= {"chn_cr30", "xrite_rci"}
    assert not any(one["hardware_tested"] for one in found["kinds"])


@pytest.fixture
def strip_reader(tmp_path: Path) -> Iterator[tuple[Path, Any]]:
    """A configuration with a DTP20 behind a USB/IP server, and the instrument."""
    instrument = simulator("xrite_rci", speed=20.0)
    config = tmp_path / "paintlink.toml"
    with UsbIpPort([UsbSocket(RciFunction(instrument))]) as port:
        text = CONFIG.replace("{port}", port.url()).replace("chn_cr30", "xrite_rci")
        config.write_text(text.format(folder=tmp_path, more=""))
        yield config, instrument


def test_stored_readings_are_taken_over_once(strip_reader: tuple[Path, Any]) -> None:
    config, _ = strip_reader
    for _ in range(2):
        run(config, "measure", "bench", "--json")

    averaged = document(run(config, "measure", "bench", "--readings", "2", "--json"))
    first = document(run(config, "measure", "bench", "--stored", "--json"))
    again = document(run(config, "measure", "bench", "--stored", "--clear", "--json"))
    cleared = document(run(config, "measure", "bench", "--stored", "--json"))

    assert averaged["state"] == "done"
    assert first == {"new": 0, "known": 4}
    assert again == first
    assert cleared == {"new": 0, "known": 0}


def test_readings_taken_without_us_are_new_once(
    strip_reader: tuple[Path, Any],
) -> None:
    config, instrument = strip_reader
    for _ in range(3):
        instrument.press()

    first = document(run(config, "measure", "bench", "--stored", "--json"))
    again = document(run(config, "measure", "bench", "--stored", "--json"))

    assert first == {"new": 3, "known": 0}
    assert again == {"new": 0, "known": 3}


def test_instrument_without_memory_says_so(configure: Callable[..., Path]) -> None:
    result = run(configure(), "measure", "bench", "--stored")

    assert result.exit_code == 4
    assert "CR30 keeps no readings: measure with it instead" in result.output
