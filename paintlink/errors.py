"""The exception tree: one class for each decision the program has to take.

The class says what the program does next, the attributes hold the values, the text
says what happened, where, and what the person at the instrument can do about it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple


class PaintlinkError(Exception):
    """Root of every expected error; shown without a traceback.

    ``exit_code`` is what the command line ends with.
    """

    exit_code = 1


class ConfigError(PaintlinkError):
    """Refuse to start: the configuration or the way the program was called is wrong."""

    exit_code = 2


class InputError(PaintlinkError):
    """Quarantine the input: a file or a value from outside cannot be used."""

    exit_code = 3


class SpecError(InputError):
    """A colour specification cannot be read or would not be valid.

    Parameters
    ----------
    what
        What is wrong and what to do next.
    source
        File the document came from, if any.
    line
        Line of the document, 1-based, if known.
    element
        Element or attribute the fault lies in, if known.
    value
        The offending value as it was found, if there is one.
    """

    def __init__(
        self,
        what: str,
        *,
        source: str | None = None,
        line: int | None = None,
        element: str | None = None,
        value: str | None = None,
    ) -> None:
        self.what = what
        self.source = source
        self.line = line
        self.element = element
        self.value = value
        super().__init__(what)

    def __str__(self) -> str:
        where = [self.source] if self.source else []
        where += [f"line {self.line}"] if self.line is not None else []
        where += [f"<{self.element}>"] if self.element else []
        value = f" (found {self.value!r})" if self.value is not None else ""
        place = ", ".join(where)
        return f"{place}: {self.what}{value}" if place else f"{self.what}{value}"


class ReadingError(InputError):
    """A reading holds values that no paint can have, or that do not fit together."""


class LibraryError(InputError):
    """A paint library cannot be read, or cannot answer the question."""


class IndexFileError(LibraryError):
    """Build the search index anew: a stored one is stale, damaged or something else."""


class Refusal(NamedTuple):
    """One thing in a file that is refused: its line or file name, and why."""

    place: int | str
    what: str

    def __str__(self) -> str:
        place = f"line {self.place}" if isinstance(self.place, int) else self.place
        return f"{place}: {self.what}"


class ImportRefusedError(LibraryError):
    """Leave the library as it is: some of what should go into it is refused.

    ``refusals`` stand in the order of the source; with ``stopped`` there may be more.
    """

    def __init__(
        self, source: str, refusals: Sequence[Refusal], *, stopped: bool = False
    ) -> None:
        self.source = source
        self.refusals = tuple(refusals)
        self.stopped = stopped
        count = f"{'at least ' if stopped else ''}{len(self.refusals)}"
        super().__init__(
            f"{source}: {count} refused, the library stays as it was; first "
            f"{self.refusals[0]}"
        )


class LibraryStoreError(PaintlinkError):
    """Leave the library as it is: what is stored cannot be read or written."""

    exit_code = 5


class DesignError(InputError):
    """A design cannot be read, or a step cannot be made with these values.

    Parameters
    ----------
    what
        What is wrong and what to do next.
    source
        File the design came from, if any.
    step, parameter
        Names of what was refused, if a step was.
    """

    def __init__(
        self,
        what: str,
        *,
        source: str | None = None,
        step: str | None = None,
        parameter: str | None = None,
    ) -> None:
        self.what = what
        self.source = source
        self.step = step
        self.parameter = parameter
        super().__init__(": ".join(filter(None, (source, step, what))))


class AnswerError(InputError):
    """An answer of formulation software cannot be read, or contradicts its job."""


class LinkError(PaintlinkError):
    """Reconnect: the connection to the instrument is gone or cannot be opened."""

    exit_code = 4


class LinkTimeoutError(LinkError):
    """Retry: the instrument did not answer in time.

    ``partial`` holds the bytes that did arrive.
    """

    def __init__(self, message: str, *, partial: bytes = b"") -> None:
        self.partial = partial
        super().__init__(message)


class ProtocolError(PaintlinkError):
    """Retry once: bytes arrived that the wire protocol does not allow.

    ``raw`` holds the bytes as they arrived.
    """

    exit_code = 4

    def __init__(self, message: str, *, raw: bytes = b"") -> None:
        self.raw = raw
        super().__init__(message)


class InstrumentError(PaintlinkError):
    """Tell the operator: the instrument answered, and refused.

    ``code`` holds the device's own code or text, verbatim.
    """

    exit_code = 4

    def __init__(self, message: str, *, code: str | None = None) -> None:
        self.code = code
        super().__init__(message)


class NeedsCalibrationError(InstrumentError):
    """Ask for a calibration before the next reading."""


class WrongInstrumentError(InstrumentError):
    """Try the next driver: something answered, but not this kind of instrument."""


class CancelledError(PaintlinkError):
    """Stop waiting: the operator or a shutdown ended the operation."""

    exit_code = 130


ExportFault = Literal[
    "format", "starting-paint", "name", "exists", "gone", "missing", "not-a-folder",
    "denied", "read-only", "full", "io",
]  # fmt: skip


class ExportError(PaintlinkError):
    """Keep the job and raise an alarm: a file could not be written or delivered.

    ``kind`` tells what a person can repair in the folder, after which a repeat works,
    from what no repeat cures: ``format``, ``starting-paint``, ``name``, ``exists``.
    """

    exit_code = 5

    def __init__(self, message: str, *, kind: ExportFault = "io") -> None:
        self.kind = kind
        super().__init__(message)


class PreviewError(PaintlinkError):
    """Keep the job, show no picture: a picture could not be drawn or written."""

    exit_code = 5


class JournalError(PaintlinkError):
    """Stop: the journal cannot be trusted or written, so nothing may be accepted."""

    exit_code = 6


class JournalFullError(JournalError):
    """Refuse and go on: the disk of the journal is full, and space may come back."""
