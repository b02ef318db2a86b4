from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from paintlink.config import RouteSettings, SnapSettings
from paintlink.daemon.pipeline import match, open_routes, retry_delay_s, specify
from paintlink.errors import ReadingError
from paintlink.library import bundled
from paintlink.model import Geometry
from paintlink.spec import read_spec, write_spec
from tests.daemon.conftest import ANGLES, make_reading, make_spec


def route(name: str, *accept: str, enabled: bool = True) -> RouteSettings:
    return RouteSettings(
        name=name,
        folder=Path("/routes") / name,
        format="colornet",
        accept=accept,  # type: ignore[arg-type]
        enabled=enabled,
    )


def test_reading_becomes_specification_with_its_origin() -> None:
    spec = specify(make_reading(origin="simulated"))

    assert spec.name == "bonnet"
    assert spec.angles_deg == ANGLES
    assert spec.provenance is not None
    assert spec.provenance.origin == "simulated"
    assert spec.provenance.instrument.serial == "4711"


def test_control_characters_from_device_are_left_out() -> None:
    reading = make_reading()
    noisy = replace(
        reading,
        sample="door\x00\x1b[31m\ud800",
        instrument=replace(reading.instrument, serial="47\n11\x9f"),
    )

    spec = specify(noisy)

    assert spec.name == "door[31m"
    assert spec.provenance is not None
    assert spec.provenance.instrument.serial == "4711"
    assert read_spec(write_spec(spec)) == spec


def test_other_illumination_is_refused_by_name() -> None:
    reading = make_reading()
    geometries = tuple(Geometry(a, illumination_deg=15.0) for a in ANGLES)
    measurement = replace(reading.measurement, geometries=geometries)

    with pytest.raises(ReadingError, match="45"):
        specify(replace(reading, measurement=measurement))


def test_nearest_paint_becomes_the_starting_paint() -> None:
    spec, matches = match(make_spec(), bundled(), SnapSettings(top=4))

    assert len(matches) == 4
    assert spec.starting_paint is not None
    assert spec.starting_paint.code == matches[0].code
    assert spec.starting_paint.total == min(one.total for one in matches)


def test_simulated_reading_never_enters_a_usual_route() -> None:
    routes = [
        route("shop", "real"),
        route("test", "simulated"),
        route("both", "real", "simulated"),
    ]

    opened = open_routes(routes, "simulated")

    assert [one.name for one in opened] == ["test", "both"]


def test_disabled_route_gets_nothing() -> None:
    assert open_routes([route("off", "real", enabled=False)], "real") == []


def test_retry_delay_doubles_up_to_five_seconds() -> None:
    delays = [retry_delay_s(attempts) for attempts in (0, 1, 2, 8, 9, 5000)]

    assert delays == [1.0, 2.0, 4.0, 5.0, 5.0, 5.0]
