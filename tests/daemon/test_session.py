from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from paintlink.config import InstrumentSettings
from paintlink.daemon.session import Session
from paintlink_simulators import Panel, PtyPort
from tests.daemon.instrument_bench import panel, simulator


class Hand:
    """An operator who slips to darker places; ``slips`` is how dark, by reading."""

    def __init__(self, instrument: Any, slips: dict[int, float]) -> None:
        self.instrument = instrument
        self.slips = slips
        self.sentences: list[str] = []

    def __call__(self, sentence: str) -> None:
        raise AssertionError(sentence)

    def confirm(self, sentence: str) -> None:
        self.sentences.append(sentence)
        level = self.slips.get(len(self.sentences), 1.0)
        grey = panel()
        self.instrument.panel = Panel(
            np.array([15.0, 25.0, 45.0, 75.0, 110.0]),
            np.full((5, 31), 0.4 * level) * np.linspace(0.9, 1.1, 31),
            grey.name,
        )


def read(slips: dict[int, float]) -> tuple[Any, list[str]]:
    instrument = simulator("chn_cr30", speed=20.0)
    hand = Hand(instrument, slips)
    with PtyPort(instrument) as port:
        settings = InstrumentSettings(
            name="bench", driver="chn_cr30", port=port.path, readings=3
        )
        with Session(settings) as session:
            reading = session.read("grey", hand)
    return reading.measurement, hand.sentences


def test_readings_that_agree_are_enough() -> None:
    measured, sentences = read({})

    assert [sentence[:16] for sentence in sentences] == [
        *("reading 1 of 3: ", "reading 2 of 3: ", "reading 3 of 3: "),
    ]
    assert measured.averaged == 3
    assert max(measured.spread) < 0.5


@pytest.mark.parametrize("slip", [1, 2, 3])
def test_slip_costs_one_more_reading_and_is_left_out(slip: int) -> None:
    measured, sentences = read({slip: 0.5})

    assert len(sentences) == 4
    assert sentences[3].startswith("the readings differ by dE ")
    assert "take one more. Set the instrument" in sentences[3]
    assert measured.averaged == 3
    assert max(measured.spread) < 0.5


def test_hand_that_slips_always_is_given_up_with_its_spread() -> None:
    measured, sentences = read({2: 0.7, 3: 0.5, 4: 0.35, 5: 0.25})

    assert len(sentences) == 5
    assert measured.averaged == 3
    assert max(measured.spread) > 1.0


def test_reading_is_whole_although_the_instrument_left_right_after(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with PtyPort(simulator("km_cm512", speed=20.0)) as port:
        settings = InstrumentSettings(
            name="bench", driver="km_cm512", port=port.path, readings=1
        )
        with Session(settings) as session:
            measure = session._measure

            def then_gone(prompt: Any) -> Any:
                measured = measure(prompt)
                port.unplug()
                return measured

            monkeypatch.setattr(session, "_measure", then_gone)
            reading = session.read("grey", lambda _sentence: None)

    assert reading.calibration.state == "unknown"
    assert reading.measurement.averaged == 1
