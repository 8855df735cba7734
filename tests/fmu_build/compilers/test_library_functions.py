"""Functions of the Modelica Standard Library that are rewritten for rumoca."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fmu_build import build_fmu
from fmu_build.codegen.modelica_source.builtins import with_known_functions
from pyjoystick.fmu import Fmu

# As in Modelica.Math: declarations, with a search in both directions from the last place.
_LIBRARY = """package Functions
  function sin
    input Real u;
    output Real y;
  external "builtin" y = sin(u);
    annotation (Documentation(info="sine"));
  end sin;
  function atan2
    input Real u1;
    input Real u2;
    output Real y;
  external"builtin"  y =  atan2( u1, u2 ) ;
    annotation (Documentation(info="four quadrants"));
  end atan2;
  function tanh
    input Real u;
    output Real y;
  external "builtin" y = tanh(u);
    annotation ();
  end tanh;
  function interpolate
    input Real x[:];
    input Real y[size(x, 1)];
    input Real xi;
    input Integer iLast = 1;
    output Real yi;
    output Integer iNew = 1;
  protected
    Integer i;
    Integer nx = size(x, 1);
  algorithm
    if nx == 1 then
      yi := y[1];
    else
      i := min(max(iLast, 1), nx - 1);
      while i < nx and xi >= x[i] loop
        i := i + 1;
      end while;
      yi := y[i - 1] + (y[i] - y[i - 1])*(xi - x[i - 1])/(x[i] - x[i - 1]);
      iNew := i;
    end if;
    annotation (smoothOrder = 1);
  end interpolate;
  function firstTrueIndex
    input Boolean b[:];
    output Integer index;
  algorithm
     index :=0;
     for i in 1:size(b,1) loop
        if b[i] then
           index :=i;
           return;
        end if;
     end for;
      annotation ();
  end firstTrueIndex;
end Functions;
"""
_USER = """model User
  Real one, two, three, table, single, x(start = 0, fixed = true);
  Real first;
equation
  der(x) = 1;
  one = Functions.sin(x);
  two = Functions.atan2(x - 0.77, 0.5 - x);
  three = Functions.tanh(x);
  table = Functions.interpolate({0.5, 1, 1.5, 2.5}, {1, 2, 0, 4}, x, 1);
  single = Functions.interpolate({3}, {7}, x);
  first = Functions.firstTrueIndex({x > 2.05, x > 1.55 and x < 2.25, x > 0.75});
  annotation (uses(Functions(version = "1")));
end User;
"""


def _user(folder: Path, text: str) -> Fmu:
    library = folder / "libraries" / "Functions"
    library.mkdir(parents=True)
    (library / "package.mo").write_text(_LIBRARY)
    (folder / "User.mo").write_text(text)
    return Fmu(build_fmu("User", folder / "out", library=[folder / "User.mo", library]).path)


def test_known_functions_in_co_simulation(tmp_path: Path) -> None:
    """Against NumPy, with a table that continues its outer lines on both sides."""
    names = ["one", "two", "three", "table", "single", "first"]
    with _user(tmp_path, _USER) as fmu:
        result = fmu.run(np.linspace(0, 3, 31), outputs=names)
    x = result.index.to_numpy()
    table = np.interp(x, [-1, 0.5, 1, 1.5, 2.5, 4.5], [-2, 1, 2, 0, 4, 12])
    first = np.select([x > 2.05, (x > 1.55) & (x < 2.25), x > 0.75], [1, 2, 3], 0)
    expected = [np.sin(x), np.arctan2(x - 0.77, 0.5 - x), np.tanh(x), table, np.full_like(x, 7), first]
    for name, values in zip(names, expected, strict=True):
        np.testing.assert_allclose(result[name], values, atol=1e-12, err_msg=name)


_CHOICE = """model User
  parameter Real t[:, 2] = [0, 1; 10, 3];
  parameter Real e = abs(Functions.interpolate(t[:, 1], t[:, 2], 4));
  parameter Real c = if e > 1.5 and e < 2 then 5 else 7;
  Real x(start = c, fixed = true);
equation
  der(x) = 0;
  annotation (uses(Functions(version = "1")));
end User;
"""
_INDEX = """model User
  function both
    input Real x;
    output Real sum;
  protected
    Real y;
    Integer i;
  algorithm
    (y, i) := Functions.interpolate({0, 1, 2, 3}, {0, 1, 4, 9}, x);
    sum := y + 100*i;
  end both;
  Real x(start = 0.5, fixed = true), y = both(x);
equation
  der(x) = 1;
  annotation (uses(Functions(version = "1")));
end User;
"""


def test_a_parameter_that_others_branch_on_may_be_interpolated(tmp_path: Path) -> None:
    """As the friction of a gear of the Modelica Standard Library is: 1 + 2*4/10 is between 1.5 and 2."""
    with _user(tmp_path, _CHOICE) as fmu:
        assert fmu.run([0.0, 1.0], outputs=["x"])["x"].tolist() == [5.0, 5.0]


def test_the_index_of_an_interpolation(tmp_path: Path) -> None:
    """The interval is that in which x = 0.5, 1.5, 2.5 lies."""
    with _user(tmp_path, _INDEX) as fmu:
        result = fmu.run([0.0, 1.0, 2.0], outputs=["y"])
    np.testing.assert_allclose(result["y"], [100.5, 202.5, 306.5], rtol=1e-12)


@pytest.mark.parametrize("index", [True, False])
def test_lines_stay_in_place(index: bool) -> None:
    changed = with_known_functions(_LIBRARY, index=index)
    assert changed.count("\n") == _LIBRARY.count("\n")
    for line in ("  function tanh", "  end interpolate;"):
        assert changed.splitlines().index(line) == _LIBRARY.splitlines().index(line)


@pytest.mark.parametrize(
    "text",
    [
        'external "C" y = sin(u); annotation (Library = "mine");',
        'external "builtin" y = bessel(u); annotation ();',
        "for i in 1:n loop if x[i] > best then best := x[i]; return; end if; end for; end f;",
        "for i in 1:n loop if x[i] > 0 then k := i; return; end if; end for; k := n; end f;",
        "function interpolate input Real u; output Real y; algorithm y := u; annotation (); end interpolate;",
    ],
)
def test_other_functions_are_left_alone(text: str) -> None:
    assert with_known_functions(text) == text
