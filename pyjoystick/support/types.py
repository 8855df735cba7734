"""Type aliases used throughout the package."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

#: A NumPy array of float64; docstrings give the shape.
FloatArray = NDArray[np.float64]
#: Torque about the pivot (N m) as a function of time (s).
Torque = Callable[[float], float]
