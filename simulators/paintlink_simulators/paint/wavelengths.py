"""The wavelengths at which virtual paint is computed."""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray

WAVELENGTHS_NM: FloatArray = np.arange(400.0, 701.0, 10.0)
"""400 to 700 nm in steps of 10 nm, shape (31,)."""
WAVELENGTHS_NM.setflags(write=False)
