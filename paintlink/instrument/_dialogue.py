"""Questions and answers in lines of text."""

from __future__ import annotations

import re

from paintlink.errors import InstrumentError, LinkTimeoutError
from paintlink.instrument._link import Link
from paintlink.instrument._text import quoted

# Bounds an instrument that chatters without ever giving the answer.
_ANSWER_LINES = 10


def ask(
    link: Link,
    command: str,
    expected: str,
    *,
    timeout_s: float = 2.0,
    more_s: float = 0.5,
    refusal: type[InstrumentError] = InstrumentError,
) -> re.Match[str]:
    """Return how the answer to ``command`` + CR matches ``expected``.

    The answer is as many lines as it takes, joined by blanks. What came before the
    command is dropped, an echo of it is skipped.

    Parameters
    ----------
    expected
        Pattern to be found anywhere in the answer.
    timeout_s
        Time for the first line.
    more_s
        Time for each further line while the pattern is not found.
    refusal
        What to raise, with the text as ``code``, when the pattern never comes.

    Raises
    ------
    InstrumentError
        Or ``refusal``: the instrument answered something else.
    LinkTimeoutError
        When nothing comes.
    """
    link.discard()
    link.send(command.encode("ascii") + b"\r")
    answer = ""
    for _ in range(_ANSWER_LINES):
        try:
            line = link.read_line(more_s if answer else timeout_s)
        except LinkTimeoutError:
            if not answer:
                raise
            break
        if line != command:
            answer = f"{answer} {line}".lstrip()
        if match := re.search(expected, answer):
            return match
    msg = (
        f"the instrument answered {quoted(answer)} to {command!r}, expected "
        f"{expected!r}: look at its display and try again"
    )
    raise refusal(msg, code=answer)
