"""A captured session with any instrument gives the same readings again, bit for bit."""

import json
from datetime import UTC, datetime

import pytest

from paintlink.cli.replay import command as replay_command
from paintlink.instrument import Link, drivers, load_driver
from paintlink.links import CaptureWriter, read_capture, replay
from paintlink_simulators import ManualClock, MemoryPort, Operator
from tests.daemon.instrument_bench import panel, simulator_module


@pytest.fixture(params=sorted(drivers()))
def session(request, tmp_path):
    """Return the capture of a whole session with one simulated instrument."""
    driver_id, clock, path = request.param, ManualClock(), tmp_path / "session.jsonl"
    simulator = simulator_module(driver_id).create(panel(), clock=clock, seed=5)
    port = MemoryPort(Operator(simulator, 0.2), clock, chunk_bytes=7)
    writer = CaptureWriter(
        path, driver=driver_id, options={}, started_at=datetime.now(UTC), clock=clock
    )
    link = Link(port, clock=clock, tap=writer.tap)
    driver = load_driver(driver_id).create(link, {})
    readings = []
    for verb in ("identify", "calibration", "measure", "measure", "calibration"):
        writer.call(verb)
        call = getattr(driver, verb)
        value = call(lambda _sentence: None) if verb == "measure" else call()
        readings += [value] if verb == "measure" else []
    writer.close()
    return path, readings


def test_replay_gives_every_reading_bit_for_bit(session):
    path, readings = session
    capture = read_capture(path)

    outcomes = list(replay(capture, load_driver(capture.driver)))

    again = [one.value for one in outcomes if one.verb == "measure"]
    assert not any(one.error for one in outcomes)
    for old, new in zip(readings, again, strict=True):
        assert new.raw == old.raw
        assert new.geometries == old.geometries
        assert new.spectra.factors.tobytes() == old.spectra.factors.tobytes()


def test_command_shows_the_same_numbers(session, capsys):
    path, readings = session

    replay_command.main([str(path), "--json"], standalone_mode=False)

    shown = json.loads(capsys.readouterr().out)
    factors = [one["value"]["factors"] for one in shown if one["call"] == "measure"]
    assert factors == [one.spectra.factors.tolist() for one in readings]
