"""Directional and adjoint derivatives of the FMI 2 and FMI 3 joysticks, against manual derivatives."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model
from fmpy.fmi3 import FMU3Model
from numpy.typing import NDArray

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from tests.joystick_fmu.analytic import jacobian
from tests.joystick_fmu.driver import slave

RELATIVE = 1e-12
LAWS = {"Joystick": NOMINAL, "JoystickPowerLaw": NOMINAL_POWER_LAW}
UNKNOWNS = ("alpha", "x", "f_x", "M_s", "M_d", "M_g", "C", "E")
# In every part of the springs' curves, on both sides, and between them.
ANGLES = (-0.33, -0.12, -0.0045, -0.001, 0.0008, 0.005, 0.06, 0.122, 0.2, 0.34)
OMEGA, TORQUE = -1.7, 0.25


class Point:
    """An FMU of either version in Continuous-Time Mode; variables by name."""

    def __init__(self, fmu: Path, folder: Path) -> None:
        description = fmpy.read_model_description(str(fmu))
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        settings = {
            "guid": description.guid,
            "modelIdentifier": description.modelExchange.modelIdentifier,
            "unzipDirectory": str(fmpy.extract(str(fmu), str(folder))),
        }
        self.is_fmi3 = description.fmiVersion == "3.0"
        self.model: Any = FMU3Model(**settings) if self.is_fmi3 else FMU2Model(**settings)
        self.model.instantiate()
        if not self.is_fmi3:
            self.model.setupExperiment()
        self.model.enterInitializationMode()

    def set(self, name: str, value: float) -> None:
        setter = self.model.setFloat64 if self.is_fmi3 else self.model.setReal
        setter([self.references[name]], [value])

    def start(self, theta: float) -> None:
        for name, value in (("theta_start", theta), ("omega_start", OMEGA), ("T", TORQUE)):
            self.set(name, value)
        self.model.exitInitializationMode()
        (self.model.updateDiscreteStates if self.is_fmi3 else self.model.newDiscreteStates)()
        self.model.enterContinuousTimeMode()

    def directional(self, unknowns: tuple[str, ...], known: str, seed: float = 1.0) -> NDArray[np.float64]:
        rows = [self.references[name] for name in unknowns]
        return np.array(self.model.getDirectionalDerivative(rows, [self.references[known]], [seed]))


@contextmanager
def _point(fmu: Path, folder: Path) -> Iterator[Point]:
    point = Point(fmu, folder)
    try:
        yield point
    finally:
        point.model.freeInstance()


@pytest.mark.parametrize("name", LAWS)
def test_derivatives_by_hand(name: str, fmus: Path, tmp_path: Path) -> None:
    parameters = LAWS[name].to_names()
    knowns = [k for k in parameters if k not in ("theta_start", "omega_start", "theta_limit", "damping.beta")]
    for theta in ANGLES:
        expected = jacobian(parameters, theta, OMEGA, TORQUE)
        with _point(fmus / f"{name}.fmu", tmp_path) as point:
            point.start(theta)
            for known in ("theta", "omega", "T", *knowns):
                found = point.directional(UNKNOWNS, known)
                for unknown, value in zip(UNKNOWNS, found, strict=True):
                    if unknown == "E" and known not in ("theta", "omega", "J", "m", "T"):
                        continue  # the stored energy by the springs' parameters is not written by hand
                    wanted = expected.get((unknown, known), 0.0)
                    assert value == pytest.approx(wanted, rel=RELATIVE, abs=1e-300), (theta, unknown, known)


@pytest.mark.parametrize("name", LAWS)
def test_derivatives_of_initial_values(name: str, fmus: Path, tmp_path: Path) -> None:
    """Through theta_start and omega_start, which the states are computed from."""
    parameters = LAWS[name].to_names()
    expected = jacobian(parameters, -0.2, OMEGA, TORQUE)
    with _point(fmus / f"{name}.fmu", tmp_path) as point:
        for start, value in (("theta_start", -0.2), ("omega_start", OMEGA), ("T", TORQUE)):
            point.set(start, value)
        for known, start in (("theta", "theta_start"), ("omega", "omega_start")):
            found = point.directional((known, *UNKNOWNS), start)
            wanted = [1.0, *(expected.get((unknown, known), 0.0) for unknown in UNKNOWNS)]
            assert list(found) == pytest.approx(wanted, rel=RELATIVE, abs=1e-300)


@pytest.mark.parametrize("name", LAWS)
def test_adjoints_are_the_transposed(name: str, joystick_fmus3: Path, tmp_path: Path) -> None:
    knowns = ("theta", "omega", "T", "J", "a", "backward.returnSpring.F_0")
    seed = [0.3 * (-1.0) ** i / (i + 1.0) for i in range(len(UNKNOWNS))]
    with _point(joystick_fmus3 / f"{name}.fmu", tmp_path) as point:
        point.start(-0.2)
        columns = np.array([point.directional(UNKNOWNS, known) for known in knowns])
        rows, references = ([point.references[name] for name in names] for names in (UNKNOWNS, knowns))
        found = point.model.getAdjointDerivative(rows, references, seed, nSensitivity=len(knowns))
    assert list(found) == pytest.approx(list(columns @ np.array(seed)), rel=RELATIVE)


def test_inverse_by_hand(joystick_fmus: Path, tmp_path: Path) -> None:
    """T = J*alpha + C*omega + M_s - m*g*h*sin(theta), with theta, omega and alpha as inputs."""
    parameters = NOMINAL.to_names()
    theta, omega, alpha = 0.15, 0.8, -3.0
    expected = jacobian(parameters, theta, omega, 0.0)
    with _point(joystick_fmus / "JoystickInverse.fmu", tmp_path) as point:
        for name, value in (("theta", theta), ("omega", omega), ("alpha", alpha)):
            point.set(name, value)
        point.model.exitInitializationMode()
        point.model.newDiscreteStates()
        point.model.enterContinuousTimeMode()
        by = {known: point.directional(("T",), known)[0] for known in ("theta", "omega", "alpha", "J", "a")}
    inertia = parameters["J"]
    for known in ("theta", "omega", "a"):
        assert by[known] == pytest.approx(-inertia * expected["alpha", known], rel=RELATIVE)
    assert (by["alpha"], by["J"]) == (inertia, alpha)


@pytest.mark.parametrize("name", LAWS)
def test_a_run_with_derivatives_is_the_run_without(name: str, joystick_fmus: Path) -> None:
    times = np.linspace(0.0, 0.6, 301)
    runs = []
    for asks in (False, True):
        with slave(joystick_fmus / f"{name}.fmu") as run:
            run.start({"theta_start": math.radians(-20.0)}, tolerance=1e-8)
            rows = []
            for start, end in pairwise(times):
                if asks:
                    unknowns = [run.references[unknown] for unknown in UNKNOWNS]
                    known = [run.references["theta"], run.references["J"]]
                    assert np.isfinite(run.fmu.getDirectionalDerivative(unknowns, known, [1.0, 1.0])).all()
                run.fmu.doStep(start, end - start)
                rows.append(run.fmu.getReal([run.references["theta"], run.references["alpha"]]))
            runs.append(rows)
    assert runs[0] == runs[1]
