"""Periods over amplitudes: computed without damping, and seen in an oscillation that dies away."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pandas as pd

from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.undamped_period.closed_form import linearized_joystick
from pyjoystick.model.undamped_period.quadrature import undamped_oscillation
from pyjoystick.motion import periods
from pyjoystick.support import FloatArray

#: Segments of the path: the clearance, the steep ones of Table 1 (k_0, k_2), the soft ones (k_1, k_3).
CLEARANCE, STEEP, SOFT = (0,), (1, 3), (2, 4)


def period_table(parameters: JoystickParameters, release_angles: Iterable[float]) -> pd.DataFrame:
    """Undamped periods after releases at rest.

    Args:
        parameters: the joystick
        release_angles: angles of release (rad), positive forward

    Returns:
        one row a release, with the columns ``release`` (rad), ``amplitude`` (rad; the mean of the largest
        angles on both sides), ``period`` (s), ``linearized`` (s; in closed form, with linearized geometry),
        and ``clearance``, ``steep``, ``soft``: the parts of the period spent in such segments

    Raises:
        ParameterError, NoOscillationError: as `undamped_oscillation`
    """
    linearized = linearized_joystick(parameters)
    rows = []
    for release in release_angles:
        exact = undamped_oscillation(parameters, release)
        rows.append(
            {
                "release": release,
                "amplitude": 0.5 * (exact.forward + exact.backward),
                "period": exact.period,
                "linearized": linearized.oscillation(release).period,
                "clearance": exact.share(*CLEARANCE),
                "steep": exact.share(*STEEP),
                "soft": exact.share(*SOFT),
            }
        )
    return pd.DataFrame(rows)


def exponent(table: pd.DataFrame) -> FloatArray:
    """Slope of ln(period) over ln(amplitude) at each row of a table of rising amplitudes, shape (rows,).

    It is 0 for a linear spring and 1/2 where a constant force drives back, as for a ball that bounces.
    """
    slopes = np.gradient(np.log(table["period"].to_numpy()), np.log(table["amplitude"].to_numpy()))
    return np.asarray(slopes)


def decaying_periods(peaks: pd.DataFrame) -> pd.DataFrame:
    """Period and amplitude around each peak of an oscillation that dies away.

    Args:
        peaks: alternating peaks of the angle as `find_peaks` gives them

    Returns:
        ``amplitude`` (rad; the mean of the peak and its neighbors on the other side) and ``period`` (s)
    """
    heights = peaks["value"].abs().to_numpy()
    amplitude = 0.5 * heights[1:-1] + 0.25 * (heights[:-2] + heights[2:])
    return pd.DataFrame({"amplitude": amplitude, "period": periods(peaks)["period"].to_numpy()})
