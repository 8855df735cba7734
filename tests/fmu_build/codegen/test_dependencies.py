"""Dependencies of outputs and derivatives in the descriptions of models."""

from __future__ import annotations

from pathlib import Path

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.description import ModelDescription, Unknown
from fmu_build.support.request import BuildRequest

MODEL = """model Driven
  parameter Real k = 2;
  parameter Real scale = 3;
  final parameter Real product = k*scale;
  parameter Real idle = 1;
  parameter Real start = 0.5;
  input Real u;
  Real x(start=start, fixed=true);
  output Real y;
equation
  der(x) = -product*x + u;
  y = x + sin(time);
end Driven;
"""


def _dependencies(unknown: Unknown, description: ModelDescription) -> set[str]:
    return {description.variables[reference].name for reference in unknown.dependencies}


SWITCHED = """model Switched
  parameter Real k = 2;
  input Real u;
  Real x(start=0, fixed=true);
  output Real y;
equation
  der(x) = 1 + k*u - 3*x;
  y = if x > 0.5 then k*u else 5*u;
end Switched;
"""


def test_the_factor_of_a_dependency_is_constant_fixed_or_neither(tmp_path: Path) -> None:
    """Of u it is the parameter k in the derivative of x, and hangs on x in y (FMI 2.0.4, section 2.2.8)."""
    library = tmp_path / "Switched.mo"
    library.write_text(SWITCHED, "utf-8")
    description = generate_model(BuildRequest("Switched", tmp_path, library))[0].description
    (output,), (rate,) = description.outputs, description.derivatives
    kinds = [
        {
            description.variables[reference].name: kind
            for reference, kind in zip(unknown.dependencies, unknown.dependency_kinds, strict=True)
        }
        for unknown in (output, rate)
    ]
    assert kinds[0]["u"] == "dependent"
    assert (kinds[1]["u"], kinds[1]["x"]) == ("fixed", "constant")


def test_parameters_time_states_and_inputs(tmp_path: Path) -> None:
    library = tmp_path / "Driven.mo"
    library.write_text(MODEL, "utf-8")
    generated, _ = generate_model(BuildRequest("Driven", tmp_path, library))
    description = generated.description
    assert description.has_directional_derivatives
    (output,), (rate,) = description.outputs, description.derivatives
    assert _dependencies(output, description) == {"time", "x"}
    assert _dependencies(rate, description) == {"k", "scale", "x", "u"}
    initial = {description.variables[u.value_reference].name: u for u in description.initial_unknowns}
    assert _dependencies(initial["y"], description) == {"time", "start"}
    assert _dependencies(initial["x"], description) == {"start"}
