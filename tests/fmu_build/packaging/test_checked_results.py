"""The values of an FMU are compared with the source: whatever differs from it is found."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from fmu_build import UnsupportedModelError, build_fmu
from fmu_build.codegen import check_results
from fmu_build.codegen.second_reading.results import Row, mistaken_results
from fmu_build.compilers.rumoca import generate_model
from fmu_build.packaging import package_fmu
from fmu_build.support.description import GeneratedModel
from fmu_build.support.request import BuildRequest

_SOURCE = """
package P
  function f "With a loop, a branch, an array and a default"
    input Real u;
    input Real k = 3;
    output Real y;
  protected
    Real v[3] = {u, 2*u, 3*u};
    Real t;
  algorithm
    t := k;
    for i in 1:3 loop
      v[i] := v[i] + i*t;
      if i == 2 then t := t + 1; end if;
    end for;
    y := v[1] + v[2]*v[3];
  end f;
  function two input Real u; output Real a; output Real b; algorithm a := 2*u; b := a + 1; end two;
  record R Real a; Real b = 2; end R;
  connector Pin Real v; flow Real i; end Pin;
  model Resistor
    parameter Real R = 2;
    Pin p; Pin n;
  equation
    p.v - n.v = R*p.i;
    p.i + n.i = 0;
  end Resistor;
  model Ground Pin p; equation p.v = 0; end Ground;
  model Source Pin p; equation p.v = 5 + time; end Source;
  model M
    parameter Real k = 4;
    parameter Boolean on = k > 3;
    parameter Integer n = 2;
    type Mode = enumeration(low, high);
    parameter Mode mode = Mode.high;
    Real x(start = 1, fixed = true);
    Real y = f(x);
    Real z[2];
    Real a;
    Real b;
    Real w = if on then sum(z) else 0;
    Boolean late = time > 0.5;
    Real m = if mode == Mode.high then n*time else -1;
    Resistor r1;
    Resistor r2(R = 3);
    Ground ground;
    Source source;
    Real q;
    Real h[2];
    Real s;
    R r = R(k*x);
    parameter R c = if n > 1 then R(a = k, b = 7) else R(b = 1, a = 2);
    Real e = c.a*r.b;
  initial equation
    s = 2*x + k;
  algorithm
    if x > 0.5 then
      q := 2*x;
    else
      q := 3*x;
    end if;
  algorithm
    for i in 1:2 loop
      h[i] := i*x;
    end for;
  equation
    der(x) = -k*x + 0.5;
    der(s) = 0;
    for i in 1:2 loop
      z[i] = i*x + (if late then 1 else 0);
    end for;
    (a, b) = two(x);
    connect(source.p, r1.p);
    connect(r1.n, r2.p);
    connect(r2.n, ground.p);
  end M;
end P;
"""
_TIMES = (0.0, 0.13, 0.31, 0.71, 0.9)


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("results") / "P.mo"
    path.write_text(_SOURCE, "utf-8")
    return path


@pytest.fixture(scope="module")
def generated(file: Path) -> GeneratedModel:
    return generate_model(BuildRequest("P.M", file.parent / "out", file))[0]


@pytest.fixture(scope="module")
def rows(file: Path) -> list[Row]:
    from pyjoystick import Fmu

    path = build_fmu("P.M", file.parent / "fmu", library=[file]).path
    with Fmu(path) as fmu:
        names = [name for name in fmu.description.variables if name != "time"]
        table = fmu.run(_TIMES, outputs=names)
    return [(time, {name: float(table[name][time]) for name in names}) for time in _TIMES]


def _changed(rows: list[Row], name: str) -> list[Row]:
    def other(values: Mapping[str, float]) -> dict[str, float]:
        value = values[name]
        is_whole = name in ("n", "mode", "on", "late")
        return {**values, name: 1.0 - value if is_whole else 1.001 * value + 0.001}

    return [(time, other(values)) for time, values in rows]


def test_right_results_pass(generated: GeneratedModel, rows: list[Row]) -> None:
    assert list(mistaken_results(generated.texts, "P.M", rows)) == []
    check_results(generated, rows)


@pytest.mark.parametrize(
    "name",
    [
        *(
            "k",
            "on",
            "n",
            "mode",
            "x",
            "der(x)",
            "y",
            "z[1]",
            "z[2]",
            "a",
            "b",
            "w",
            "late",
            "m",
            "q",
            *("s", "r.a", "r.b", "c.a", "c.b", "e"),
            "der(s)",
            "h[1]",
            "h[2]",
        ),
        *(
            "r1.R",
            "r1.p.v",
            "r1.p.i",
            "r1.n.v",
            "r1.n.i",
            "r2.R",
            "r2.p.v",
            "r2.n.i",
            "ground.p.v",
            "source.p.v",
        ),
    ],
)
def test_each_other_value_is_found(name: str, generated: GeneratedModel, rows: list[Row]) -> None:
    assert list(mistaken_results(generated.texts, "P.M", _changed(rows, name)))


@pytest.mark.parametrize(
    ("name", "number", "message"),
    [("x", 1.0, "x starts at 1.002 in the FMU"), ("k", 4.0, "k is 4.005 in the FMU, and 4. in the source")],
)
def test_a_message_has_both_values(
    name: str, number: float, message: str, generated: GeneratedModel, rows: list[Row]
) -> None:
    assert rows[0][1][name] == number
    found = list(mistaken_results(generated.texts, "P.M", _changed(rows, name)))
    assert any(one.startswith(message) for one in found), found


def test_every_value_has_been_tried(rows: list[Row]) -> None:
    tried = {*test_each_other_value_is_found.pytestmark[0].args[1]}  # type: ignore[attr-defined]
    others = {"r1.n.i", "r2.p.i", "r2.n.v", "ground.p.i", "source.p.i"}
    assert {*rows[0][1]} <= tried | others


def test_an_error_at_one_time_may_be_a_relation_in_doubt(generated: GeneratedModel, rows: list[Row]) -> None:
    once = [*rows[:2], *_changed(rows[2:3], "late"), *rows[3:]]
    assert list(mistaken_results(generated.texts, "P.M", once)) == []


@pytest.mark.parametrize(
    ("pattern", "other", "named"),
    [
        (r"5\.0 \+ ", "5.5 + ", "source"),
        (r"\* 3\.0|3\.0 \* ", lambda found: found[0].replace("3.0", "3.1"), ""),
        (r"\+ 0\.5\b|0\.5 - ", lambda found: found[0].replace("0.5", "0.6"), r"late = time > 0\.5"),
    ],
)
def test_an_error_of_the_generator_ends_the_build(
    pattern: str, other: str, named: str, generated: GeneratedModel, tmp_path: Path
) -> None:
    source, count = re.subn(pattern, other, generated.c_source)
    assert count
    wrong = replace(generated, c_source=source)
    with pytest.raises(
        UnsupportedModelError, match=rf"P\.M: .*the result of the FMU does not fulfil .*{named}"
    ):
        package_fmu(wrong, BuildRequest("P.M", tmp_path), partial(check_results, wrong))
    assert not [*tmp_path.glob("*.fmu")]


def test_rounding_and_initial_events_are_no_errors(tmp_path: Path) -> None:
    """What is left of zero has no digit that is right, in equations, in parameters and at a double root.

    Discrete variables may leave their start values at once.
    """
    file = tmp_path / "M.mo"
    file.write_text(
        """
        model M
          parameter Real p1 = 1e5, p2 = 1e5, k = 2;
          Real m(start = 1), n(start = 1);
          Integer mode(start = 3, fixed = true) = if pre(mode) == 3 then -1 else pre(mode);
          parameter Real a = 0.1, v[21] = {0.1*i for i in -10:10}, s = sum(v), e = 0.7^4 - 0.7*0.7*0.7*0.7;
          Real z = a^(-3) - 1/a^3;
          Real w = 0.1*3 - 0.3;
          Real l[2, 2] = {{0.1, 0.2}, {0.3, 0.7}}*{{7, -2}, {-3, 1}} - {{0.1, 0}, {0, 0.1}};
          function hyp input Real x; output Real y; algorithm y := cosh(x)^2 - sinh(x)^2 - 1; end hyp;
          parameter Real h = hyp(0.7), b = 0.1^(-3), c = 1/0.1^3, d = b - c, g = d*1e6;
          Real x;
          Integer i(start = 0, fixed = true);
        initial equation
          der(x) = 0;
        equation
          i = if x > -1 then min(pre(i) + 1, 2) else pre(i);
          der(x) = -x + pre(i);
          p1 - p2 = k*m*abs(m);
          0 = n*abs(n);
        end M;
        """,
        "utf-8",
    )
    assert build_fmu("M", tmp_path, library=[file]).path.exists()
