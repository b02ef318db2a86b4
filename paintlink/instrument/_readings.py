"""Checks and parsing that every driver of a spectral instrument needs."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from paintlink.errors import InstrumentError, LinkTimeoutError, ProtocolError
from paintlink.instrument._text import quoted
from paintlink.model import FloatArray, Geometry, Measurement, Spectra

# Effect paints reach a few hundred percent near the mirror angle; a dark panel's noise
# goes below zero. What lies further out is a damaged transmission.
PLAUSIBLE_FACTORS = (-0.1, 10.0)

BANDS_NM = np.arange(400.0, 701.0, 10.0)
BANDS_NM.setflags(write=False)
"""The 31 wavelengths most instruments of the trade measure."""

_DECIMAL = re.compile(rb"[-+]?\d+(?:\.\d+)?")


class ReadingCheck:
    """Refuses what is no new reading; one for each session with an instrument."""

    def __init__(self) -> None:
        self._last: FloatArray = np.empty((0, 0))

    def admit(
        self,
        geometries: tuple[Geometry, ...],
        wavelengths_nm: FloatArray,
        factors: FloatArray,
        raw: bytes,
    ) -> Measurement:
        """Return a reading that can be what the instrument saw just now.

        Parameters
        ----------
        factors
            Reflectance factors, shape (geometries, bands).
        raw
            The bytes they were read from.

        Raises
        ------
        ProtocolError
            When a factor is impossible, or when two geometries hold the same values: an
            answer arrived twice and pushed the others out of their places.
        InstrumentError
            When a geometry holds no reading, or when nothing changed since the last
            one: noise makes equal readings impossible, so the instrument took none and
            sent its memory. Only the operator can repeat it: no ``ProtocolError``.
        """
        low, high = PLAUSIBLE_FACTORS
        if not np.all((factors >= low) & (factors <= high)):
            msg = (
                f"the instrument sent reflectance factors outside {100 * low:g} to "
                f"{100 * high:g} %: check the cable and measure again"
            )
            raise ProtocolError(msg, raw=raw)
        if not factors.any(axis=1).all():
            msg = "the instrument's memory holds no reading: measure again"
            raise InstrumentError(msg)
        if len(np.unique(factors, axis=0)) < len(factors):
            msg = "two geometries hold the same values: measure again"
            raise ProtocolError(msg, raw=raw)
        if np.array_equal(factors, self._last):
            msg = (
                "the instrument sent its previous reading once more: set it on the "
                "panel and measure again"
            )
            raise InstrumentError(msg)
        self._last = factors
        return Measurement(geometries, Spectra(wavelengths_nm, factors), raw=raw)


@contextmanager
def complete(what: str) -> Iterator[None]:
    """Turn a frame that stopped half-way into ``ProtocolError``; silence stays silence.

    Parameters
    ----------
    what
        Name of the frame for the message.
    """
    try:
        yield
    except LinkTimeoutError as silence:
        if not silence.partial.strip():
            raise
        msg = f"the {what} stopped after {len(silence.partial)} bytes: measure again"
        raise ProtocolError(msg, raw=silence.partial) from silence


def parse_band_rows(
    report: bytes, wavelengths_nm: FloatArray, columns: Sequence[int]
) -> FloatArray:
    """Return the wanted columns of a printed table, shape (columns, bands).

    Parameters
    ----------
    report
        Lines of blank-separated tokens. The rows that begin with a wavelength and reach
        to the last wanted column count, everything else is heading.
    wavelengths_nm
        The rows that must be there, once each, in this order.
    columns
        Token numbers; the wavelength is token 0.

    Raises
    ------
    ProtocolError
        When a row is missing, doubled or out of order, or a token is not a number.
    """
    bands = [f"{wavelength:g}".encode() for wavelength in wavelengths_nm]
    rows = [line.split() for line in report.splitlines()]
    rows = [row for row in rows if len(row) > max(columns) and row[0] in bands]
    if [row[0] for row in rows] != bands:
        msg = (
            f"the report has {len(rows)} usable rows, expected {len(bands)} from "
            f"{bands[0].decode()} to {bands[-1].decode()} nm with {max(columns)} "
            "numbers each: check the column numbers and measure again"
        )
        raise ProtocolError(msg, raw=report)
    wanted = [[row[column] for column in columns] for row in rows]
    for token in (token for row in wanted for token in row):
        if not _DECIMAL.fullmatch(token):
            msg = f"the report holds {quoted(token)} in place of a number"
            raise ProtocolError(msg, raw=report)
    return np.array(wanted, dtype=np.float64).T
