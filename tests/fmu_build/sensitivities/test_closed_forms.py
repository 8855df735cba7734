"""Sensitivities through events, reinit(), discrete variables, initial equations and algebraic loops."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu

from fmu_build import FmiVersion
from pyjoystick.fmu import Fmu, FmuRunError
from tests.joystick_fmu.driver import slave
from tests.shared_fmus import SharedFmus

from .closed_forms import CASES, Case

LIBRARY = Path(__file__).with_name("Moving.mo")
#: In Model Exchange, FMPy's CVode integrates at a tolerance of 1e-9, and finds events as late as it is off.
ME_ACCURACY = 1e-5
#: The cases with events: what is special in Model Exchange is that the importer takes them.
WITH_EVENTS = [case for case in CASES if case.model in ("Ball", "Switch", "Relay", "Block", "Sampled")]
#: The runtime's core is the same for FMI 3; a state event with reinit() and a time event tell.
OF_FMI_3 = ("Ball", "Switch")


def _fmu(case: Case, fmus: SharedFmus, fmi_version: FmiVersion) -> Path:
    return fmus.fmu(f"Moving.{case.model}", LIBRARY, fmi_version=fmi_version, sensitivity=case.request)


def _both_versions(cases: list[Case]) -> list[Any]:
    return [
        pytest.param(case, version, id=f"{case.model}-FMI {version[0]}")
        for case in cases
        for version in ("2.0", "3.0")
        if version == "2.0" or case.model in OF_FMI_3
    ]


@pytest.mark.parametrize(("case", "fmi_version"), _both_versions(CASES))
def test_co_simulation(case: Case, fmi_version: FmiVersion, shared_fmus: SharedFmus) -> None:
    """173 points: none of them is an event, whose time depends on the parameters."""
    times = np.linspace(0.0, case.stop_time, 173)
    expected = case.derivatives(times)
    with Fmu(_fmu(case, shared_fmus, fmi_version)) as fmu:
        table = fmu.run(times, parameters=case.parameters, outputs=list(expected), tolerance=1e-10)
    for name, values in expected.items():
        worst = np.abs(table[name].to_numpy() - values) / (1.0 + np.abs(values))
        assert worst.max() < case.accuracy, name


@pytest.mark.parametrize(("case", "fmi_version"), _both_versions(WITH_EVENTS))
def test_model_exchange(case: Case, fmi_version: FmiVersion, shared_fmus: SharedFmus) -> None:
    path = _fmu(case, shared_fmus, fmi_version)
    names = list(case.derivatives(np.zeros(1)))
    result = simulate_fmu(
        str(path),
        model_description=read_model_description(path),
        fmi_type="ModelExchange",
        stop_time=case.stop_time,
        output_interval=case.stop_time / 172,
        relative_tolerance=1e-9,
        start_values=dict(case.parameters),
        output=names,
    )
    times = result["time"]
    at_events = np.unique(times[1:][np.diff(times) == 0.0])
    far = np.all(np.abs(times[:, None] - at_events[None, :]) > 1e-6, axis=1)
    assert far.sum() > 150
    for name, values in case.derivatives(times[far]).items():
        assert np.abs((result[name][far] - values) / (1.0 + np.abs(values))).max() < ME_ACCURACY, name


def test_event_mode_of_co_simulation(shared_fmus: SharedFmus) -> None:
    """The importer takes the events itself: the sensitivities jump there, as inside a step."""
    (case,) = (case for case in CASES if case.model == "Ball")
    path = _fmu(case, shared_fmus, "3.0")
    names = list(case.derivatives(np.zeros(1)))
    result = simulate_fmu(
        str(path),
        fmi_type="CoSimulation",
        stop_time=case.stop_time,
        output_interval=case.stop_time / 172,
        relative_tolerance=1e-10,
        start_values=dict(case.parameters),
        output=names,
        use_event_mode=True,
        early_return_allowed=True,
    )
    times = result["time"]
    at_events = times[1:][np.diff(times) == 0.0]
    assert len(at_events) >= 3
    far = np.all(np.abs(times[:, None] - at_events[None, :]) > 1e-9, axis=1)
    for name, values in case.derivatives(times[far]).items():
        assert np.abs(result[name][far] - values).max() < case.accuracy * (1.0 + np.abs(values).max()), name


def test_saved_states_continue_bit_by_bit(shared_fmus: SharedFmus) -> None:
    """Saved just before a bounce, and taken up again after several."""
    (case,) = (case for case in CASES if case.model == "Ball")
    names = list(case.derivatives(np.zeros(1)))
    with slave(_fmu(case, shared_fmus, "2.0")) as ball:
        ball.start(case.parameters, 1e-8)
        ball.run(np.array([0.0, 0.47]), names)
        state = ball.fmu.getFMUState()
        times = np.linspace(0.47, 2.0, 60)
        first = ball.run(times, names)
        ball.fmu.setFMUState(state)
        again = ball.run(times, names)
        ball.fmu.freeFMUState(state)
    for name in names:
        assert np.array_equal(first[name], again[name]), name
    assert np.ptp(first["sensitivity.v.floor"]) > 1.0


def test_events_at_the_same_time_must_move_alike(shared_fmus: SharedFmus) -> None:
    """`a` and `c` change together whatever `first` is, and `b` only where the parameters are equal."""
    path = shared_fmus.fmu("Moving.Twins", LIBRARY, sensitivity="a,b,c:first,second")
    with Fmu(path) as fmu:
        table = fmu.run([0.0, 1.0], parameters={"second": 0.6})
        found = [table[f"sensitivity.{name}.{by}"].iloc[-1] for name in "abc" for by in ("first", "second")]
        assert found == pytest.approx([-1.5, 0.0, 0.0, -2.5, -3.5, 0.0], abs=1e-9)
        with pytest.raises(FmuRunError, match="two events at the same time that a parameter moves apart"):
            fmu.run([0.0, 1.0])
