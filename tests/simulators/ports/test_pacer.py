from __future__ import annotations

from paintlink_simulators.ports._pacer import Pacer


def test_line_passes_a_character_per_ten_bits() -> None:
    pacer = Pacer(9600)
    pacer.start(100.0)

    assert pacer.allowance(100.0) == 0
    assert pacer.allowance(100.0 + 0.9 / 960) == 0
    assert pacer.allowance(100.0 + 4.5 / 960) == 4
    pacer.sent(4)
    assert pacer.allowance(100.0 + 4.5 / 960) == 0
    assert pacer.allowance(100.0 + 10.5 / 960) == 6


def test_idle_time_is_not_saved_up() -> None:
    pacer = Pacer(1200)
    pacer.start(0.0)
    pacer.sent(pacer.allowance(1.0))

    pacer.start(60.0)

    assert pacer.allowance(60.0 + 2.5 / 120) == 2


def test_without_baud_everything_passes() -> None:
    pacer = Pacer(None)
    pacer.start(0.0)
    pacer.sent(50000)

    assert pacer.allowance(0.0) > 50000
