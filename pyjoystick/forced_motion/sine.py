"""A sine as an input table, of which the FMU follows the straight lines between the rows."""

from __future__ import annotations

from typing import Final

import numpy as np
import pandas as pd

#: Rows in a period. Straight lines between samples of a sine, divided by sinc^2, have its fundamental
#: exactly; what is left moves the state after a period by 3e-11 rad and 2e-9 rad/s (0.6 N m at 4 Hz), and
#: falls with the fourth power of the number.
ROWS: Final = 512


def sine_table(name: str, amplitude: float, frequency: float, periods: int) -> pd.DataFrame:
    """The input amplitude*sin(2*pi*frequency*time) from the time 0 on.

    Args:
        name: of the input, the only column
        amplitude: in the input's unit
        frequency: Hz
        periods: how many

    Returns:
        a table indexed by the time (s) with `ROWS` rows a period and one more
    """
    rows = np.arange(periods * ROWS + 1)
    sine = np.sin(2.0 * np.pi * (rows % ROWS) / ROWS) / np.sinc(1.0 / ROWS) ** 2
    return pd.DataFrame({name: amplitude * sine}, index=rows / (ROWS * frequency))
