"""`paintlink driver-test`, as the author of a driver runs it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from paintlink.cli import main

# A driver outside of paintlink that gets darker with every reading.
CARELESS = """
from paintlink_drivers import xrite_ma as sound
import dataclasses, itertools

COUNT = itertools.count(1)
INFO = dataclasses.replace(sound.INFO, id="careless")


def create(link, options):
    driver = sound.create(link, options)
    read = driver.measure

    def measure(prompt):
        reading = read(prompt)
        dark = reading.spectra.factors / next(COUNT)
        spectra = dataclasses.replace(reading.spectra, factors=dark)
        return dataclasses.replace(reading, spectra=spectra)

    driver.measure = measure
    return driver
"""


def run(*arguments: str) -> tuple[int, str]:
    result = CliRunner().invoke(main, ["driver-test", *arguments])
    return result.exit_code, result.output


def test_sound_driver_gets_a_table_and_0() -> None:
    code, output = run("xrite_ma", "--transport", "memory", "--fault", "late")

    assert code == 0
    assert "late" in output
    assert "24 readings, every one right or refused by name" in output


def test_json_has_every_answer() -> None:
    arguments = ("--transport", "memory", "--fault", "silent", "--json")
    code, output = run("km_cm512", *arguments)

    answers = json.loads(output)
    assert code == 0
    assert len(answers) == 24
    assert {one["verdict"] for one in answers} == {"refused"}
    assert answers[0]["text"].startswith("LinkTimeoutError: the instrument sent")


def test_careless_driver_of_somebody_else_ends_with_1(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "shop_drivers"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "careless.py").write_text(CARELESS)
    monkeypatch.syspath_prepend(tmp_path)

    code, output = run(
        "shop_drivers.careless",
        *("--simulator", "paintlink_simulators.xrite_ma"),
        *("--transport", "memory", "--fault", "late"),
    )

    assert code == 1
    assert "readings are wrong" in output
    assert "another reading under a harmless fault" in output


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["xrite_mb"], 2, "did you mean 'xrite_ma'"),
        (["xrite_ma", "--fault", "rain"], 2, "there is no fault 'rain'"),
        (["shop.nothing"], 2, "shop.nothing cannot be imported"),
    ],
)
def test_wrong_call_says_what_is_wrong(
    arguments: list[str], code: int, message: str
) -> None:
    assert run(*arguments)[0] == code
    assert message in run(*arguments)[1]
