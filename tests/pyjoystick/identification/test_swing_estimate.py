"""Where a fit begins whose joystick is nothing like the one of its file: J and C as the swings show them."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    RELEASE,
    FitSettings,
    Free,
    Uncertainty,
    fit,
    swing_estimate,
    with_estimated_starts,
    with_values,
)
from pyjoystick.laboratory import synthetic_record
from pyjoystick.model import NOMINAL, ActuatorAssembly, JoystickParameters
from pyjoystick.motion import Record
from pyjoystick.support import ParameterError


def _lever() -> JoystickParameters:
    """A lever that one needs an arm for: 13 times the paper's moment of inertia, 18 times its damping."""
    forward = ActuatorAssembly.from_table((1.1e-4, 3.1e-4, 6.1e-3, 6.135e-3), (1.3e6, 9e3, 2.6e6, 2.1e4))
    backward = ActuatorAssembly.from_table((0.9e-4, 2.7e-4, 6.4e-3, 6.43e-3), (1.5e6, 7.2e3, 2.9e6, 1.65e4))
    values = {"m": 3.4, "h": 0.17, "J": 0.145, "a": 0.052, "b": 0.011, "damping.C": 0.8}
    return dataclasses.replace(NOMINAL.replace(values), forward=forward, backward=backward)


def _stick() -> JoystickParameters:
    """A stick for a thumb: a hundredth of the paper's moment of inertia."""
    forward = ActuatorAssembly.from_table((4e-5, 9e-5, 6e-4, 6.07e-4), (9e4, 700.0, 1.6e5, 1.5e3))
    backward = ActuatorAssembly.from_table((5e-5, 1.1e-4, 6.6e-4, 6.68e-4), (1.1e5, 520.0, 2.1e5, 1.25e3))
    values = {"m": 0.06, "h": 0.028, "J": 7.5e-5, "a": 0.008, "b": 0.0016, "damping.C": 2.6e-4}
    return dataclasses.replace(NOMINAL.replace(values), forward=forward, backward=backward)


LEVER, STICK = _lever(), _stick()


def _records(joystick: JoystickParameters, rate: float, duration: float, *angles: float) -> list[Record]:
    return [
        synthetic_record(
            joystick,
            release_angle=math.radians(one),
            random=np.random.default_rng(k),
            release_time=0.1,
            duration=duration,
            rate=rate,
            name=f"run {k}",
        )
        for k, one in enumerate(angles)
    ]


@pytest.mark.parametrize(
    ("joystick", "rate", "duration"), [(LEVER, 100.0, 2.5), (STICK, 500.0, 0.7), (NOMINAL, 60.0, 1.7)]
)
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_swings_show_inertia_and_damping(
    joystick: JoystickParameters, rate: float, duration: float, side: float
) -> None:
    """Whatever J and C the joystick is said to have; half a sample is 3 % of the shortest swings here."""
    records = _records(joystick, rate, duration, 18.0 * side, 17.0 * side)
    found = swing_estimate(joystick.replace({"J": 0.01135, "damping.C": 0.045}), records)
    assert found is not None
    assert pytest.approx(joystick.J, rel=0.1) == found.J
    assert pytest.approx(joystick.to_names()["damping.C"], rel=0.2) == found.C


def test_dry_friction_that_is_known_is_no_damping() -> None:
    rubbing = NOMINAL.replace({"friction.T_c": 0.02})
    found = swing_estimate(rubbing, _records(rubbing, 200.0, 1.7, -18.0, -17.0))
    assert found is not None
    assert pytest.approx(0.045, rel=0.2) == found.C


def test_without_swings_there_is_no_estimate() -> None:
    time = np.arange(100) / 100.0
    assert swing_estimate(NOMINAL, [Record("still", time, np.full(100, 0.1))]) is None


def test_a_start_that_is_near_stays() -> None:
    settings = with_values(CONSTANT_DAMPING, NOMINAL.to_names(), replace_starts=True)
    records = _records(NOMINAL, 60.0, 1.7, -18.0)
    assert with_estimated_starts(settings, NOMINAL.replace({"damping.C": 0.07}), records) == settings


def test_what_was_measured_before_stays() -> None:
    measured = Free("J", start=0.01135, uncertainty=1e-5)
    settings = FitSettings(fmu="Joystick", free=(measured, *RELEASE))
    records = _records(LEVER, 100.0, 2.5, -18.0)
    assert with_estimated_starts(settings, LEVER.replace({"J": 0.01135}), records) == settings


def test_the_bounds_of_the_usual_fit_hold_for_no_other_joystick() -> None:
    """C = 0.8 is beyond the 0.5 within which the paper's is sought."""
    found = with_values(CONSTANT_DAMPING, LEVER.to_names(), replace_starts=True)
    assert found.free[0].start == 0.8
    assert found.free[0].maximum == 8.0
    with pytest.raises(ParameterError, match=r"damping\.C"):
        with_values(
            dataclasses.replace(CONSTANT_DAMPING, free=(Free("damping.C", maximum=0.5), *RELEASE)),
            LEVER.to_names(),
        )


@pytest.mark.parametrize(("joystick", "rate", "duration"), [(LEVER, 100.0, 2.5), (STICK, 1000.0, 0.7)])
def test_a_fit_that_begins_at_the_paper_s_joystick_finds_another(
    joystick: JoystickParameters, rate: float, duration: float, joystick_fmus: Path
) -> None:
    begun = joystick.replace({"J": NOMINAL.J, "damping.C": 0.045})
    records = _records(joystick, rate, duration, -18.5, -18.0, -17.5)
    free = (Free("J"), Free("damping.C", minimum=0.0), *RELEASE)
    settings = FitSettings(fmu="Joystick", free=free, uncertainty=Uncertainty(profiles=()))
    settings = with_estimated_starts(with_values(settings, begun.to_names()), begun, records)
    with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
        found = fit(records, settings, fmu=fmu)
    assert found.trusted, found.failed
    for name in ("J", "damping.C"):
        assert abs(found.value(name) - joystick.to_names()[name]) < 4.0 * found.error(name)
