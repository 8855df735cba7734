"""The table of peaks of a release."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick import Fmu, free_oscillation
from pyjoystick.runs.release_report import release_peak_rows


def test_turns_on_one_side_are_no_half_period_apart(joystick_fmus: Path) -> None:
    """Within the springs' clearance, gravity moves the rest aside: 0.1 degrees swing about 0.18."""
    for degrees, sides in ((0.1, 1), (-20.0, 2)):
        with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
            run = free_oscillation(math.radians(degrees), fmu=fmu, duration=1.5)
        rows = release_peak_rows(run)[:8]
        assert len({math.copysign(1.0, one.theta) for one in rows}) == sides
        assert math.isnan(rows[0].half_period)
        expected = np.diff([one.time for one in rows]) if sides == 2 else np.full(len(rows) - 1, math.nan)
        assert [one.half_period for one in rows[1:]] == pytest.approx(expected, nan_ok=True)
