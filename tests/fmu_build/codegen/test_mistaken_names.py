"""Functions and outer classes that rumoca may confuse: refused, or built where the values are right."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fmu_build.package_under_test import PackageUnderTest

PACKAGE = PackageUnderTest("""
package R
  function once
    input Real x;
    output Real y;
  algorithm
    y := x;
  end once;
  function tenfold
    input Real x;
    output Real y;
  algorithm
    y := 10*x;
  end tenfold;
  partial package Medium
    constant Real c;
    replaceable partial function h
      input Real x;
      output Real y;
    end h;
    function k
      input Real x;
      output Real y;
    algorithm
      y := c*x + h(x);
    end k;
  end Medium;
  package Water
    extends Medium(c = 2);
    redeclare function extends h
    algorithm
      y := c*x;
    end h;
  end Water;
  package Air
    extends Medium(c = 5);
    redeclare function extends h
    algorithm
      y := x + c;
    end h;
  end Air;
  model Pipe
    replaceable package P = Water constrainedby Medium;
    Real y = P.k(3);
    Real z = P.h(3);
  end Pipe;
  model Own
    function own
      input Real x;
      output Real y;
    algorithm
      y := 100*x;
    end own;
    Real y = own(2);
  end Own;
  model Other
    function own
      input Real x;
      output Real y;
    algorithm
      y := 1000*x;
    end own;
    Real y = own(2);
  end Other;
  model Factor
    constant Real c = 1;
    constant Real d = 3;
    function w
      input Real x;
      output Real y;
    algorithm
      y := c*d*x;
    end w;
    parameter Real p = 1;
    Real y = p*w(2);
  end Factor;
  partial function Offset
    input Real x;
    input Real o = 5;
    output Real y;
  end Offset;
  function Greatest
    function max
      input Real x;
      output Real y = 7*x;
    algorithm
    end max;
    input Real x;
    output Real y = max(x);
  algorithm
  end Greatest;
  {}
end R;
""")


@pytest.mark.parametrize(
    ("declarations", "values"),
    [
        ("model M Pipe b(redeclare package P = Air); end M;", {"b.y": 23.0, "b.z": 8.0}),
        ("model M Real a = Water.k(3); Real b = Air.k(3); end M;", {"a": 12.0, "b": 23.0}),
        (
            "model U import Q = R.Air; Real y = Q.k(3); end U; model M U u; Pipe p; end M;",
            {"u.y": 23.0, "p.y": 12.0},
        ),
        ("model M Own a[2]; Own b; end M;", {"a[2].y": 200.0, "b.y": 200.0}),
        ("model M Factor a; Factor b(p = 4); end M;", {"a.y": 6.0, "b.y": 24.0}),
        (
            "model U replaceable function f = once; Real y = f(2); end U; model M U a; U b(redeclare "
            "function f = tenfold); end M;",
            {"a.y": 2.0, "b.y": 20.0},
        ),
        (
            "function both input Real x; output Real y; output Real z; algorithm y := x; z := 3*x; end both; "
            "function sum_of input Real x; output Real y; protected Real a; Real b; "
            "algorithm (a, b) := both(x); y := a + b; end sum_of; model M Real y = sum_of(2); end M;",
            {"y": 8.0},
        ),
        ("function F = once; model M Real a = F(2); Real b = max(2, 1); end M;", {"a": 2.0, "b": 2.0}),
    ],
    ids=[
        "one medium",
        "full names",
        "one alias each",
        "one function",
        "constants as declared",
        "replaced itself",
        "a statement with two results",
        "short",
    ],
)
def test_each_call_has_its_own_function(declarations: str, values: dict[str, float], tmp_path: Path) -> None:
    assert PACKAGE.values(tmp_path, declarations, values) == values


@pytest.mark.parametrize(
    ("declarations", "message"),
    [
        (
            "model M Pipe a; Pipe b(redeclare package P = Air); end M;",
            r"functions of P, which has several meanings",
        ),
        (
            "model M extends Pipe(redeclare package P = Air); end M;",
            r"functions of P, which has several meanings",
        ),
        (
            "model Q extends Pipe; redeclare package P = Air; end Q; model M Pipe a; Q b; end M;",
            r"functions of P, which has several meanings",
        ),
        (
            "model A package Q = Water; Real y = Q.k(3); end A; model B package Q = Air; Real y = Q.k(3); "
            "end B; "
            "model M A a; B b; end M;",
            r"functions of Q, which has several meanings",
        ),
        (
            "model U import P = R.Air; Real y = P.k(3); end U; model M U u; Pipe p; end M;",
            r"functions of P, which has several meanings",
        ),
        (
            "model A function F = once; Real y = F(2); end A; model B function F = tenfold; Real y = F(2); "
            "end B; "
            "model M A a; B b; end M;",
            r"F\(\) would call another function of that name",
        ),
        ("model M Own a; Other b; end M;", r"own\(\) would call another function of that name"),
        (
            "function own input Real x; output Real y = x; algorithm end own; model M Own a; Real b = "
            "own(2); end M;",
            r"own\(\) would call another function of that name",
        ),
        ("model M Factor a; Factor b(c = 5); end M;", r"the function w would not see what is given to c"),
        ("model M extends Factor(d = 5); end M;", r"the function w would not see what is given to d"),
        (
            "model U replaceable function f = once; "
            "function w input Real x; output Real y = f(x); algorithm end w; Real y = w(2); end U; "
            "model M U b(redeclare function f = tenfold); end M;",
            r"the function w would not see what is given to f",
        ),
        (
            "function Seven extends Offset(o = 7); algorithm y := x + o; end Seven; model M Real y = "
            "Seven(1); end M;",
            r"what the function gives to o of its base class is lost",
        ),
        ("model M Real y = Greatest(2); end M;", r"max\(\) would call the built-in function"),
        (
            "model A Real y = 1; end A; model B Real y = 2; end B; model U outer model T = A; T t; end U; "
            "model M inner model T = B; U u; end M;",
            r"outer model: .*the class of the outer declaration",
        ),
        (
            "model U outer function f = once; Real y = f(2); end U; model M inner function f = tenfold; U "
            "u; end M;",
            r"outer function: .*the class of the outer declaration",
        ),
    ],
    ids=[
        "two media",
        "a medium by extends",
        "a medium by an element",
        "two aliases",
        "an imported alias",
        "two short functions",
        "two models' own",
        "an outer scope",
        "a constant",
        "a constant by extends",
        "a function of a function",
        "a base function",
        "a built-in name",
        "an outer model",
        "an outer function",
    ],
)
def test_what_would_be_mistaken_is_refused(declarations: str, message: str, tmp_path: Path) -> None:
    """Each gives a wrong number without a word if it is let through."""
    assert "R.mo:" in PACKAGE.refusal(tmp_path, declarations, message)


def test_functions_of_another_package_are_none_of_the_model(tmp_path: Path) -> None:
    """The compiler reads the files beside a library; a model of the same name there declares a function q."""
    (tmp_path / "Beside.mo").write_text(
        "package Beside function f input Real x; output Real y; algorithm y := x^2; end f; "
        "model Main replaceable function q = f; Real y = q(time); end Main; "
        "model Use Main b(redeclare function q = f); Real y = b.y; end Use; "
        "model T end T; model Law end Law; end Beside;",
        "utf-8",
    )
    declarations = (
        "model T Real y = time; end T; "
        "model Main replaceable model Law = T; Law law; parameter Real q = 7; Real y = q*law.y; end Main; "
        "model M Main m(redeclare model Law = T, q = 3); Real y = m.y; end M;"
    )
    assert PACKAGE.values(tmp_path, declarations, ["y"]) == {"y": 3.0}
