"""Unsupported constructs in functions, and parameters that the compiler bakes into functions."""

from __future__ import annotations

from pathlib import Path

import pytest
import rumoca

from fmu_build.codegen import ModelSource, generate
from fmu_build.codegen.equation_reader import read_equations
from fmu_build.codegen.functions import FunctionLibrary
from fmu_build.codegen.lowered import lower
from fmu_build.support.errors import UnsupportedModelError

PACKAGE = """
package P
  function repeated
    input Real x;
    output Real y;
  algorithm
    y := x;
    for i in 1:2 loop
      y := checked(y);
    end for;
  end repeated;

  function checked
    input Real x;
    output Real y;
  algorithm
    assert(x > 0, "x must be positive");
    y := x;
    for i in 1:2 loop
      y := y*x;
    end for;
  end checked;

  function polynomial
    input Real x;
    input Integer n;
    output Real y;
  algorithm
    y := 0;
    for i in 1:n loop
      y := y*x + i;
    end for;
  end polynomial;

  model Assertion
    Real y = repeated(time + 1);
  end Assertion;

  model Degree
    parameter Integer n = 3;
    parameter Integer factor = 2;
    Real y;
  equation
    y = polynomial(factor*time, n);
  end Degree;
end P;
"""


def test_assertions_of_called_functions_are_refused() -> None:
    lowered = lower(rumoca.Session().loads(PACKAGE, model="P.Assertion"))
    functions = FunctionLibrary(lowered)
    expected = r"input\.mo:\d+:\d+: function repeated is not supported: .* have assertions"
    with pytest.raises(UnsupportedModelError, match=expected):
        read_equations(lowered, functions.name_of)


def test_parameter_in_the_range_of_a_loop_is_a_constant(tmp_path: Path) -> None:
    """The equations are the same for every n; only the function that they call is another one."""
    (tmp_path / "P.mo").write_text(PACKAGE, "utf-8")
    session = rumoca.Session()
    model = session.load(str(tmp_path / "P.mo"), model="P.Degree")
    found = {v.name: v for v in generate(ModelSource(session, model)).description.variables}
    assert found["n"].variability == "constant"
    assert found["factor"].causality == "parameter"
