"""Joysticks built by a real OpenModelica: their interfaces, and their motion against the reference."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave
from numpy.typing import NDArray

from fmu_build import BuildResult, build_fmu
from fmu_build.compilers.openmodelica.finding import find_omc, omc_version
from pyjoystick.fmu import Fmu
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, inverse_torque, simulate
from tests.joystick_fmu.driver import fmu_parameters, model_exchange
from tests.omc import JOYSTICKS, why_not
from tests.pyjoystick.random_parameters import RandomCase, both_laws

pytestmark = pytest.mark.skipif(bool(why_not()), reason=why_not())

CASES = [
    RandomCase("paper, constant", NOMINAL, -0.33),
    RandomCase("paper, power law", NOMINAL_POWER_LAW, -0.33),
    *both_laws(2),
]
every_case = pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> dict[str, BuildResult]:
    """The results of building the four, in a folder whose name has a blank and a letter beyond ASCII."""
    folder = tmp_path_factory.mktemp("FMUs für alle") / "new"
    return {name: build_fmu(model, folder, compiler="openmodelica") for name, model in JOYSTICKS.items()}


def _fmu(results: dict[str, BuildResult], case: RandomCase) -> Path:
    constant = "damping.C" in case.parameters.to_names()
    return results["Joystick" if constant else "JoystickPowerLaw"].path


def _error(times: NDArray[np.float64], theta: NDArray[np.float64], case: RandomCase) -> float:
    expected = simulate(case.parameters, time=times, theta_start=case.theta_start).theta
    return float(np.abs(theta - expected).max())


@pytest.mark.parametrize("name", JOYSTICKS)
def test_the_result(results: dict[str, BuildResult], name: str) -> None:
    result = results[name]
    assert result.path.name == f"{name}.fmu"
    assert [path.name for path in sorted(result.path.parent.iterdir())] == sorted(
        f"{n}.fmu" for n in JOYSTICKS
    )
    assert result.compiler == "openmodelica"
    assert result.compiler_version == omc_version(find_omc(None))
    assert result.seconds > 0.0
    assert result.log.startswith(f"OpenModelica {result.compiler_version}: {find_omc(None)}")
    assert "co-simulation: " in result.log
    assert "error" not in result.log.lower()


@pytest.mark.parametrize("name", JOYSTICKS)
def test_the_model_description(results: dict[str, BuildResult], name: str, joystick_fmus: Path) -> None:
    """Valid for FMPy's simulation, with what other tools see of the default compiler's FMU."""
    description = fmpy.read_model_description(str(results[name].path), validate=True)
    assert description.fmiVersion == "2.0"
    assert description.modelName == f"PreloadedSprings.Joystick.{name}"
    assert description.modelExchange.modelIdentifier == name
    assert description.coSimulation.modelIdentifier == name
    theirs = {variable.name: variable for variable in description.modelVariables}
    ours = fmpy.read_model_description(str(joystick_fmus / f"{name}.fmu")).modelVariables
    interface = [v for v in ours if v.causality in ("input", "output", "parameter")]
    assert len(interface) >= 25
    for variable in interface:
        found = theirs[variable.name]
        assert (found.causality, found.unit) == (variable.causality, variable.unit), variable.name


@every_case
def test_model_exchange_follows_the_reference(results: dict[str, BuildResult], case: RandomCase) -> None:
    """FMPy's CVode at a tolerance of 1e-10 within 1e-6 rad over 1.5 s."""
    values = fmu_parameters(case.parameters, case.theta_start)
    times, found = model_exchange(_fmu(results, case), values, "theta")
    assert _error(times, found["theta"], case) < 1e-6


@every_case
def test_co_simulation_is_reported(
    results: dict[str, BuildResult], case: RandomCase, record_property: pytest.RecordProperty
) -> None:
    """No bar for its error, which is Euler's in old versions; but it runs, and smaller steps do no harm."""
    errors = []
    for step in (1e-3, 1e-4):
        times = np.arange(0.0, 1.5, step)
        parameters = fmu_parameters(case.parameters, case.theta_start)
        with Fmu(_fmu(results, case)) as fmu:
            theta = fmu.run(times, parameters=parameters, outputs=["theta"])["theta"].to_numpy()
        errors.append(_error(times, theta, case))
        record_property(f"error of co-simulation at {step:g} s", errors[-1])
        print(f"{case.name}: co-simulation at {step:g} s differs by {errors[-1]:.1e} rad")
    assert errors[1] < max(errors[0], 1e-6)


def test_the_inverse_gives_the_torque_of_a_motion(results: dict[str, BuildResult]) -> None:
    times = np.linspace(0.0, 1.0, 201)
    theta = 0.3 * np.sin(2.0 * np.pi * times) + 1e-4  # no sample on the kink in the middle
    omega = 0.6 * np.pi * np.cos(2.0 * np.pi * times)
    alpha = -1.2 * np.pi**2 * np.sin(2.0 * np.pi * times)
    expected = inverse_torque(NOMINAL, theta, omega, alpha)
    outputs = ("T", "T_inertia", "T_damping", "T_stiffness")
    rows = []
    with _instance(results["JoystickInverse"].path) as (fmu, references):
        inputs = [references[name] for name in ("theta", "omega", "alpha")]
        for time, *motion in zip(times, theta, omega, alpha, strict=True):
            fmu.setReal(inputs, motion)
            # The first step brings the events that the new input causes, the second is on the new branches.
            fmu.doStep(currentCommunicationPoint=time, communicationStepSize=2.5e-3)
            fmu.doStep(currentCommunicationPoint=time + 2.5e-3, communicationStepSize=2.5e-3)
            rows.append(fmu.getReal([references[name] for name in outputs]))
    for name, column in zip(outputs, np.array(rows).T, strict=True):
        np.testing.assert_allclose(column, getattr(expected, name), rtol=1e-12, atol=1e-12)


@contextmanager
def _instance(path: Path) -> Iterator[tuple[FMU2Slave, dict[str, int]]]:
    """A co-simulation instance at time 0, and the value references of its variables."""
    description = fmpy.read_model_description(str(path))
    folder = fmpy.extract(str(path))
    fmu = FMU2Slave(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="test",
    )
    try:
        fmu.instantiate()
        fmu.setupExperiment(startTime=0.0)
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        yield fmu, {variable.name: variable.valueReference for variable in description.modelVariables}
        fmu.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


@pytest.mark.parametrize("fmi_type", ["me", "cs"])
def test_one_type_alone(tmp_path: Path, fmi_type: str) -> None:
    result = build_fmu(
        "PreloadedSprings.Joystick.Joystick",
        tmp_path,
        compiler="openmodelica",
        fmi_types=[fmi_type],  # type: ignore[list-item]
    )
    description = fmpy.read_model_description(str(result.path))
    assert (description.modelExchange is not None) == (fmi_type == "me")
    assert (description.coSimulation is not None) == (fmi_type == "cs")
