"""The default experiment on a new library: points, inputs, outputs, and reasons for its absence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fmu_build.packaging import default_run
from fmu_build.packaging.binaries import compile_library
from fmu_build.packaging.default_run import DefaultRun, communication_points, run_default_experiment
from fmu_build.packaging.platforms import Platform, host_platform
from fmu_build.packaging.sources import collect_sources, token_header
from fmu_build.support.description import DefaultExperiment, GeneratedModel, InputStep, ModelDescription

_GUID = "{1}"


@pytest.fixture(scope="module")
def host() -> Platform:
    """This machine's platform."""
    platform = host_platform()
    if platform is None:
        pytest.skip("FMUs cannot be built for this machine")
    return platform


@pytest.fixture(scope="module")
def library(generated: GeneratedModel, host: Platform) -> bytes:
    """The oscillator's: x'' = (F - k*x)/m with k = 4 and m = 1, from x = 0.1."""
    sources = collect_sources(generated.c_source, "2.0") | {"token.h": token_header(_GUID)}
    return compile_library(sources, "Oscillator", host)[0]


def test_outputs_follow_the_steps_of_the_inputs(
    library: bytes, host: Platform, description: ModelDescription
) -> None:
    steps = (InputStep(0.0, {"F": 0.4}), InputStep(1.0, {"F": 0.0}))  # at first it is in balance
    experiment = DefaultExperiment(0.0, 3.0, 1e-8, 0.01, steps)
    run = run_default_experiment(
        library, host, replace(description, default_experiment=experiment), _GUID, "2.0"
    )
    assert isinstance(run, DefaultRun)
    time = np.array(run.time)
    assert list(run.outputs) == ["x", "E"]
    assert time[0] == 0.0
    assert time[-1] == 3.0
    np.testing.assert_array_equal(run.inputs["F"], np.where(time < 1.0, 0.4, 0.0))
    swings = 0.1 * np.cos(2.0 * np.clip(time - 1.0, 0.0, None))
    np.testing.assert_allclose(run.outputs["x"], swings, rtol=0, atol=1e-9)


def test_points_are_whole_steps_and_the_inputs_changes() -> None:
    steps = tuple(InputStep(time, {}) for time in (-1.0, 0.0, 0.0175, 1.5))
    points = communication_points(DefaultExperiment(0.0, 1.5, 1e-8, 1e-3, steps))
    assert points == tuple(sorted([*(round(0.005 * i, 12) for i in range(301)), 0.0175]))
    assert communication_points(DefaultExperiment(2.0, 3.0, 1e-8, 0.5)) == (2.0, 2.5, 3.0)
    assert communication_points(DefaultExperiment(0.0, 1.0, 1e-8, 9.0)) == (0.0, 1.0)


@pytest.mark.parametrize("stop", [0.0, -1.0, float("inf"), float("nan")])
def test_an_experiment_without_an_end(
    library: bytes, host: Platform, description: ModelDescription, stop: float
) -> None:
    endless = replace(description, default_experiment=DefaultExperiment(0.0, stop))
    run = run_default_experiment(library, host, endless, _GUID, "2.0")
    assert run == "its stop time is not after its start time"


def test_states_stand_in_for_outputs(library: bytes, host: Platform, description: ModelDescription) -> None:
    variables = tuple(
        replace(v, causality="local") if v.causality == "output" else v for v in description.variables
    )
    run = run_default_experiment(library, host, replace(description, variables=variables), _GUID, "2.0")
    assert isinstance(run, DefaultRun)
    assert list(run.outputs) == ["x", "v"]


def test_a_library_that_refuses_says_why(
    library: bytes, host: Platform, description: ModelDescription
) -> None:
    run = run_default_experiment(library, host, description, "{2}", "2.0")
    assert isinstance(run, str)
    assert "GUID" in run


def test_a_run_that_does_not_end(
    library: bytes, host: Platform, description: ModelDescription, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(default_run, "_MOST_SECONDS", 0.001)
    run = run_default_experiment(library, host, description, _GUID, "2.0")
    assert run == "it did not end within 0.001 s"
