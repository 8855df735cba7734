"""The period of an oscillation whose amplitude falls."""

from __future__ import annotations

import numpy as np
import pandas as pd


def periods(peaks: pd.DataFrame, *, release_time: float | None = None) -> pd.DataFrame:
    """The period around each peak: the time from the peak before it, on the other side, to the peak after it.

    Args:
        peaks: alternating peaks as `find_peaks` gives them
        release_time: instant (s) at which the oscillation was released from rest, which then stands for the
            peak before the first one

    Returns:
        one row a peak that has neighbors on both sides: ``time`` (s) and ``amplitude`` (magnitude of the
        peak), ``period`` (s)
    """
    times, values = peaks["time"].to_numpy(), np.abs(peaks["value"].to_numpy())
    if release_time is None:
        middle = slice(1, -1)
    else:
        times, middle = np.insert(times, 0, release_time), slice(0, -1)
    spans = times[2:] - times[:-2]
    return pd.DataFrame({"time": times[1:-1], "amplitude": values[middle][: len(spans)], "period": spans})
