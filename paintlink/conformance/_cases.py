"""One question of the exam, and the answer to it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Verdict = Literal["reading", "as sent", "refused", "failed"]


@dataclass(frozen=True, slots=True)
class Case:
    """One reading under one fault.

    Parameters
    ----------
    fault
        Name of a fault or of a state of the device; empty for none.
    exchange
        How many answers are sound before the fault begins.
    chunk
        The most bytes one read returns; 0 for no limit.
    """

    driver: str
    transport: str = "memory"
    fault: str = ""
    exchange: int = 0
    chunk: int = 0

    def __str__(self) -> str:
        chunk = f", {self.chunk} bytes a read" if self.chunk else ""
        what = f"{self.fault} from answer {self.exchange}" if self.fault else "no fault"
        return f"{self.driver} over {self.transport}, {what}{chunk}"


@dataclass(frozen=True, slots=True)
class Result:
    """What became of a reading.

    Parameters
    ----------
    verdict
        ``reading``: the sound reading. ``as sent``: another one, which stands in the
        bytes the instrument sent as its protocol writes it, so that nobody could have
        noticed. ``refused``: an error with a name. ``failed``: anything else.
    text
        The error's class and words, or what is wrong with the reading.
    """

    case: Case
    verdict: Verdict
    text: str = ""
