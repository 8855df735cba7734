"""Constants to which heirs give several values, and modifiers of inner classes: refused, or built right."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fmu_build.package_under_test import PackageUnderTest

PACKAGE = PackageUnderTest("""
package R
  partial package Frame
    constant Real c = 1;
    constant Real d = 2*c;
    function f
      input Real x;
      output Real y;
    algorithm
      y := c*x;
    end f;
  end Frame;
  partial package Middle
    extends Frame(c = 7);
  end Middle;
  package Seven
    extends Middle;
  end Seven;
  package Two
    extends Frame(c = 2);
  end Two;
  package Three
    extends Frame(c = 3);
  end Three;
  package Lower
    extends Middle(c = 3);
  end Lower;
  package Redeclared
    extends Frame;
    redeclare constant Real c = 3;
  end Redeclared;
  partial package Inner
    constant Real c = 1;
    type T = Real(start = c);
    model Part
      Real x = c*time;
    end Part;
  end Inner;
  package InnerTwo
    extends Inner(c = 2);
  end InnerTwo;
  package InnerThree
    extends Inner(c = 3);
  end InnerThree;
  package Steep
    extends Inner(T(start = 5));
  end Steep;
  package Calling
    extends Frame(c = 2);
    model Part
      Real x = f(time);
    end Part;
  end Calling;
  model User
    replaceable package P = Frame;
    Real y = P.d*time;
  end User;
  model UserOfTwo
    replaceable package P = Two constrainedby Frame;
    Real y = P.d*time;
  end UserOfTwo;
  model InnerUser
    replaceable package P = Inner;
    P.Part part;
  end InnerUser;
  model Typed
    replaceable package P = Inner;
    P.T x(fixed = true);
  equation
    der(x) = 0;
  end Typed;
  model Whole
    constant Real c = 1;
    constant Real d = 2*c;
    record Data
      Real a = d;
    end Data;
    model Own
      parameter Real k = 1;
      Real x = k*time;
    end Own;
    parameter Data data;
    Own own;
  end Whole;
  model M
    {}
  end M;
end R;
""")


@pytest.mark.parametrize(
    ("declarations", "values"),
    [
        (
            "User a(redeclare package P = Two); User b(redeclare package P = Three); "
            "User c(redeclare package P = Seven); Real f = Two.f(time) + 10*Three.f(time);",
            {"a.y": 4.0, "b.y": 6.0, "c.y": 14.0, "f": 32.0},
        ),
        ("InnerUser a(redeclare package P = InnerThree); Whole b;", {"a.part.x": 3.0, "b.data.a": 2.0}),
    ],
    ids=["two heirs", "one heir of a package with a model"],
)
def test_each_has_its_own_values(declarations: str, values: dict[str, float], tmp_path: Path) -> None:
    """By the specification: an heir's modifiers hold for all that it inherits (Modelica 3.6, section 7.2)."""
    assert PACKAGE.values(tmp_path, declarations, values) == values


@pytest.mark.parametrize(
    ("declarations", "message"),
    [
        ("Real a = Lower.c*time;", r"Lower.c is not 7"),
        ("Real a = Lower.f(time);", r"the function f differs in the compiler's reading"),
        ("Real a = Redeclared.c*time;", r"Redeclared.c is not 1"),
        (
            "UserOfTwo a; UserOfTwo b(redeclare package P = Three);",
            r"the equation P\.d \* time differs in the compiler's reading",
        ),
        (
            "InnerUser a(redeclare package P = InnerTwo); InnerUser b(redeclare package P = InnerThree);",
            r"c is not \d",
        ),
        ("Calling.Part a; Real b = Three.c;", r"the constant c in f cannot be checked"),
        ("Whole whole(c = 3);", r"the record Data would not see what is given to c"),
        ("Whole whole(Own(k = 3));", r"the value is 1 instead of 3"),
        (
            "Typed a(redeclare package P = Steep);",
            r"the class of a.x, which heirs of a package change, cannot be checked",
        ),
    ],
    ids=[
        "given twice",
        "given twice, in a function",
        "redeclared",
        "one by default",
        "a model of the package",
        "a function that is called inside an heir",
        "a record of a model",
        "a class of a model",
        "a type of a package",
    ],
)
def test_what_the_compiler_would_mix_up_is_refused(declarations: str, message: str, tmp_path: Path) -> None:
    PACKAGE.refusal(tmp_path, declarations, rf"R\.mo:\d+:\d+: .*{message}")
