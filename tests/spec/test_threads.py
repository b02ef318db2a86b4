from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

from paintlink.errors import SpecError
from paintlink.model import ColorSpec
from paintlink.spec import read_spec
from tests.spec.corpus import COMPLETE, Case
from tests.spec.refused_shapes import SHAPES
from tests.spec.refused_values import VALUES

GOOD = [Case(f"good {n}", COMPLETE.replace("Quartz", f"Quartz {n}")) for n in range(90)]
CASES = [case for pair in zip(GOOD, VALUES + SHAPES, strict=False) for case in pair]


def answer(case: Case) -> ColorSpec | str:
    try:
        return read_spec(case.data(), source=case.name)
    except SpecError as error:
        return str(error)


def test_eight_threads_get_the_answers_of_one() -> None:
    expected = [answer(case) for case in CASES]

    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(answer, CASES * 10))

    assert answers == expected * 10
    assert len({str(text) for text in expected}) == len(CASES)
