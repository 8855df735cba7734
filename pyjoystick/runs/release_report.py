"""Reports on a release: the table of peaks, and JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd

from pyjoystick.fmu import FmuDescription
from pyjoystick.model import JoystickParameters, parameter_list
from pyjoystick.motion import find_peaks
from pyjoystick.support import document_text


class ReleasePeak(NamedTuple):
    """A peak of the displacement.

    Attributes:
        time: time of the peak (s)
        theta: displacement (rad)
        half_period: time since the previous peak (s), if that is on the other side; else NaN
    """

    time: float
    theta: float
    half_period: float


def release_peak_rows(run: pd.DataFrame) -> list[ReleasePeak]:
    """Peaks of the displacement in a run, in order; empty for a run that is too short.

    Args:
        run: from `free_oscillation`
    """
    if len(run) < 3:
        return []
    peaks = find_peaks(run.index, run["theta"], run["omega"])
    # Within the springs' clearance, a joystick may swing about a place beside the middle.
    changes_side = np.sign(peaks["value"]).diff() != 0.0
    half_periods = peaks["time"].diff().where(changes_side)
    return [ReleasePeak(*row) for row in zip(peaks["time"], peaks["value"], half_periods, strict=True)]


def release_json(
    run: pd.DataFrame,
    fmu: FmuDescription,
    joystick: JoystickParameters,
    *,
    tolerance: float,
    trusted_until: float | None = None,
    notes: Sequence[str] = (),
) -> str:
    """A free oscillation as JSON text, in SI units: settings and peaks.

    Args:
        run: from `free_oscillation`
        fmu: the FMU
        joystick: the joystick that was released
        tolerance: tolerance of the FMU's integrator
        trusted_until: see `pyjoystick.forced_motion.trusted_until`; None if not requested
        notes: notes on the run
    """
    content = {
        "fmu": fmu.identity,
        "parameters": parameter_list(joystick),
        "theta_start": float(run["theta"].iloc[0]),
        "duration": float(run.index[-1] - run.index[0]),
        "tolerance": tolerance,
        "peaks": [one._asdict() for one in release_peak_rows(run)],
    }
    if trusted_until is not None:
        content["trusted_until"] = trusted_until
    return document_text("free-oscillation", content, notes)
