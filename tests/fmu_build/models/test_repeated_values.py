"""Two values for one thing are refused: in one modifier, and from two bases that share one (section 7.1)."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fmu_build.package_under_test import PackageUnderTest

PACKAGE = PackageUnderTest("""
package R
  model D
    parameter Real k = 1;
    parameter Real j = 10;
    Real y = k + j;
  end D;
  model F
    extends D(k = 3);
  end F;
  model G
    extends D(k = 4);
  end G;
  model H
    extends D(k  =  3);
  end H;
  model J
    extends D(j = 20);
  end J;
  {}
end R;
""")


@pytest.mark.parametrize(
    ("bases", "y"),
    [
        ("extends F; extends H;", 13.0),
        ("extends F(k = 5); extends G(k = 5);", 15.0),
        ("extends F(j = 20); extends J(k = 3);", 23.0),
        ("F f; G g; Real y = f.y + g.y - 14;", 13.0),
        ("model P = D(k = 3); model Q = D(k = 4); P p; Q q; Real y = p.y + q.y - 14;", 13.0),
        ("model P = D(k = 3); extends D; P p;", 11.0),
    ],
)
def test_a_base_that_is_inherited_twice_with_the_same_values(bases: str, y: float, tmp_path: Path) -> None:
    assert PACKAGE.values(tmp_path, f"model M {bases} end M;", ["y"]) == {"y": y}


@pytest.mark.parametrize(
    ("bases", "name"),
    [
        ("extends F; extends G;", "k"),
        ("extends F; extends D;", "k"),
        ("extends F(k = 5); extends G;", "k"),
        ("extends F(k = 5); extends F;", "k"),
        ("extends J; extends D(j = 21);", "j"),
    ],
)
def test_a_base_that_is_inherited_twice_with_different_values(bases: str, name: str, tmp_path: Path) -> None:
    found = PACKAGE.refusal(
        tmp_path, f"model M {bases} end M;", f"M inherits [DF] twice, with different values of {name}"
    )
    assert "R.mo:20:3: " in found


def test_two_values_in_one_modifier(tmp_path: Path) -> None:
    twice = (
        "model M Real z[2](each start = 3, each fixed = true, start = {1, 2}); "
        "equation der(z) = {1, 1}; end M;"
    )
    assert "R.mo:20:11: " in PACKAGE.refusal(tmp_path, twice, "start is given two values")
    once = twice.replace(", start = {1, 2}", "")
    assert PACKAGE.values(tmp_path, once, ["z[1]"]) == {"z[1]": 4.0}
