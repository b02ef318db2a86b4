from __future__ import annotations

import re

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink_simulators.paint import TONERS, amounts, formula
from paintlink_simulators.paint.base import pigment_absorption, pigment_scattering
from paintlink_simulators.paint.flakes import FLAKES
from paintlink_simulators.paint.pigments import PIGMENTS
from paintlink_simulators.paint.toners import CODES


def test_bench_has_fifty_three_toners_with_their_own_codes() -> None:
    assert len(TONERS) == 53
    assert len(set(CODES)) == 53
    assert all(re.fullmatch(r"[A-Z]\d\d", code) for code in CODES)
    assert len({toner.name for toner in TONERS}) == 53


def test_white_scatters_one_at_550() -> None:
    white = CODES.index("W10")

    assert pigment_scattering()[white, 15] == 1.0


def test_every_pigment_absorbs_and_scatters_everywhere() -> None:
    assert pigment_absorption().min() > 0.0
    assert pigment_scattering().min() > 0.0
    assert pigment_absorption().shape == (len(PIGMENTS), 31)


def test_yellow_absorbs_blue_and_blue_absorbs_red() -> None:
    yellow = pigment_absorption()[CODES.index("Y30")]
    blue = pigment_absorption()[CODES.index("B71")]

    assert yellow[4] > 100 * yellow[20]
    assert blue[23] > 10 * blue[6]


def test_coarser_aluminium_covers_less_and_lies_flatter() -> None:
    lenticular = FLAKES[:4]

    assert np.all(np.diff([flake.diameter_um for flake in lenticular]) < 0)
    assert np.all(np.diff([flake.area for flake in lenticular]) > 0)
    assert np.all(np.diff([flake.spread_deg for flake in lenticular]) > 0)


def test_formulas_come_back_from_amounts() -> None:
    blue = {"A03": 30.0, "B71": 20.0, "N20": 0.5}

    assert formula(amounts([{"N20": 0.5, "B71": 20.0, "A03": 30.0}])[0]) == blue


def test_unknown_toner_is_refused_with_the_known_ones() -> None:
    with pytest.raises(InputError, match=r"no toner 'X99': its toners are W10, W11"):
        amounts([{"X99": 1.0}])
