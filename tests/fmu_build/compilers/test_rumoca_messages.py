"""rumoca's terse messages reach the user in Modelica's terms, with the place of what they are about."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.errors import BuildError, ModelicaError, UnsupportedModelError
from fmu_build.support.request import BuildRequest

_X = "Real x(start = 0, fixed = true);"
_N = "discrete Integer n(start = 0, fixed = true);"


@dataclass(frozen=True)
class Case:
    """Declarations (line 2) and equations (line 4) of a model M, and its message without the folder."""

    declarations: str
    equations: str
    error: type[BuildError]
    message: str


def _function(body: str, local: str = "") -> str:
    return f"function f input Real x; output Real y; {local} algorithm {body} end f; Real y;"


_CASES = {
    "redeclared by a class of its own with the same members": Case(
        "model A Real z = time; end A; model B Real z = 2*time; end B; "
        "model C replaceable A a; end C; C c(redeclare B a);",
        "",
        UnsupportedModelError,
        "M.mo:2:101: M.B cannot replace M.A: supported are classes that extend the one that they replace",
    ),
    "edge of an expression": Case(
        _X + _N,
        "der(x) = 1; when edge(x > 0.5) then n = 1; end when;",
        ModelicaError,
        "M.mo:4:20: edge(x > 0.5): edge() applies to variables, not to expressions",
    ),
    "pre of an expression": Case(
        _X + _N,
        "der(x) = 1; when x > 0.5 then n = pre(n + 1); end when;",
        ModelicaError,
        "M.mo:4:37: pre(n + 1): pre() applies to variables",
    ),
    "pre of a continuous variable": Case(
        _X + "Real y;",
        "der(x) = 1; y = pre(x);",
        ModelicaError,
        "M.mo:4:19: pre(x): pre() of the continuous variable x",
    ),
    "reinit of an algebraic variable": Case(
        _X + "Real y;",
        "der(x) = 1; y = x; when x > 0.5 then reinit(y, 0); end when;",
        ModelicaError,
        "M.mo:4:40: reinit(y, 0): reinit() can be applied to states only: y is not a state",
    ),
    "assigned in two when-clauses": Case(
        _X + "discrete Real d;",
        "der(x) = 1; when x > 0.5 then d = 1; end when; when x > 0.6 then d = 2; end when;",
        ModelicaError,
        "M.mo: a discrete variable is assigned in two when-clauses (model M)",
    ),
    "different numbers of equations": Case(
        _X + "Real y;",
        "der(x) = 1; if x > 0.5 then y = 1; y = 2; else y = 3; end if;",
        ModelicaError,
        "M.mo: the branches of an if-equation have different numbers of equations (model M)",
    ),
    "division of a constant by zero": Case(
        "constant Real q = 1/0; Real y;",
        "y = q;",
        ModelicaError,
        "M.mo:2:17: the value of q is divided by zero",
    ),
    "two equations too many": Case(
        "Real y;",
        "y = 1; y = 2; y = 3;",
        ModelicaError,
        "M.mo: unbalanced model: 3 equations, 1 unknowns (model M)",
    ),
    "type error that has brackets": Case(
        "Real a[3]; Real b[2];",
        "a = {1, 2, 3}; b = a;",
        ModelicaError,
        "M.mo:4:18: array dimension mismatch: expected `[2]`, found `[3]`",
    ),
    "two derivatives of expressions": Case(
        _X + "Real y, z;",
        "der(x) = 1; y = der(2*x); z = der(x*x);",
        UnsupportedModelError,
        "M.mo: der(...): der() is supported for variables, not for expressions or members of the elements of "
        "an array; differentiate a variable that is equal to it (model M; see M.mo:4:19, M.mo:4:33)",
    ),
    "break": Case(
        _function("y := 0; for i in 1:3 loop y := y + x; if y > 2 then break; end if; end for;"),
        "y = f(time);",
        UnsupportedModelError,
        "M.mo:2:3: the function f has a statement that is not supported, such as a break",
    ),
    "while on what is computed": Case(
        _function("y := 1; while abs(y*y - x) > 1e-6 loop y := 0.5*(y + x/y); end while;"),
        "y = f(time + 1);",
        UnsupportedModelError,
        "M.mo:2:3: the function f has a statement that is not supported",
    ),
    "algorithm section": Case(
        _X + "Real y, z;",
        "der(x) = 1; algorithm y := x; z := y; y := 2*y;",
        UnsupportedModelError,
        "M.mo:4:15: this algorithm section is not supported",
    ),
    "two samplers in one when-clause": Case(
        _N,
        "when sample(0, 1) then n = 1; elsewhen sample(0, 2) then n = 2; end when;",
        UnsupportedModelError,
        "M.mo:4:33: elsewhen sample(0, 2): a when-clause that has sample() in one branch",
    ),
    "sampler as a variable in one branch": Case(
        _X + _N + "Boolean t;",
        "der(x) = 1; t = sample(0, 1); when x > 0.5 then n = 1; elsewhen t then n = 2; end when;",
        UnsupportedModelError,
        "M.mo: a when-clause with a sampled and another branch is not supported (model M)",
    ),
    "recursive function": Case(
        _function("y := if x <= 0 then 1 else x*f(x - 1);"),
        "y = f(time);",
        UnsupportedModelError,
        "M.mo:2:12: the recursive function f is not supported",
    ),
    "derivative of an input through a variable": Case(
        "input Real u; Real w; Real y;",
        "w = 2*u; y = der(w);",
        UnsupportedModelError,
        "M.mo: only 1 of 2 equations determine an unknown of their own: some repeat or contradict others, or "
        "the derivative of an input is needed (model M)",
    ),
    "maximum that varies": Case(
        "Real x(start = 0, fixed = true, max = y); Real y = time;",
        "der(x) = 1;",
        UnsupportedModelError,
        "M.mo:2:41: max of x depends on y, which is not a parameter",
    ),
    "one of two parameters undetermined": Case(
        _X + "parameter Real p[2](each fixed = false); initial equation p[1] = 3;",
        "der(x) = p[1] + p[2];",
        UnsupportedModelError,
        "M.mo:2:45: the parameter p[2] has fixed = false, and no initial equation determines it",
    ),
}


@pytest.mark.parametrize("case", _CASES.values(), ids=list(_CASES))
def test_message(case: Case, tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text(f"model M\n  {case.declarations}\nequation\n  {case.equations}\nend M;\n")
    with pytest.raises(BuildError) as caught:
        generate_model(BuildRequest("M", tmp_path, file))
    assert type(caught.value) is case.error
    assert str(caught.value).replace(f"{tmp_path}/", "").startswith(case.message)
