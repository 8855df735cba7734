"""Functions of the Modelica Standard Library that are written in another way for rumoca."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fmu_build import build_fmu
from fmu_build.modelica_source.builtins import with_known_functions
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


def test_known_functions_in_co_simulation(tmp_path: Path) -> None:
    """Against NumPy, with a table that continues its outer lines on both sides."""
    folder = tmp_path / "libraries" / "Functions"
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text(_LIBRARY)
    (tmp_path / "User.mo").write_text(_USER)
    built = build_fmu("User", tmp_path / "out", library=[tmp_path / "User.mo", folder])
    names = ["one", "two", "three", "table", "single", "first"]
    with Fmu(built.path) as fmu:
        result = fmu.run(np.linspace(0, 3, 31), outputs=names)
    x = result.index.to_numpy()
    table = np.interp(x, [-1, 0.5, 1, 1.5, 2.5, 4.5], [-2, 1, 2, 0, 4, 12])
    first = np.select([x > 2.05, (x > 1.55) & (x < 2.25), x > 0.75], [1, 2, 3], 0)
    expected = [np.sin(x), np.arctan2(x - 0.77, 0.5 - x), np.tanh(x), table, np.full_like(x, 7), first]
    for name, values in zip(names, expected, strict=True):
        np.testing.assert_allclose(result[name], values, atol=1e-12, err_msg=name)


def test_lines_stay_in_place() -> None:
    changed = with_known_functions(_LIBRARY)
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
