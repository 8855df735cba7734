"""Co-simulation and model exchange against the reference, for 25 random joysticks of each damping law."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import fmpy
import numpy as np
import pytest

from pyjoystick.model import Trajectory, simulate
from tests.joystick_fmu.driver import fmu_parameters, fmu_path, model_exchange, slave
from tests.pyjoystick.random_parameters import RandomCase, both_laws

TIMES = np.linspace(0.0, 1.5, 1501)
TOLERANCES = (1e-6, 1e-7, 1e-8, 1e-9)
CASES = both_laws(25)


@cache
def _reference(case: RandomCase) -> Trajectory:
    """At `TIMES`; the FMUs of both versions are compared with it."""
    return simulate(case.parameters, time=TIMES, theta_start=case.theta_start)


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_co_simulation_follows_the_reference(case: RandomCase, fmus: Path) -> None:
    """At tolerance 1e-8 within 1e-7 rad, with the same state events in the same order."""
    expected = _reference(case)
    with slave(fmu_path(fmus, case.parameters), logging=True) as run:
        run.start(fmu_parameters(case.parameters, case.theta_start), tolerance=1e-8)
        theta = run.run(TIMES, ["theta"])["theta"]
        events = run.events()
    assert np.abs(theta - expected.theta).max() < 1e-7
    # The last instants may lie within the error of an event beyond the end of the run.
    expected_events = [event for event in expected.events if event.time < TIMES[-1] - 1e-4]
    found = [event for event in events if event.time < TIMES[-1] - 1e-4]
    assert [event.kind for event in found] == [event.kind for event in expected_events]
    differences = [a.time - b.time for a, b in zip(found, expected_events, strict=True)]
    # An error of 1e-7 rad passes a kink early or late by that over omega, which is small near turning points.
    assert all(
        abs(difference) < 1e-7 / max(abs(event.omega), 1e-2)
        for difference, event in zip(differences, expected_events, strict=True)
    )


@pytest.mark.parametrize("law", ["constant", "power law"])
def test_the_error_falls_with_the_tolerance(law: str, fmus: Path) -> None:
    cases = [case for case in CASES if case.name.startswith(law)][:8]
    worst = dict.fromkeys(TOLERANCES, 0.0)
    for case in cases:
        expected = _reference(case).theta
        with slave(fmu_path(fmus, case.parameters)) as run:
            for tolerance in TOLERANCES:
                run.start(fmu_parameters(case.parameters, case.theta_start), tolerance)
                error = np.abs(run.run(TIMES, ["theta"])["theta"] - expected).max()
                worst[tolerance] = max(worst[tolerance], error)
                run.fmu.reset()
    errors = [worst[tolerance] for tolerance in TOLERANCES]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 1e-8


@pytest.mark.parametrize("case", [CASES[0], CASES[25]], ids=lambda case: case.name)
def test_communication_steps_do_not_matter(case: RandomCase, fmus: Path) -> None:
    """Steps from 0.1 ms to 0.1 s give the same angle within 1e-7 rad where they meet."""
    meeting = np.linspace(0.0, 1.5, 16)
    angles = []
    for step in (1e-4, 1e-3, 7e-3, 1e-2, 0.1):
        times = np.union1d(np.arange(0.0, 1.5, step), meeting)
        times = times[np.append(True, np.diff(times) > 1e-9)]
        with slave(fmu_path(fmus, case.parameters)) as run:
            run.start(fmu_parameters(case.parameters, case.theta_start), tolerance=1e-8)
            theta = run.run(times, ["theta"])["theta"]
        angles.append(theta[np.searchsorted(times, meeting - 1e-9)])
    assert np.ptp(angles, axis=0).max() < 1e-7


@pytest.mark.parametrize("case", [*CASES[:3], *CASES[25:28]], ids=lambda case: case.name)
def test_model_exchange_follows_the_reference(case: RandomCase, fmus: Path) -> None:
    """FMPy's CVode at a tolerance of 1e-10 within 1e-6 rad."""
    values = fmu_parameters(case.parameters, case.theta_start)
    times, found = model_exchange(fmu_path(fmus, case.parameters), values, "theta")
    expected = simulate(case.parameters, time=times, theta_start=case.theta_start).theta
    assert np.abs(found["theta"] - expected).max() < 1e-6


@pytest.mark.parametrize("early_return", [True, False])
def test_event_mode_in_co_simulation_gives_the_same(early_return: bool, joystick_fmus3: Path) -> None:
    """FMPy carries out the events itself, before the communication points where steps may end early."""
    settings = {
        "fmi_type": "CoSimulation",
        "stop_time": 1.5,
        "output_interval": 1e-3,
        "relative_tolerance": 1e-8,
        "start_values": {"theta_start": np.deg2rad(-20.0)},
        "output": ["theta"],
    }
    path = str(joystick_fmus3 / "Joystick.fmu")
    plain = fmpy.simulate_fmu(path, **settings)
    driven = fmpy.simulate_fmu(path, use_event_mode=True, early_return_allowed=early_return, **settings)
    times, first = np.unique(driven["time"], return_index=True)
    assert (len(times) > len(plain)) == early_return, "the events too have a row"
    meeting = np.searchsorted(times, plain["time"] - 1e-9)
    assert np.abs(driven["theta"][first][meeting] - plain["theta"]).max() < 1e-9
