"""Two FMUs over the same experiments."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Interface, UnsupportedFmuError, read_description
from pyjoystick.motion import Difference
from pyjoystick.runs import (
    Experiment,
    FmuComparison,
    Limits,
    RunComparison,
    Tolerances,
    compare_fmus,
    experiments_for,
)
from pyjoystick.support import ParameterError, PyJoystickError, UnknownParameterError, UnknownVariableError
from tests.pyjoystick.fmu import awkward
from tests.pyjoystick.fmu.doctored import doctored, without_co_simulation

TIME = np.linspace(0.0, 2.0, 501)


def by_name(run: RunComparison) -> dict[str, Difference]:
    return {one.variable: one for one in run.differences}


@pytest.fixture(scope="module")
def apart(pair: Path) -> FmuComparison:
    settings = {"inverted": False, "n": 3, "k": 2.0}
    experiment = Experiment("two seconds", TIME, settings)
    return compare_fmus(pair / "First.fmu", pair / "Second.fmu", experiments=[experiment])


@pytest.mark.parametrize("position", [0, 1], ids=["ModelExchange", "CoSimulation"])
def test_where_and_when_they_part(apart: FmuComparison, position: int) -> None:
    """exp(-2 t) against exp(-2 t) exp(-0.02 (t - 0.5)) from t = 0.5 on: farthest apart near t = 1."""
    run = apart.runs[position]
    assert (run.interface, run.experiment) == (("ModelExchange", "CoSimulation")[position], "two seconds")
    x = by_name(run)["x"]
    distance = np.exp(-2.0 * TIME) * (1.0 - np.exp(-0.02 * np.maximum(TIME - 0.5, 0.0)))
    assert x.largest == pytest.approx(distance.max(), rel=1e-4)
    assert x.time == TIME[np.argmax(distance)]
    assert x.limit == pytest.approx(1e-4)
    assert x.parted_at == TIME[np.argmax(distance > 1e-4)]
    for name in ("y", "integral", "count", "above"):
        assert by_name(run)[name].largest < 1e-12
    assert set(by_name(run)) == {"x", "y", "integral", "count", "above"}, "the outputs that both have"


def test_model_exchange_is_judged_and_co_simulation_is_not(apart: FmuComparison) -> None:
    exchange, simulation = apart.runs
    assert exchange.judged == {"x", "y", "integral", "count", "above"}
    assert not exchange.within_limits
    assert simulation.judged == frozenset()
    assert simulation.within_limits
    assert not apart.within_limits


def test_limits_by_name_and_relative_ones(pair: Path) -> None:
    experiment = Experiment("", TIME, {"inverted": False, "n": 3})

    def kept(interface: Interface, limits: Limits) -> bool:
        return compare_fmus(
            *(pair / "First.fmu", pair / "Second.fmu"),
            experiments=[experiment],
            interfaces=[interface],
            limits=limits,
        ).within_limits

    assert kept("ModelExchange", Limits({"x": 2e-3}))
    assert not kept("ModelExchange", Limits({"x": 1e-3}))
    assert kept("ModelExchange", Limits(relative=2e-3))
    assert not kept("ModelExchange", Limits(relative=1e-3))
    assert kept("CoSimulation", Limits({"x": 1e-9}, co_simulation={"x": 2e-3}))
    assert not kept("CoSimulation", Limits(co_simulation={"x": 1e-3}))


def test_discrete_variables_differ_by_whole_numbers(pair: Path) -> None:
    (run,) = compare_fmus(pair / "First.fmu", pair / "Second.fmu", interfaces=["ModelExchange"]).runs
    count, above = by_name(run)["count"], by_name(run)["above"]
    assert (count.largest, above.largest) == (1.0, 1.0), "their n and inverted start otherwise"
    assert count.parted_at == pytest.approx(0.8)
    assert above.parted_at == 0.0


def test_an_fmu_is_like_itself(joystick_fmus: Path) -> None:
    path = joystick_fmus / "JoystickPowerLaw.fmu"
    experiments = experiments_for(read_description(path), read_description(path), duration=0.3)
    comparison = compare_fmus(path, path, experiments=experiments)
    assert len(comparison.runs) == 10, "four releases and a torque through two interfaces"
    assert comparison.within_limits
    assert all(one.largest == 0.0 for run in comparison.runs for one in run.differences)


def test_the_limit_of_the_angle_follows_the_tolerance_of_cvode(joystick_fmus: Path) -> None:
    path = joystick_fmus / "Joystick.fmu"
    experiment = experiments_for(read_description(path), read_description(path))[0]
    limits = []
    for tolerance in (1e-8, 1e-10):
        (run,) = compare_fmus(
            *(path, path),
            experiments=[experiment],
            interfaces=["ModelExchange"],
            tolerances=Tolerances(model_exchange=tolerance),
        ).runs
        limits.append(by_name(run)["theta"].limit)
    assert limits == pytest.approx([3e4 * tolerance * math.radians(20.0) for tolerance in (1e-8, 1e-10)])


def test_two_laws_of_damping_part_at_once(joystick_fmus: Path) -> None:
    paths = joystick_fmus / "Joystick.fmu", joystick_fmus / "JoystickPowerLaw.fmu"
    (first, *_) = experiments_for(*map(read_description, paths), release_angles=[-0.2], duration=0.2)
    comparison = compare_fmus(*paths, experiments=[first], interfaces=["ModelExchange"])
    assert comparison.declarations.only_first == ("damping.C",)
    (run,) = comparison.runs
    theta = by_name(run)["theta"]
    assert theta.parted_at is not None
    assert 0.0 < theta.parted_at < 0.02
    assert by_name(run)["C"].parted_at == 0.0


def test_a_run_that_fails_is_told_and_judged(pair: Path) -> None:
    comparison = compare_fmus(pair / "First.fmu", pair / "Stops.fmu")
    for run in comparison.runs:
        assert run.differences == ()
        (failure,) = run.failures
        assert failure.startswith("second FMU, Stops.fmu at t = 0.17"), "ln(1/0.7)/2 = 0.178"
        assert "x is too small" in failure
        assert not run.within_limits
    both = compare_fmus(pair / "Stops.fmu", pair / "Stops.fmu", interfaces=["CoSimulation"])
    assert [failure.split(",")[0] for failure in both.runs[0].failures] == ["first FMU", "second FMU"]


def test_without_outputs_the_internal_variables_are_compared(pair: Path) -> None:
    (run, _) = compare_fmus(pair / "Closed.fmu", pair / "Closed.fmu").runs
    assert set(by_name(run)) == {"a", "b", "der(a)"}


def test_variables_can_be_chosen(pair: Path) -> None:
    paths = pair / "First.fmu", pair / "Second.fmu"
    (run,) = compare_fmus(*paths, variables=["y", "k", "y"], interfaces=["ModelExchange"]).runs
    assert list(by_name(run)) == ["y", "k"]
    for name in ("inside", "z", "nothing", "time"):
        with pytest.raises(UnknownVariableError, match=f"no variable '{name}'"):
            compare_fmus(*paths, variables=[name])


def test_only_the_interfaces_that_both_have(pair: Path, tmp_path: Path) -> None:
    first = pair / "First.fmu"
    alone = doctored(first, tmp_path / "me.fmu", description=without_co_simulation)
    assert [run.interface for run in compare_fmus(first, alone).runs] == ["ModelExchange"]
    with pytest.raises(UnsupportedFmuError, match=r"me\.fmu: has no CoSimulation"):
        compare_fmus(first, alone, interfaces=["CoSimulation"])

    def without_model_exchange(text: str) -> str:
        start, end = text.index("<ModelExchange"), text.index("</ModelExchange>")
        return text[:start] + text[end + len("</ModelExchange>") :]

    other = doctored(first, tmp_path / "cs.fmu", description=without_model_exchange)
    with pytest.raises(
        ParameterError, match=r"none that can be run with both FMUs \(.*me\.fmu ModelExchange and .*cs\."
    ):
        compare_fmus(alone, other)


@pytest.mark.parametrize(
    ("experiment", "limits", "error", "message"),
    [
        (Experiment("", TIME, {"own": 2.0}), None, UnknownParameterError, "no parameter 'own'"),
        (Experiment("", TIME, {"k": 5.0}), None, ParameterError, "k = 5.0: must be a finite number from 0.5"),
        (Experiment("", TIME), Limits({"v": 1.0}), UnknownVariableError, "no variable 'v'"),
        (Experiment("", TIME), Limits({"x": 0.0}), ParameterError, "limit of x = 0.0"),
        (Experiment("", TIME), Limits(relative=-1.0), ParameterError, "relative_limit = -1.0"),
    ],
)
def test_what_is_refused(
    pair: Path, experiment: Experiment, limits: Limits | None, error: type[PyJoystickError], message: str
) -> None:
    with pytest.raises(error, match=message):
        compare_fmus(pair / "First.fmu", pair / "Second.fmu", experiments=[experiment], limits=limits)


def test_what_is_run_is_told(pair: Path) -> None:
    told: list[str] = []
    compare_fmus(pair / "Closed.fmu", pair / "Closed.fmu", on_run=told.append)
    assert told == ["ModelExchange: 0 to 1 s", "CoSimulation: 0 to 1 s"]


def test_one_model_by_fmi_2_and_3(tmp_path: Path) -> None:
    """By Co-Simulation. FMI 3 has arrays, binaries and clocks besides, which are no numbers."""
    fmus = [
        awkward.build(version, tmp_path / f"{version}.fmu", awkward.compile_library(version, tmp_path))
        for version in (2, 3)
    ]
    (run,) = compare_fmus(*fmus, experiments=[Experiment("", TIME, {"gain": 2.0}, {"u": 3.0})]).runs
    assert run.interface == "CoSimulation"
    assert by_name(run)["y"].largest == 0.0
    assert by_name(run)["steps"].largest == 1000.0, "the one counts 500 steps up, the other down"
    (alone,) = compare_fmus(fmus[1], fmus[1]).runs
    assert len(alone.differences) > len(run.differences)
