"""Divisions by parameters are replaced in the derivatives, and only there."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
import rumoca
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from fmu_build import build_fmu
from fmu_build.codegen import ModelSource, generate

MODELICA = """
model Ratio
  parameter Real tau(min = 1e-3) = 2;
  parameter Real L = 0.1;
  parameter Real k = 4;
  parameter Real none = 0;
  input Real u(start = 1);
  Real x(start = 0.3, fixed = true);
  Real relative = x/L;
  Real share = x/u;
  Boolean long = relative >= 3;
equation
  der(x) = -x/tau + none*(relative*sqrt(k) + share);
end Ratio;
"""


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("ratio") / "Ratio.mo"
    path.write_text(MODELICA)
    return path


@pytest.fixture(scope="module")
def functions(library: Path) -> dict[str, str]:
    """The generated C by the name of the function."""
    session = rumoca.Session()
    source = generate(ModelSource(session, session.load(str(library), model="Ratio"))).c_source
    parts = source.split("\n}\n")
    return {part.split("model_")[1].split("(")[0]: part for part in parts if "model_" in part}


def test_derivatives_multiply_by_the_reciprocal(functions: dict[str, str]) -> None:
    assert "/ p[P_tau]" not in functions["derivatives"]
    assert "p[P_inverse_tau]" in functions["derivatives"]
    assert "p[P_inverse_tau] = 1.0 / p[P_tau];" in functions["dependent_parameters"]


def test_what_a_zero_crossing_reads_stays_a_division(functions: dict[str, str]) -> None:
    """0.3/0.1 is 3 to the last digit that it has in every function, so that the relation has one side."""
    for name in ("derivatives", "roots", "algebraics"):
        assert "v_relative = y[Y_x] / p[P_L];" in functions[name]


def test_costly_parts_are_computed_once(functions: dict[str, str]) -> None:
    assert "sqrt" not in functions["derivatives"]
    assert "= sqrt(p[P_k]);" in functions["dependent_parameters"]


def test_division_by_an_input_stays(functions: dict[str, str]) -> None:
    assert "v_share = y[Y_x] / p[P_u];" in functions["derivatives"]


def test_a_new_value_of_the_divisor_takes_effect(library: Path, tmp_path: Path) -> None:
    """The state decays with tau = 2 until t = 1 and with tau = 1/2 from there on."""
    folder = extract(build_fmu("Ratio", tmp_path, library=library).path, tmp_path / "Ratio")
    description = read_model_description(folder)
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    slave = FMU2Slave(
        guid=description.guid,
        modelIdentifier=description.coSimulation.modelIdentifier,
        unzipDirectory=str(folder),
    )
    slave.instantiate()
    slave.setupExperiment(tolerance=1e-9, startTime=0.0, stopTime=2.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    slave.doStep(currentCommunicationPoint=0.0, communicationStepSize=1.0)
    slave.setReal([references["tau"]], [0.5])
    slave.doStep(currentCommunicationPoint=1.0, communicationStepSize=1.0)
    (x,) = slave.getReal([references["x"]])
    slave.terminate()
    slave.freeInstance()
    assert x == pytest.approx(0.3 * math.exp(-0.5) * math.exp(-2.0), rel=1e-8)
