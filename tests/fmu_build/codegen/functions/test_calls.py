"""The function that each call in an equation resolves to, and how arrays are passed."""

from __future__ import annotations

import ctypes
import dataclasses
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import rumoca

from fmu_build.codegen import ModelSource, generate
from fmu_build.codegen.equation_reader import read_equations
from fmu_build.codegen.functions import FunctionLibrary
from fmu_build.codegen.lowered import lower
from fmu_build.packaging.sources import include_arguments
from fmu_build.support.errors import UnsupportedModelError
from tests.fmu_build.codegen.functions.compiled import compile_c

# Calls that differ by nothing but the function: in one equation, within each other, in the same equation of
# several components, in loops over arrays, in branches, as start value and in the value of a parameter.
SITES = """
package Sites
  partial function Scalar
    input Real x;
    output Real y;
  end Scalar;

  function cube "x^3"
    extends Scalar;
  algorithm
    y := x;
    for i in 1:2 loop
      y := y*x;
    end for;
  end cube;

  function quadruple "4*x"
    extends Scalar;
  algorithm
    y := x;
    for i in 1:3 loop
      y := y + x;
    end for;
  end quadruple;

  function sine_of_sign "sin(sign(x)); the compiler writes it out where it is called"
    extends Scalar;
  algorithm
    y := min(sin(sign(x)) for i in 1:3);
  end sine_of_sign;

  function decimal "a[1] + 10*a[2] + 100*a[3] + ..."
    input Real a[:];
    output Real y;
  algorithm
    y := 0;
    for i in size(a, 1):-1:1 loop
      y := 10*y + a[i];
    end for;
  end decimal;

  function ends "First and last element, and their sum"
    input Real a[:];
    output Real both[2];
    output Real total;
  algorithm
    both := {a[1], a[end]};
    total := 0;
    for i in 1:2 loop
      total := total + both[i];
    end for;
  end ends;

  function power "x^n; the compiler makes a function of its own for every n"
    input Real x;
    input Integer n;
    output Real y;
  algorithm
    y := 1;
    for i in 1:n loop
      y := y*x;
    end for;
  end power;

  model Component
    replaceable function f = cube constrainedby Scalar;
    parameter Integer n = 2;
    parameter Real a[n] = {i for i in 1:n};
    parameter Real b = f(a[2]) - quadruple(a[2]);
    Real order, powers, inside, sizes, branch, constants, each_i[2], both[2], total;
  equation
    order = f(time) - quadruple(time) + 2*cube(time) - quadruple(2*time);
    powers = power(time, 2) + 10*power(time, 5) - power(2*time, 3);
    inside = f(quadruple(time)) - quadruple(f(time)) + quadruple(quadruple(cube(time)));
    sizes = decimal(a) + 1000*decimal({time, 2, time}) + quadruple(decimal({b, time}));
    branch = if noEvent(inside > 50) then f(time) else quadruple(time);
    constants = if noEvent(quadruple(2.0) > 7) then 6 + time else sine_of_sign(time);
    for i in 1:2 loop
      each_i[i] = f(i*time) + quadruple(time);
    end for;
    (both, total) = ends({f(time), 3, quadruple(time), 5*time});
  end Component;

  model Main
    Component one;
    Component two(redeclare function f = quadruple, n = 3);
    Component more[2](each n = 4);
  end Main;

  model WrittenOut
    Real y = sine_of_sign(time) + cube(time);
  end WrittenOut;
end Sites;
"""


# The equations of the generated model at a time, with the default parameters.
EVALUATION = """
#include <string.h>

enum { N_Y = sizeof y_start / sizeof *y_start, N_P = sizeof p_start / sizeof *p_start };

void evaluate(double time, double *y);
void evaluate(double time, double *y)
{
    double p[N_P];
    memcpy(p, model.p_start, sizeof p);
    model_dependent_parameters(p);
    (void)model_algebraics(time, y, p);
}
"""


def component(f: str, n: int, time: float) -> dict[str, float]:
    """What a Component computes, from the meaning of its functions."""

    def cube(x: float) -> float:
        return x**3

    def quadruple(x: float) -> float:
        return 4 * x

    def decimal(a: list[float]) -> float:
        return sum(element * 10.0**place for place, element in enumerate(a))

    chosen = {"cube": cube, "quadruple": quadruple}[f]
    a = [float(i) for i in range(1, n + 1)]
    b = chosen(a[1]) - quadruple(a[1])
    inside = chosen(quadruple(time)) - quadruple(chosen(time)) + 16 * cube(time)
    return {
        "order": chosen(time) - quadruple(time) + 2 * cube(time) - quadruple(2 * time),
        "powers": time**2 + 10 * time**5 - 8 * time**3,
        "inside": inside,
        "sizes": decimal(a) + 1000 * decimal([time, 2, time]) + quadruple(decimal([b, time])),
        "branch": chosen(time) if inside > 50 else quadruple(time),
        "constants": 6.0 + time,
        "each_i_1": chosen(time) + quadruple(time),
        "each_i_2": chosen(2 * time) + quadruple(time),
        "both_1": chosen(time),
        "both_2": 5 * time,
        "total": chosen(time) + 5 * time,
    }


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sites")
    (folder / "Sites.mo").write_text(SITES, "utf-8")
    (folder / "token.h").write_text('#define MODEL_TOKEN ""\n', "utf-8")
    return folder


@pytest.fixture(scope="module")
def values(folder: Path) -> Callable[[float], dict[str, float]]:
    """The variables of the compiled model Main at a time, by their names in the C code."""
    session = rumoca.Session()
    model = session.load(str(folder / "Sites.mo"), model="Sites.Main")
    source = generate(ModelSource(session, model)).c_source
    names = re.findall(r"^    Y_(\w+),$", source, re.MULTILINE)
    library = compile_c(source + EVALUATION, folder / "sites.so", *include_arguments(), "-I", str(folder))
    library.evaluate.argtypes = (ctypes.c_double, ctypes.POINTER(ctypes.c_double))

    def at(time: float) -> dict[str, float]:
        y = (ctypes.c_double * len(names))()
        library.evaluate(time, y)
        return dict(zip(names, y, strict=True))

    return at


@pytest.mark.parametrize("time", [0.0, 0.7, 1.0, 1.9])
@pytest.mark.parametrize(
    ("name", "f", "n"),
    [("one", "cube", 2), ("two", "quadruple", 3), ("more_1", "cube", 4), ("more_2", "cube", 4)],
)
def test_calls_reach_their_functions(
    values: Callable[[float], dict[str, float]], name: str, f: str, n: int, time: float
) -> None:
    found = values(time)
    for variable, expected in component(f, n, time).items():
        assert found[f"{name}_{variable}"] == pytest.approx(expected, rel=1e-13, abs=1e-13), variable


def test_a_call_beside_one_that_is_written_out_is_refused(folder: Path) -> None:
    lowered = lower(rumoca.Session().load(str(folder / "Sites.mo"), model="Sites.WrittenOut"))
    with pytest.raises(UnsupportedModelError, match=r"it fits one of .*cube, .*sine_of_sign"):
        read_equations(lowered, FunctionLibrary(lowered).name_of)


def test_call_that_could_be_two_functions_is_refused(folder: Path) -> None:
    lowered = lower(rumoca.Session().load(str(folder / "Sites.mo"), model="Sites.Main"))
    solve = _without_spans(lowered.solve)
    functions = FunctionLibrary(dataclasses.replace(lowered, solve=solve))
    with pytest.raises(UnsupportedModelError, match=r"it fits one of .*cube, .*quadruple"):
        read_equations(lowered, functions.name_of)


def _without_spans(tree: Any) -> Any:
    """The Solve IR as if the compiler had not said where its equations stand in the source."""
    if isinstance(tree, dict):
        return {key: _without_spans(value) for key, value in tree.items() if key != "program_spans"}
    return [_without_spans(item) for item in tree] if isinstance(tree, list) else tree
