"""The second reading of equations and connections: no fault of the compiler may pass.

A model that the compiler reads correctly is taken, and each of its equations is changed as a compiler might:
left out, or with another variable, sign, constant or function.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import rumoca

from fmu_build import UnsupportedModelError
from fmu_build.codegen.compiled import expressions
from fmu_build.codegen.lowered import lower
from fmu_build.codegen.second_reading.check import reject_other_values
from fmu_build.codegen.second_reading.clauses import mistaken_clauses
from fmu_build.codegen.second_reading.connections import Connections, mistaken_connections
from fmu_build.codegen.second_reading.equations import mistaken_equations
from fmu_build.codegen.second_reading.function_bodies import mistaken_functions
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.packages import mistaken_packages
from fmu_build.codegen.second_reading.scopes import Library

_SOURCE = """
package Q
  constant Real g = 9.81;
  constant Integer many = 2;
  package Constants constant Real h = g/2; constant Integer many = 3; end Constants;
  function f input Real x; output Real y; algorithm y := g*x; end f;
  function once input Real x; output Real y; algorithm y := x; end once;
  connector Pin Real v; flow Real i; end Pin;
  connector Plug Pin pin[2]; Real t[2]; flow Real q[2]; end Plug;
  connector In = input Real;
  connector Out = output Real;
  block Gain In u[2]; Out y[2]; equation y = Constants.h*u*g; end Gain;
  block Timer Out y = time; end Timer;
  partial model Two
    Pin a, b;
    Real u;
  equation
    u = a.v - b.v;
    a.i + b.i = 0;
  end Two;
  model Resistor
    extends Two;
    parameter Real r = 1;
    parameter Boolean isLinear = true;
  equation
    if isLinear then u = r*a.i; else u = r*a.i^3; end if;
  end Resistor;
  model Capacitor
    extends Two;
    parameter Real c = 1;
  initial equation
    u = g;
  equation
    c*der(u) = a.i;
  end Capacitor;
  model Cable
    Plug a, b;
    parameter Boolean hasInput = true;
    In u if hasInput;
    Resistor wire[2](r = {2, 3});
    Real total[many], sum2(start = 0, fixed = true);
  protected
    Timer clock if not hasInput;
    In own;
  equation
    connect(u, own);
    connect(clock.y, own);
    for i in 1:2 loop
      connect(a.pin[i], wire[i].a);
      connect(wire[i].b, b.pin[i]);
    end for;
    for i in 1:many loop
      total[i] = i*own;
    end for;
    a.t - b.t = a.q;
    a.q + b.q = {0, 0};
    if many > 1 and not hasInput then
      der(sum2) = f(own);
    elseif hasInput then
      der(sum2) = once(own)*Constants.h;
    else
      der(sum2) = 0;
    end if;
  end Cable;
  model Source
    Plug p;
  equation
    p.pin[1].v = 1;
    p.pin[2].v = 0;
    p.t = {1, 2};
  end Source;
  model Inside
    Plug a, b;
    In u;
    Cable cable;
  equation
    connect(a, cable.a);
    connect(cable.b, b);
    connect(u, cable.u);
  end Inside;
  model Counter
    parameter Real limit = 1;
    final parameter Boolean isTwice = true;
    Integer n(start = 0, fixed = true), m(start = 0, fixed = true);
    Real half;
  equation
    when time > limit then
      n = pre(n) + 1;
    elsewhen time > 2*limit then
      n = 0;
    end when;
    assert(limit < 10, "limit");
    if isTwice then
      when time > 3*limit then
        m = pre(m) + 1;
      end when;
      assert(limit > 0, "limit");
    end if;
  algorithm
    half := if n > 1 then limit/2 else 0;
  end Counter;
  model M
    Counter counterA, counterB, single;
    Inside x[2];
    Cable y(hasInput = false, wire(isLinear = {true, false}));
    Gain gain;
    Timer clocks[2];
    Source one, other;
    Plug outside;
    Capacitor capacitor;
  equation
    connect(clocks.y, gain.u);
    for i in 1:2 loop
      connect(x[i].u, gain.y[i]);
      connect(x[i].a, y.a);
    end for;
    connect(y.b.pin[2], x[1].b.pin[1]);
    connect(outside, x[2].b);
    connect(one.p, y.a);
    connect(other.p, outside);
    connect(capacitor.a, x[1].b.pin[2]);
    connect(capacitor.b, one.p.pin[2]);
  end M;
end Q;
"""


_CLAUSES = ("when_chains", "assert_equations", "algorithms")


class _Reading:
    """The second reading of a model, and what it finds if the compiler had made something else of it."""

    def __init__(self, file: Path) -> None:
        self.model = lower(rumoca.Session().load(str(file), model="Q.M"))
        self.flat = self.model.flat
        self._library = Library({number: text for number, (_, text) in self.model.sources.items()})
        self._instances = Instances(self._library, self._library.class_of(self.model.name))
        self._connections = Connections(self._instances)
        names = ("equations", "initial_equations", "functions", *_CLAUSES)
        self._trees = pickle.dumps({name: self.flat[name] for name in names})  # faster than deep copies

    def differences(self, change: Callable[[dict[str, Any]], object]) -> Iterator[object]:
        changed = replace(self.model, flat=self.changed(change))
        yield from mistaken_equations(changed, self._instances, [])
        yield from mistaken_connections(changed, self._connections)
        yield from mistaken_clauses(changed, self._instances, [])
        yield from mistaken_packages(changed, self._library, self._instances)
        yield from mistaken_functions(changed, self._instances, [], [])

    def finds(self, change: Callable[[dict[str, Any]], object] = lambda _: None) -> bool:
        """Whether there is a difference."""
        return next(self.differences(change), None) is not None

    def changed(self, change: Callable[[dict[str, Any]], object]) -> dict[str, Any]:
        flat = {**self.flat, **pickle.loads(self._trees)}
        change(flat)
        return flat


@pytest.fixture(scope="module")
def reading(tmp_path_factory: pytest.TempPathFactory) -> _Reading:
    file = tmp_path_factory.mktemp("second") / "Q.mo"
    file.write_text(_SOURCE)
    return _Reading(file)


def test_agreement(reading: _Reading) -> None:
    assert not reading.finds()
    reject_other_values(reading.model)


@pytest.mark.parametrize("kind", ["equations", "initial_equations"])
def test_lost_equations(reading: _Reading, kind: str) -> None:
    """Each equation is missed: those of components, of connections and of flows that nothing connects."""
    assert len(reading.flat["equations"]) > 90
    for place in range(len(reading.flat[kind])):
        assert reading.finds(lambda flat, place=place: flat[kind].pop(place)), reading.flat[kind][place]


def _references(flat: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """All names but those of connected potentials, of which others may mean the same."""
    for kind in ("equations", "initial_equations"):
        for equation in flat[kind]:
            if "Connection" not in equation["origin"]:
                yield from expressions(equation["residual"], "VarRef")


def test_other_variables(reading: _Reading) -> None:
    """Each name that means the variable of another component is found."""
    names = sorted({reference["name"]["name"] for reference in _references(reading.flat)})
    count = sum(1 for _ in _references(reading.flat))
    assert count > 190
    for place in range(count):
        reference = [*_references(reading.flat)][place]["name"]["name"]
        last = reference.rpartition(".")[2]
        other = next((one for one in names if one != reference and one.rpartition(".")[2] == last), None)
        if other is None:
            continue

        def change(flat: dict[str, Any], place: int = place, other: str = other) -> None:
            [*_references(flat)][place]["name"]["name"] = other

        assert reading.finds(change), (reference, other)


def test_signs_of_flows(reading: _Reading) -> None:
    sums = [place for place, one in enumerate(reading.flat["equations"]) if "FlowSum" in one["origin"]]
    assert len(sums) > 20
    for place in sums:

        def change(flat: dict[str, Any], place: int = place) -> None:
            tree = flat["equations"][place]["residual"]["Binary"]
            tree["rhs"] = {"Unary": {"op": "Minus", "rhs": tree["rhs"]}}

        assert reading.finds(change), reading.flat["equations"][place]["origin"]


def test_constants_of_packages(reading: _Reading) -> None:
    """Each constant that has another value is found; the iterators of loops are numbers, too."""
    names = ("g", "Constants.h", "many")
    for tree in ("equations", "functions"):
        found = [*expressions(reading.flat[tree], "Literal")]
        places = [place for place, one in enumerate(found) if reading.model.text(one["span"]) in names]
        assert places
        for place in places:

            def change(flat: dict[str, Any], tree: str = tree, place: int = place) -> None:
                literal = [*expressions(flat[tree], "Literal")][place]
                literal["value"] = {"Real": 7.0}

            assert reading.finds(change), reading.model.text(found[place]["span"])


def test_functions(reading: _Reading) -> None:
    calls = [*expressions(reading.flat["equations"], "FunctionCall")]
    names = {one["name"]["name"] for one in calls}
    assert len(names) == 2
    for place, call in enumerate(calls):
        (other,) = names - {call["name"]["name"]}

        def change(flat: dict[str, Any], place: int = place, other: str = other) -> None:
            [*expressions(flat["equations"], "FunctionCall")][place]["name"]["name"] = other

        assert reading.finds(change), call["name"]["name"]


def test_connected_potentials(reading: _Reading) -> None:
    """A connection with a variable that nothing connects is found."""
    places = [place for place, one in enumerate(reading.flat["equations"]) if "Connection" in one["origin"]]
    assert len(places) > 20
    for place in places:

        def change(flat: dict[str, Any], place: int = place) -> None:
            flat["equations"][place]["residual"]["Binary"]["lhs"]["VarRef"]["name"]["name"] = "capacitor.u"

        assert reading.finds(change), reading.flat["equations"][place]["origin"]


def test_lost_clauses(reading: _Reading) -> None:
    assert len(reading.flat["when_chains"]) == 6
    for place in range(6):
        assert reading.finds(lambda flat, place=place: flat["when_chains"].pop(place))


@pytest.mark.parametrize("kind", _CLAUSES)
def test_other_variables_in_clauses(reading: _Reading, kind: str) -> None:
    """Each name in a when-clause, an assertion or an algorithm is found if it means another component."""
    found = [*expressions(reading.flat[kind], "VarRef")]
    places = [place for place, one in enumerate(found) if "counter" in one["name"]["name"]]
    assert len(places) == {"when_chains": 10, "assert_equations": 4, "algorithms": 4}[kind]
    for place in places:

        def change(flat: dict[str, Any], place: int = place) -> None:
            name = [*expressions(flat[kind], "VarRef")][place]["name"]
            name["name"] = f"single.{name['name'].rpartition('.')[2]}"

        assert reading.finds(change), found[place]["name"]["name"]


def test_other_targets(reading: _Reading) -> None:
    def change(flat: dict[str, Any]) -> None:
        next(expressions(flat["when_chains"], "Assign"))["target"] = "single.n"

    assert reading.finds(change)


def test_message(reading: _Reading) -> None:
    changed = replace(reading.model, flat=reading.changed(lambda flat: flat["equations"].pop(0)))
    with pytest.raises(UnsupportedModelError, match=r"Q.mo:\d+:\d+: the equation .* is lost"):
        reject_other_values(changed)


def test_file(reading: _Reading, tmp_path: Path) -> None:
    """The places are right in files with other characters than ASCII."""
    file = tmp_path / "Q.mo"
    file.write_text("// Widerst\u00e4nde \u2192 Kabel\n" + _SOURCE, encoding="utf-8")
    assert not _Reading(file).finds()
