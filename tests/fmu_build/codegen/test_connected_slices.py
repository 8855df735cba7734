"""Vectors as subscripts in connect(): rumoca connects the elements in the order of their declaration."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fmu_build.package_under_test import PackageUnderTest

PACKAGE = PackageUnderTest("""
package R
  connector O = output Real;
  connector I = input Real;
  type Order = Integer[3];
  constant Integer turned[3] = {3, 1, 2};
  function order
    output Integer p[3] = {3, 1, 2};
  algorithm
  end order;
  model A
    O y[3] = {1, 2, 3};
  end A;
  model B
    I u[3];
  end B;
  model One
    I u;
  end One;
  model Uses
    parameter Integer i[2] = {1, 2};
    Real y = i[1];
  end Uses;
  {}
end R;
""")


@pytest.mark.parametrize(
    ("declarations", "connections"),
    [
        ("", "connect(a.y[{3, 1, 2}], b.u);"),
        ("", "connect(a.y, b.u[{3, 1, 2}]);"),
        ("One c[3];", "connect(a.y, c[{3, 1, 2}].u); b.u = a.y;"),
        ("constant Integer p[3] = {3, 1, 2};", "connect(a.y[p], b.u);"),
        ("parameter Integer[3] p = {3, 1, 2};", "connect(a.y[p], b.u);"),
        ("parameter Order p = {3, 1, 2};", "connect(a.y[p], b.u);"),
        ("", "connect(a.y[turned], b.u);"),
        ("", "connect(a.y[R.turned], b.u);"),
        ("", "connect(a.y[order()], b.u);"),
        ("constant Integer p[3] = {2, 0, 1};", "connect(a.y[p .+ 1], b.u);"),
    ],
)
def test_vectors_are_refused(declarations: str, connections: str, tmp_path: Path) -> None:
    """All but the last two gave the elements in their own order, without a word."""
    model = f"model M A a; B b; {declarations} equation {connections} end M;"
    assert "R.mo:24:" in PACKAGE.refusal(tmp_path, model, r"a vector as a subscript in connect\(\)")


@pytest.mark.parametrize(
    ("declarations", "connections", "values"),
    [
        ("", "connect(a.y[1:3], b.u);", (1.0, 2.0, 3.0)),
        ("", "connect(a.y[2:3], b.u[1:2]); b.u[3] = a.y[1];", (2.0, 3.0, 1.0)),
        ("", "connect(a.y[3:-1:1], b.u);", (3.0, 2.0, 1.0)),
        ("", "for i in 1:3 loop connect(a.y[4 - i], b.u[i]); end for;", (3.0, 2.0, 1.0)),
        (
            "",
            "for i in 1:3 loop connect(a.y[1 + div(((i - 1)*(i + 2)), 4)], b.u[4 - i]); end for;",
            (3.0, 2.0, 1.0),
        ),
        # In other classes, i and k are arrays.
        ("Uses uses;", "for i in 1:3 loop connect(a.y[i], b.u[i]); end for;", (1.0, 2.0, 3.0)),
        (
            "parameter Integer k = 2; model S parameter Integer k[2] = {1, 2}; Real y = k[1]; end S; S s;",
            "connect(a.y[k], b.u[1]); connect(a.y[k + 1], b.u[2]); connect(a.y[k - 1], b.u[3]);",
            (2.0, 3.0, 1.0),
        ),
    ],
)
def test_ranges_numbers_and_loops_are_right(
    declarations: str, connections: str, values: tuple[float, ...], tmp_path: Path
) -> None:
    model = f"model M A a; B b; {declarations} equation {connections} end M;"
    names = [f"b.u[{i}]" for i in (1, 2, 3)]
    assert tuple(PACKAGE.values(tmp_path, model, names).values()) == values


@pytest.mark.parametrize("subscript", ["size(p, 1)", "mod(i, size(p, 1)) + 1"])
def test_numbers_from_functions_are_no_vectors(subscript: str, tmp_path: Path) -> None:
    """The compiler itself refuses them in connect()."""
    declarations = "A a; B b; parameter Integer p[3] = {7, 8, 9};"
    connections = f"for i in 1:3 loop connect(a.y[{subscript}], b.u[i]); end for;"
    model = f"model M {declarations} equation {connections} end M;"
    assert "a vector" not in PACKAGE.refusal(tmp_path, model, "connect")
