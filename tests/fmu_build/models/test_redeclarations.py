"""Modifiers of a declaration, and which of them a redeclaration keeps (section 7.3.2)."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import UnsupportedModelError
from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.request import BuildRequest
from tests.fmu_build.package_under_test import PackageUnderTest

PACKAGE = PackageUnderTest("""
package R
  model A
    parameter Real g = 1;
    parameter Real f = 0;
    Real z = g + f;
  end A;
  model B
    extends A;
    parameter Real w = 2;
  end B;
  model Component
    replaceable A h(g = 5);
  end Component;
  model ConstrainedComponent
    replaceable A c(g = 5) constrainedby A;
  end ConstrainedComponent;
  model Class
    replaceable model X = A(g = 5);
    X h;
  end Class;
  model ConstrainedClass
    replaceable model Y = A(g = 5) constrainedby A;
    Y h;
  end ConstrainedClass;
  model Inner
    Component c;
  end Inner;
  model M
    {}
  end M;
end R;
""")


def test_what_is_kept_and_what_is_dropped(tmp_path: Path) -> None:
    """What Modelica keeps has the value 5, what it drops 1."""
    values = {
        "Component a(redeclare B h);": 5.0,
        "Component b(redeclare replaceable B h(w = 3));": 5.0,
        "Component c(redeclare B h(g = 3));": 3.0,
        "ConstrainedComponent d(redeclare B c(g = 4));": 4.0,
        "ConstrainedClass e(redeclare model Y = B);": 1.0,
        "model Inside extends ConstrainedComponent; redeclare B c; end Inside; Inside f;": 1.0,
        "model Short extends ConstrainedClass; redeclare model Y = B; end Short; Short g;": 1.0,
        "model Again extends Component; redeclare B h(g = 7); end Again; Again i;": 7.0,
    }
    names = ["a.h.z", "b.h.z", "c.h.z", "d.c.z", "e.h.z", "f.c.z", "g.h.z", "i.h.z"]
    found = PACKAGE.values(tmp_path, "\n".join(values), names)
    assert found == dict(zip(names, values.values(), strict=True))


@pytest.mark.parametrize(
    ("declaration", "message"),
    [
        ("ConstrainedComponent a(redeclare B c);", r"5 instead of 1: .* a\.c\.g"),
        ("ConstrainedComponent a(redeclare B c(f = 1));", r"5 instead of 1: .* a\.c\.g"),
        ("Class a(redeclare model X = B);", r"1 instead of 5: .* a\.h\.g"),
        ("extends Class(redeclare model X = B);", r"1 instead of 5: .* h\.g"),
        ("extends Class; redeclare model X = B;", r"1 instead of 5: .* h\.g"),
        ("extends Component; redeclare B h;", r"1 instead of 5: .* h\.g"),
        ("extends Component; redeclare replaceable B h(f = 1);", r"1 instead of 5: .* h\.g"),
        ("Inner a(c(redeclare B h(g = 3)));", r"5 instead of 3: .* a\.c\.h\.g"),
        ("extends Inner(c(redeclare B h(g = 3)));", r"the variable c\.h\.w is lost"),
        (
            "Inner i(c(h(g = 2))); Inner j[2](c(redeclare replaceable B h));",
            r"the variable j\[1\]\.c\.h\.w is lost",
        ),
    ],
)
def test_what_the_compiler_would_get_wrong_is_refused(tmp_path: Path, declaration: str, message: str) -> None:
    PACKAGE.refusal(tmp_path, declaration, message)


@pytest.mark.parametrize(
    "declarations",
    [
        "model A parameter R r(a = 3); end A; model M A d(r = R(5, 6)); end M;",
        "model A parameter R r(a = 3); end A; model B = A(r = R(5, 6)); model M B d; end M;",
        "model A parameter R r[2](a = {3, 4}); end A; model M A d(r = {R(5, 6), R(7, 8)}); end M;",
        "model M R r(a = 3) = R(5, 6); end M;",
    ],
)
def test_a_record_over_members_with_values_is_refused(declarations: str, tmp_path: Path) -> None:
    """The compiler keeps a = 3."""
    file = tmp_path / "P.mo"
    file.write_text(f"package P record R Real a = 1; Real b = 2; end R; {declarations} end P;", "utf-8")
    with pytest.raises(UnsupportedModelError, match=r"P\.mo:1:\d+: the declaration of r gives a value to a"):
        generate_model(BuildRequest("P.M", tmp_path, file))
