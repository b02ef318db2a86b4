"""What went over the line, question by question, and what it says."""

from __future__ import annotations

from typing import Any

import numpy as np

from paintlink.instrument import Direction
from paintlink.model import FloatArray


class Exchanges:
    """Questions and what came after each; give `tap` to a link."""

    def __init__(self) -> None:
        self.pairs: list[tuple[bytes, bytes]] = [(b"", b"")]

    def tap(self, direction: Direction, data: bytes) -> None:
        """Take note of one run of bytes."""
        if direction == "sent":
            self.pairs.append((data, b""))
        elif direction == "received":
            sent, received = self.pairs[-1]
            self.pairs[-1] = sent, received + data

    def tell(self, subject: Any, got: FloatArray, sound: FloatArray) -> bool:
        """Whether the bytes say what a reading holds beyond the sound one.

        The simulator's module reads them with a grammar of its own, written from the
        wire document and not from the driver: ``spectra(exchanges)``, in factors.
        """
        spectra = getattr(subject.simulator, "spectra", None)
        if spectra is None:
            return False
        written = list(spectra(self.pairs))
        return all(
            any(np.allclose(row, one, atol=1e-9) for one in [*written, *sound])
            for row in got
        )
