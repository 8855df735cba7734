"""The peaks of a release as rows, and a release as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import pandas as pd

from pyjoystick.fmu import FmuDescription
from pyjoystick.model import JoystickParameters, parameter_list
from pyjoystick.motion import find_peaks
from pyjoystick.support import document_text


class ReleasePeak(NamedTuple):
    """A peak of the displacement.

    Attributes:
        time: its instant (s)
        theta: the displacement (rad)
        half_period: time since the peak before (s); NaN for the first one
    """

    time: float
    theta: float
    half_period: float


def release_peak_rows(run: pd.DataFrame) -> list[ReleasePeak]:
    """The peaks of the displacement in a run, in order; none in one that is too short.

    Args:
        run: as `free_oscillation` gives it
    """
    if len(run) < 3:
        return []
    peaks = find_peaks(run.index, run["theta"], run["omega"])
    return [
        ReleasePeak(*row) for row in zip(peaks["time"], peaks["value"], peaks["time"].diff(), strict=True)
    ]


def release_json(
    run: pd.DataFrame,
    fmu: FmuDescription,
    joystick: JoystickParameters,
    *,
    tolerance: float,
    trusted_until: float | None = None,
    notes: Sequence[str] = (),
) -> str:
    """A free oscillation as JSON text, in SI units: what was run, and its peaks.

    Args:
        run: as `free_oscillation` gives it
        fmu: the FMU
        joystick: the joystick that was released
        tolerance: of the FMU's integrator
        trusted_until: see `pyjoystick.forced_motion.trusted_until`; None where it was not asked for
        notes: what was noted on it
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
