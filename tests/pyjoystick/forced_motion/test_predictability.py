"""How long driven runs agree, against runs that differ only in tolerance."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.forced_motion import trusted_until
from pyjoystick.support import ParameterError

TIME = np.linspace(0.0, 6.0, 6001)


@pytest.fixture
def joystick(fmus_by_name: object) -> Iterator[Fmu]:
    with Fmu("Joystick") as fmu:
        yield fmu


def _torque(amplitude: float) -> pd.DataFrame:
    return pd.DataFrame({"T": amplitude * np.sin(8.0 * np.pi * TIME)}, index=TIME)


def test_a_chaotic_motion_can_be_trusted_as_long_as_tolerances_agree(joystick: Fmu) -> None:
    """1 N m at 4 Hz from rest: errors grow by some e^(6.6 t)."""
    torque = _torque(1.0)
    until = trusted_until(joystick, TIME, inputs=torque)
    assert 0.5 < until < 2.0
    loose, tight = (
        joystick.run(TIME, inputs=torque, outputs=["theta"], tolerance=tolerance)["theta"]
        for tolerance in (1e-8, 1e-10)
    )
    part = (loose - tight).abs() / loose.abs().max()
    assert part[: 0.8 * until].max() < 0.01
    assert part[2.0 * until :].max() > 0.3
    # A tenth of the tolerance is won in the logarithm only.
    assert until < trusted_until(joystick, TIME, inputs=torque, tolerance=1e-10) < 2.0 * until


def test_a_small_push_shows_until_when(joystick: Fmu) -> None:
    """Two starts 1e-9 rad apart, run far more accurately than that, part when the measure for 1e-9 says."""
    torque = _torque(1.0)
    first, second = (
        joystick.run(
            TIME, inputs=torque, parameters={"theta_start": start}, outputs=["theta"], tolerance=1e-13
        )
        for start in (0.0, 1e-9)
    )
    apart = (second["theta"] - first["theta"]).abs() > 0.01 * first["theta"].abs().max()
    parted = float(apart.idxmax())
    assert trusted_until(joystick, TIME, inputs=torque, tolerance=1e-9) == pytest.approx(parted, abs=0.05)
    assert apart.any()


def test_a_motion_that_forgets_its_start_can_be_trusted(joystick: Fmu) -> None:
    """The same frequency at large amplitude, where the motion becomes periodic; and no torque at all."""
    start = math.radians(-20.0)
    assert trusted_until(joystick, TIME, theta_start=start, inputs=_torque(0.6)) == math.inf
    assert trusted_until(joystick, TIME, theta_start=start) == math.inf


def test_without_a_motion_there_is_nothing_to_trust(joystick: Fmu) -> None:
    with pytest.raises(ParameterError, match="such as move the joystick"):
        trusted_until(joystick, TIME, inputs={"T": 0.0})
    with pytest.raises(ParameterError, match="tolerance"):
        trusted_until(joystick, TIME, tolerance=0.0)
