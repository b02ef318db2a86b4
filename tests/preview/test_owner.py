from __future__ import annotations

import threading

import pytest

from paintlink.errors import PreviewError
from paintlink.preview.owner import Owner


def test_every_job_runs_in_the_one_thread() -> None:
    owner = Owner(threading.get_ident)

    seen = {owner.lend(lambda made: (made, threading.get_ident()), timeout_s=5)}
    seen |= {owner.lend(lambda made: (made, threading.get_ident()), timeout_s=5)}

    ((maker, worker),) = seen
    assert maker == worker != threading.get_ident()


def test_trouble_of_any_kind_is_told_every_time() -> None:
    def broken() -> int:
        raise Exception("requested device 0, found 0")

    owner = Owner(broken)

    for _ in range(2):
        with pytest.raises(PreviewError, match="requested device 0, found 0"):
            owner.lend(lambda made: made, timeout_s=5)


def test_failing_job_does_not_end_the_thread() -> None:
    owner = Owner(lambda: 0)

    with pytest.raises(PreviewError, match="by zero"):
        owner.lend(lambda made: 1 // made, timeout_s=5)

    assert owner.lend(lambda made: made + 1, timeout_s=5) == 1


def test_silent_error_is_told_by_its_kind() -> None:
    def fails(_: int) -> int:
        raise RuntimeError

    with pytest.raises(PreviewError, match="RuntimeError"):
        Owner(lambda: 0).lend(fails, timeout_s=5)


def test_hanging_owner_is_given_up_at_once_later() -> None:
    never = threading.Event()
    owner = Owner(never.wait)

    with pytest.raises(PreviewError, match=r"no answer within 0\.01 s"):
        owner.lend(lambda made: made, timeout_s=0.01)
    with pytest.raises(PreviewError, match="hangs since an earlier picture"):
        owner.lend(lambda made: made, timeout_s=60)

    never.set()
