"""Equalities of whole numbers and of what relations decide, and assertions in functions."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import build_fmu
from pyjoystick import Fmu
from tests.fmu_build.package_under_test import PackageUnderTest

PACKAGE = PackageUnderTest("""
package R
  function root
    input Real u;
    output Real y;
  algorithm
    assert(u < 10, "too large");
    y := sqrt(u);
  end root;
  model M
    parameter Integer k = 2;
    parameter Real p = 4;
    Real x(start=0, fixed=true);
    Real y(start=0, fixed=true);
    Integer n(start=0, fixed=true);
  equation
    der(x) = 1;
    {}
  end M;
end R;
""")


@pytest.mark.parametrize(
    ("equations", "y"),
    [
        ("der(y) = if integer(4*time) == 2 then 1 else 0;", 0.25),
        ("der(y) = if integer(4*x) == 2 then 5 elseif integer(4*x) <> 1 then 1 else 0;", 1.75),
        ("der(y) = if mod(integer(4*time), 2) == 1 then 1 else 0;", 0.5),
        ("der(y) = if integer(4*time) == integer(3*time) + 1 then 12 else 0;", 1 + 2 + 3),
        ("der(y) = if integer(4*time) == k then 1 else 0;", 0.25),
    ],
)
def test_a_step_function_equals_a_number_between_two_events(tmp_path: Path, equations: str, y: float) -> None:
    assert PACKAGE.values(tmp_path, f"{equations} n = 0;", ["y"])["y"] == pytest.approx(y, abs=1e-6)


def test_the_number_may_be_a_parameter_that_a_run_sets(tmp_path: Path) -> None:
    text = (
        "der(y) = if integer(4*x) == k then x else 0; when integer(4*x) == k then n = pre(n) + 1; end when;"
    )
    with Fmu(build_fmu("R.M", tmp_path, library=PACKAGE.write(tmp_path, text)).path) as fmu:
        for k, y, n in ((1, 3 / 32, 1), (3, 7 / 32, 1), (0, 1 / 32, 0), (9, 0, 0)):
            end = fmu.run([0.0, 0.999, 1.0], outputs=["y", "n"], parameters={"k": k}).iloc[-1]
            assert (end["y"], end["n"]) == (pytest.approx(y, abs=1e-6), n)


@pytest.mark.parametrize(
    "equations",
    [
        "der(y) = if (time > 0.5) == (time > 0.7) then 1 else 3; n = 0;",
        "der(y) = if (if time > 0.5 then 1 else 2) == k then 1 else 3; n = 0;",
    ],
)
def test_an_equality_of_what_relations_decide_is_named(tmp_path: Path, equations: str) -> None:
    message = r"R\.mo:\d+:\d+: an equality or inequality \(==, <>\) of values that relations decide"
    PACKAGE.refusal(tmp_path, equations, message)


def test_equalities_in_a_vector_of_conditions_are_named(tmp_path: Path) -> None:
    """The compiler gives no place for some of them."""
    conditions = "{x > 5, ((pre(n) == 0) <> (0.3 > x)), ((x >= 0.4) <> (0.5 >= x))}"
    equations = f"der(y) = 0; when {conditions} then n = pre(n) + 1; end when;"
    PACKAGE.refusal(
        tmp_path, equations, r"an equality or inequality \(==, <>\) of values that relations decide"
    )


def test_a_variable_that_a_function_sets_in_some_cases_only_is_named(tmp_path: Path) -> None:
    """The values of such a variable at the start of the function are not defined (section 12.4.4)."""
    part = PackageUnderTest("""
package R
  function part
    input Real x;
    output Real y;
    output Real z;
  algorithm
    if x > 1 then y := x; end if;
    z := y + 1;
  end part;
  model M
    Real a, b;
  equation
    (a, b) = part(time + {});
  end M;
end R;
""")
    part.refusal(
        tmp_path, "0.5", r"R\.mo:9:5: z depends on a variable of the function that is set in some branches"
    )


def test_an_assertion_in_a_function_of_something_that_changes_is_named(tmp_path: Path) -> None:
    PACKAGE.refusal(tmp_path, "der(y) = root(x); n = 0;", r"R\.mo:7:\d+: an assert\(\) in a function")


def test_an_assertion_in_a_function_of_parameters_is_checked(tmp_path: Path) -> None:
    assert PACKAGE.values(tmp_path, "der(y) = root(p); n = 0;", ["y"])["y"] == pytest.approx(2)
