"""Packages that override constants of their base: accepted only where the values are right."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fmu_build.package_under_test import PackageUnderTest

PACKAGE = PackageUnderTest("""
package R
  partial package Frame
    constant Real c;
    constant Real d = 2*c;
  end Frame;
  package One
    extends Frame(c = 1);
  end One;
  package Three
    extends Frame(c = 3);
  end Three;
  package Plain
    constant Real c = 1;
    constant Real d = 2*c;
  end Plain;
  package Five
    extends Plain(c = 5);
  end Five;
  package Seven = Plain(c = 7);
  package Heir
    extends Plain;
    constant Real e = d + 1;
  end Heir;
  model Part
    constant Real c = 1;
    Real y = c*time;
  end Part;
  model Faster
    extends Part(c = 5);
  end Faster;
  model Outer
    parameter Real p = 1;
    Real y = p*time;
    model Inner Real z = 3*time; end Inner;
  end Outer;
  model OuterHeir
    extends Outer(p = 2);
    Outer.Inner inner_;
  end OuterHeir;
  model User
    replaceable package P = Plain;
    Real y = P.d*time;
  end User;
  model M
    {}
  end M;
end R;
""")


@pytest.mark.parametrize(
    ("declarations", "values"),
    [
        ("Real a = One.d*time; Real b = Three.d*time;", {"a": 2.0, "b": 6.0}),
        ("Real a = Five.d*time; Real b = Seven.d*time;", {"a": 10.0, "b": 14.0}),
        ("Real a = Heir.e*time; Real b = Plain.c*time;", {"a": 3.0, "b": 1.0}),
        ("Part p; Faster q; Part r(c = 9);", {"p.y": 1.0, "q.y": 5.0, "r.y": 9.0}),
        ("package Other = Plain; Real a = Other.c*time; Real b = Five.c*time;", {"a": 1.0, "b": 5.0}),
        ("OuterHeir h; Outer o;", {"h.y": 2.0, "h.inner_.z": 3.0, "o.y": 1.0}),
    ],
    ids=[
        "of a partial package",
        "heirs alone",
        "without a modifier",
        "components",
        "by another name",
        "parameters",
    ],
)
def test_each_has_its_own_values(declarations: str, values: dict[str, float], tmp_path: Path) -> None:
    """By the specification: an heir's modifiers hold for the heir (Modelica 3.6, section 7.2)."""
    assert PACKAGE.values(tmp_path, declarations, values) == values


@pytest.mark.parametrize(
    ("declarations", "message"),
    [
        ("Real a = Plain.c*time; Real b = Five.c*time;", "Plain.c is not 5"),
        ("Real a = Plain.c*time; Real b = Seven.c*time;", "Plain.c is not 7"),
        ("import R.Plain; Real b = Five.c*time; Real a = Plain.c*time;", "Plain.c is not 5"),
        (
            "User a; User b(redeclare package P = Five);",
            r"the equation P\.d \* time differs in the compiler's reading",
        ),
        ("Real a = Part.c*time; Real b = Faster.c*time;", "the constant Part.c in M cannot be checked"),
    ],
    ids=["by their names", "a short class", "imported", "replaced in one of two", "of models"],
)
def test_a_class_beside_an_heir_that_changes_it_is_refused(
    declarations: str, message: str, tmp_path: Path
) -> None:
    """The compiler gives both the values of the heir."""
    PACKAGE.refusal(tmp_path, declarations, message)
