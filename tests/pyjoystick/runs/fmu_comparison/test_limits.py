"""The largest allowed difference between runs."""

from __future__ import annotations

import math
from pathlib import Path

import pandas as pd
import pytest

from pyjoystick.fmu import read_description
from pyjoystick.runs.fmu_comparison.limits import angle_limit, relative_limits
from pyjoystick.support import ParameterError
from tests.pyjoystick.fmu.doctored import doctored


@pytest.mark.parametrize(
    ("largest", "tolerance", "factor", "limit"),
    [
        (0.5, 1e-8, 30.0, 1.5e-7),
        (0.5, 1e-4, 30.0, 1.5e-3),
        (0.01, 1e-8, 30.0, 3e-8),  # as if it were 0.1 rad, the nominal value
        (0.5, 1e-13, 30.0, 1e-9),  # the reference is no better
    ],
)
def test_the_limit_of_an_angle(largest: float, tolerance: float, factor: float, limit: float) -> None:
    theta = pd.Series([0.0, -largest, largest / 2.0])
    assert angle_limit(theta, tolerance, factor) == pytest.approx(limit)


def test_relative_limits(pair: Path, tmp_path: Path) -> None:
    def large(text: str) -> str:
        assert 'start="0.0" unit="N.s"' in text
        return text.replace('start="0.0" unit="N.s"', 'start="0.0" unit="N.s" nominal="-5e6"')

    ordinary = read_description(pair / "First.fmu")
    fmus = ordinary, read_description(doctored(ordinary.path, tmp_path / "large.fmu", description=large))
    tables = (
        pd.DataFrame({"x": [1.0, -3.0], "y": [0.0, 1e-9], "integral": [0.0, 1.0], "above": [True, False]}),
        pd.DataFrame(
            {"x": [2.0, math.nan], "y": [0.0, 0.0], "integral": [0.0, 1.0], "above": [False, False]}
        ),
    )
    limits = relative_limits(1e-3, tables, fmus)
    assert limits == pytest.approx({"x": 3e-3, "y": 1e-9, "integral": 5e-3, "above": 1e-3})
    for part in (0.0, -1.0, math.nan):
        with pytest.raises(ParameterError, match="relative_limit"):
            relative_limits(part, tables, fmus)
