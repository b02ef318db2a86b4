"""Six-angle spectra to Lab: paintlink against six calls of colour-science, in one run.

Run ``python benchmarks/spectra_to_lab.py``. Every call takes fresh spectra, as an
instrument sends them; colour-science would answer repeated ones from its cache.
Validation is part of our time; building its spectra is not part of theirs. The two take
turns in blocks, so that load from elsewhere meets both, and each block is long enough
to find its own code in the processor's cache.
"""

from __future__ import annotations

import statistics
import sys
import time
import warnings
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.color import reflectance_to_lab, white

warnings.simplefilter("ignore")
import colour  # noqa: E402 (it warns while it is imported)

BLOCKS = 10
READINGS = 1000
BAR = 200.0
WAVELENGTHS_NM = np.arange(400.0, 701.0, 10.0)
CMFS = colour.MSDS_CMFS["CIE 1964 10 Degree Standard Observer"]
D65 = colour.SDS_ILLUMINANTS["D65"]
WHITE_XY = colour.XYZ_to_xy(white("D65", "10"))

Array = NDArray[np.float64]


def ours(factors: Array) -> Array:
    """Lab of six spectra by paintlink."""
    return reflectance_to_lab(WAVELENGTHS_NM, factors)


def theirs(spectra: list[Any]) -> Array:
    """Lab of six spectra by colour-science, ASTM E308."""
    xyz = [colour.sd_to_XYZ(spectrum, CMFS, D65) for spectrum in spectra]
    return np.asarray(colour.XYZ_to_Lab(np.array(xyz) / 100.0, WHITE_XY))


def timed(convert: Callable[[Any], Array], readings: Iterable[Any]) -> list[float]:
    """Seconds of each conversion."""
    seconds = []
    for reading in readings:
        start = time.perf_counter()
        convert(reading)
        seconds.append(time.perf_counter() - start)
    return seconds


def main() -> int:
    """Print both medians and their ratio; 1 when the bar is missed."""
    rng = np.random.default_rng(1)
    our_s, their_s, apart = [], [], 0.0
    for _ in range(BLOCKS):
        readings = rng.uniform(0.0, 1.5, (READINGS, 6, 31))
        spectra = [
            [colour.SpectralDistribution(row, WAVELENGTHS_NM) for row in factors]
            for factors in readings[:20]
        ]
        their_s += timed(theirs, spectra)
        our_s += timed(ours, readings)
        apart = max(apart, np.abs(ours(readings[0]) - theirs(spectra[0])).max())
    ratio = statistics.median(their_s) / statistics.median(our_s)
    print(f"paintlink       {statistics.median(our_s) * 1e6:9.1f} µs")
    print(f"colour-science  {statistics.median(their_s) * 1e6:9.1f} µs")
    print(f"Lab apart by at most {apart:.0e}")
    print(f"ratio 1/{ratio:.0f}, bar 1/{BAR:.0f}")
    return 0 if ratio >= BAR else 1


if __name__ == "__main__":
    sys.exit(main())
