"""A sine as an input table, which FMUs interpolate linearly."""

from __future__ import annotations

from typing import Final

import numpy as np
import pandas as pd

#: Rows per period. A piecewise linear sine divided by sinc^2 has exactly the fundamental of the sine; the
#: rest moves the state after a period by 3e-11 rad and 2e-9 rad/s (0.6 N m at 4 Hz), and decreases with the
#: fourth power of this number.
ROWS: Final = 512


def sine_table(name: str, amplitude: float, frequency: float, periods: int) -> pd.DataFrame:
    """Make a table of the input amplitude*sin(2*pi*frequency*time) from time 0.

    Args:
        name: name of the input, the only column
        amplitude: in the input's unit
        frequency: Hz
        periods: number of periods

    Returns:
        a table indexed by time (s) with `ROWS` rows per period and one more
    """
    rows = np.arange(periods * ROWS + 1)
    sine = np.sin(2.0 * np.pi * (rows % ROWS) / ROWS) / np.sinc(1.0 / ROWS) ** 2
    return pd.DataFrame({name: amplitude * sine}, index=rows / (ROWS * frequency))
