"""The exam notices what it is there to notice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from paintlink.conformance import Case, Subject, examine, subject
from paintlink.conformance.exam import clean_reading
from paintlink.errors import ConfigError, ProtocolError


class Altered:
    """The driver of the MA family with another way to measure."""

    def __init__(self, sound: Any, measure: Callable[[Any], Any]) -> None:
        self.INFO = sound.INFO
        self._sound = sound
        self._measure = measure

    def create(self, link: object, options: object) -> Any:
        driver = self._sound.create(link, options)
        read = driver.measure
        driver.measure = lambda prompt: self._measure(lambda: read(prompt))
        return driver


def altered(measure: Callable[[Any], Any]) -> Subject:
    sound = subject("xrite_ma")
    return replace(sound, driver=Altered(sound.driver, measure))


def test_a_sound_driver_passes() -> None:
    assert examine(subject("xrite_ma"), Case("xrite_ma")).verdict == "reading"


def test_a_reading_that_was_never_sent_fails() -> None:
    calls = iter(range(2))

    def doubled_the_second_time(read: Callable[[], Any]) -> Any:
        reading = read()
        factors = reading.spectra.factors * (1.0 + next(calls))
        return replace(reading, spectra=replace(reading.spectra, factors=factors))

    cheat = altered(doubled_the_second_time)
    clean_reading(cheat)

    result = examine(cheat, Case("xrite_ma", fault="duplicate_frame"))

    assert result.verdict == "failed"
    assert result.text == "a reading that was never sent"


@pytest.mark.parametrize("fault", ["late", "echo_on", ""])
def test_refusing_what_is_harmless_fails(fault: str) -> None:
    def refuse(read: Callable[[], Any]) -> Any:
        raise ProtocolError("never")

    result = examine(altered(refuse), Case("xrite_ma", fault=fault))

    assert result.verdict == "failed"
    assert result.text == "ProtocolError: never"


def test_a_crash_fails_and_says_what_crashed() -> None:
    def crash(read: Callable[[], Any]) -> Any:
        return [read()][1]

    result = examine(altered(crash), Case("xrite_ma"))

    assert result.verdict == "failed"
    assert result.text.startswith("IndexError")


@pytest.mark.parametrize(
    ("name", "simulator", "message"),
    [
        ("xrite_mb", None, "unknown driver 'xrite_mb', did you mean 'xrite_ma'"),
        ("no.such.driver", None, "no.such.driver cannot be imported"),
        ("json.tool", None, "json.tool is no driver: it needs INFO"),
        ("xrite_ma", "no.such", "no.such cannot be imported"),
    ],
)
def test_wrong_names_say_what_is_wrong(
    name: str, simulator: str | None, message: str
) -> None:
    with pytest.raises(ConfigError, match=message):
        subject(name, simulator)
