"""Instrument parameters of a record: zero, scale, clock and delay."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    FitSettings,
    Free,
    Measurement,
    Uncertainty,
    driven,
    fit,
    read_fit_settings,
)
from pyjoystick.identification.fitting.problem.instrument import INSTRUMENT
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.model import NOMINAL, contact_moment, gravity_moment, simulate
from pyjoystick.support import ParameterError
from tests.pyjoystick.identification.fitting.made import releases

QUICK = dataclasses.replace(CONSTANT_DAMPING, uncertainty=Uncertainty(profiles=()))


def test_every_error_of_the_instrument_comes_back(fmus_by_name: Path) -> None:
    """Exact records of a known motion, shown with a zero, a scale and a clock that are off."""
    (record,) = releases(NOMINAL)
    shown = dataclasses.replace(
        record, theta=1.004 * record.theta + 0.01, time=record.time / 1.003, name="wrong"
    )
    free = (*QUICK.free, Free("angle_scale"), Free("time_base"))
    found = fit([shown], dataclasses.replace(QUICK, free=free))
    assert found.value("zero_offset [wrong]") == pytest.approx(0.01, rel=1e-4)
    assert found.value("angle_scale") == pytest.approx(0.004, rel=1e-3)
    assert found.value("time_base") == pytest.approx(0.003, rel=1e-3)
    assert found.value("damping.C") == pytest.approx(0.045, rel=1e-5)
    units = {one.name: one.unit for one in found.variables}
    assert (units["angle_scale"], units["time_base"], units["zero_offset"]) == ("", "", "rad")
    (zero,) = (check for check in found.checks if check.name == "zero offset")
    assert zero.passed
    assert "zero_offset [wrong] = 0.573 deg" in zero.message


@pytest.fixture(scope="module")
def hand() -> Measurement:
    """Pushes to and fro at 1 kHz, the angle 4 ms late; by the reference."""
    time = np.arange(1501) / 1000.0
    # All but at rest: of an exact balance the reference cannot tell which way it goes.
    hold = 1.0001 * float(contact_moment(NOMINAL, 0.1) - gravity_moment(NOMINAL, 0.1))
    torque = hold - (hold + 1.7) * np.clip((time - 0.2) / 0.1, 0.0, 1.0)
    torque += 3.4 * np.clip((time - 0.7) / 0.1, 0.0, 1.0)
    run = simulate(
        NOMINAL,
        time=time,
        theta_start=0.1,
        torque=lambda t: float(np.interp(t, time, torque)),
        torque_breakpoints=(0.2, 0.3, 0.7, 0.8),
    )
    noise = math.radians(0.02) * np.random.default_rng(2).standard_normal(len(time))
    return Measurement("hand", time, {"theta": np.interp(time - 0.004, time, run.theta) + noise, "T": torque})


def test_a_measured_torque_gives_inertia_damping_and_delay(fmus_by_name: Path, hand: Measurement) -> None:
    settings = dataclasses.replace(driven(CONSTANT_DAMPING), uncertainty=Uncertainty(profiles=()))
    found = fit([hand], settings)
    assert found.trusted, [check for check in found.checks if not check.passed]
    for name, truth in (("damping.C", 0.045), ("J", NOMINAL.J), ("delay", 0.004)):
        # Beyond four standard errors once in 16,000 fits; the seed is fixed.
        assert abs(found.value(name) - truth) < 4.0 * found.error(name) < 0.05 * truth


def test_a_delay_that_is_given_does_what_one_that_is_fitted_does(fmus_by_name: Path) -> None:
    """Before its origin a driven motion came along; 1.5 rad/s over a delay of 20 ms are 0.03 rad."""
    time = np.arange(200) * 1e-3
    record = Measurement("hand", time, {"theta": np.full(200, 0.05), "T": np.zeros(200)})
    fixed = {"theta_start": 0.05, "omega_start": 1.5}
    settings = FitSettings(fmu="Joystick", free=(Free("J"),), inputs=("T",), fixed={**fixed, "delay": 0.02})
    freed = dataclasses.replace(settings, free=(Free("J"), Free("delay", start=0.02)), fixed=fixed)
    shown = []
    with Fmu("Joystick") as fmu:
        for one in (settings, freed):
            problem = make_problem([record], one, fmu)
            x = problem.variables.start
            shown.append(problem.predictions(x)[0])
            curve = problem.predictors[0].curve(
                problem.variables.row(x, 0), problem.variables.instrument(x, 0)
            )
            assert curve["theta"].to_numpy() == pytest.approx(shown[-1], abs=1e-9)
    np.testing.assert_array_equal(*shown)
    assert shown[0][0] == pytest.approx(0.05 - 1.5 * 0.02, abs=1e-12)


def test_derivatives_are_those_of_the_prediction(fmus_by_name: Path, hand: Measurement) -> None:
    names = [name for name in INSTRUMENT if name not in ("release_time", "time_base")]
    free = (Free("damping.C"), *(Free(name, start=1e-3) for name in names))
    settings = FitSettings(
        fmu="Joystick", free=free, inputs=("T",), fixed={"theta_start": 0.1}, tolerance=1e-10
    )
    with Fmu("Joystick") as fmu:
        problem = make_problem([hand], settings, fmu)
        x = problem.variables.start
        (jacobian,) = problem.jacobians(x)
        for j, name in enumerate(names, start=1):
            moved = [x + sign * 1e-5 * np.eye(len(x))[j] for sign in (1.0, -1.0)]
            high, low = (problem.predictions(one)[0] for one in moved)
            # Where the motion begins, and at kinks, differences straddle the corner.
            error = np.abs((high - low) / 2e-5 - jacobian[:, j])
            assert np.quantile(error, 0.99) < 1e-3 * np.max(np.abs(jacobian[:, j])), name


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"free": (Free("damping.C"), Free("delay"))}, "left out where no input drives the FMU"),
        ({"free": (Free("J"), Free("time_base")), "inputs": ("T",)}, "left out where inputs drive the FMU"),
        ({"free": (Free("J"), Free("angle_scale")), "comparison": "peaks"}, "left out where peaks"),
        ({"free": (Free("J"),), "ties": {"zero_offset": "J"}}, "fixed or free, not tied"),
    ],
)
def test_what_does_not_go_together(changes: dict[str, object], words: str) -> None:
    with pytest.raises(ParameterError, match=words):
        FitSettings(fmu="Joystick", **changes)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("more", "free", "fixed"),
    [
        ("", {"zero_offset"}, {}),
        ('parameters.zero_offset = "0.5deg"', set(), {"zero_offset": pytest.approx(math.radians(0.5))}),
        ("free.zero_offset = { maximum = 0.1 }", {"zero_offset"}, {}),
    ],
)
def test_a_settings_file_frees_the_zero_of_each_record_unless_it_says_something(
    fmus_by_name: Path, tmp_path: Path, more: str, free: set[str], fixed: dict[str, float]
) -> None:
    path = tmp_path / "fit.toml"
    text = f'fmu.path = "Joystick"\n{more}\nfree.J = {{}}\nfree.release_time = {{ per_record = true }}\n'
    path.write_text(text)
    found = read_fit_settings(path)
    assert {one.name for one in found.free} - {"J", "release_time"} == free
    assert dict(found.fixed) == fixed
