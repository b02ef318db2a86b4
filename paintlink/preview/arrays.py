"""Single precision, for tables and planes of many values."""

import numpy as np
from numpy.typing import NDArray

Float32Array = NDArray[np.float32]
