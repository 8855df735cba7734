"""The second reading of records and functions: whole values, constructors, several results, free sizes."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import rumoca

from fmu_build import UnsupportedModelError
from fmu_build.codegen.compiled import expressions
from fmu_build.codegen.lowered import LoweredModel, lower
from fmu_build.codegen.second_reading.check import reject_other_values
from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.request import BuildRequest

_SOURCE = """
package Q
  constant Real g = 9.81;
  record Inner Real a = 7; Real b = 2; end Inner;
  record Outer Real k = 1; Inner inside; Real v[2]; end Outer;
  record Longer extends Inner; Real c = 3; end Longer;
  function scaled input Real x; input Real k = 4; output Real y; algorithm y := k*x; end scaled;
  function tripled = scaled(k = 3);
  type Kind = enumeration(low, high);
  function cell input Real t[:, 2]; input Integer k; output Real y;
  algorithm y := t[k, 2] + t[k + 1, 1]; end cell;
  function square input Real x; output Real y;
  algorithm y := x*x; annotation (derivative = slope); end square;
  function slope input Real x; input Real dx; output Real dy; algorithm dy := 2*x*dx; end slope;
  function swapped input Inner x; output Inner y; algorithm y := Inner(x.b, g*x.a); end swapped;
  function norm input Inner x; input Real w = 0.5; output Real y; algorithm y := w*(x.a^2 + x.b^2); end norm;
  function twice
    input Real x[:];
    input Integer n = 2;
    output Real s;
    output Real y[size(x, 1)];
    output Real part;
  protected
    Real steps[n];
    Real total = 0;
  algorithm
    for i in 1:n loop
      total := total + x[i];
      steps[i] := 3*total;
    end for;
    y := 2*x;
    s := sum(x);
    part := steps[1] + total;
  end twice;
  function both
    input Real u;
    output Real y;
  protected
    Real p, q[2];
  algorithm
    (p, q, y) := twice({u, 5*u});
    y := y + p + q[1];
  end both;
  model Part
    input Outer o;
    Real y = o.inside.a + o.v[2];
  end Part;
  model M
    Inner plain = Inner(time, 6);
    Inner named = Inner(b = 8*time);
    Inner copy = plain;
    Inner made = swapped(plain);
    Inner chosen = if time > 1 then plain else Inner(11, 12);
    Outer outer1 = Outer(13, Inner(time, 14), {15, 16});
    Longer longer = Longer(17, 18);
    Inner several[2] = {plain, Inner(19, 20)};
    Part part(o = outer1);
    parameter Real weights[Kind] = {26, 27};
    Real weighted = weights[Kind.high]*time;
    Real largest = max(second[i] for i in 1:2);
    Real total = sum(several[i].a for i in 1:2);
    Real taken = cell([28, 29; 30, time], 1);
    Real squared = square(time);
    Real speed = der(squared);
    Real p, q[2], r, z, length, first, second[2], third;
  equation
    (p, q, r) = twice({time, 21});
    (first, second, third) = twice({time, 22}, 2);
    z = both(time) + tripled(23) + scaled(time);
    length = norm(plain) + norm(swapped(Inner(24, time))) + norm(outer1.inside, 25);
  end M;
end Q;
"""


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> LoweredModel:
    file = tmp_path_factory.mktemp("records") / "Q.mo"
    file.write_text(_SOURCE)
    return lower(rumoca.Session().load(str(file), model="Q.M"))


def test_everything_is_computed(model: LoweredModel) -> None:
    assert reject_other_values(model) == []


def _trees(flat: dict[str, Any]) -> list[Any]:
    """The equations, also those of declarations, and the functions; constructors get all arguments."""
    bindings = [one["binding"] for one in flat["variables"].values() if one["binding"] is not None]
    functions = [one for one in flat["functions"].values() if not one["is_constructor"]]
    return [bindings, flat["equations"], functions]


def _is_found(model: LoweredModel, change: Callable[[list[Any]], object]) -> bool:
    """Whether a change is refused, or named by the note on what could not be computed."""
    flat = dict(model.flat)
    for name in ("variables", "equations", "functions"):
        flat[name] = pickle.loads(pickle.dumps(flat[name]))  # faster than deep copies
    change(_trees(flat))
    try:
        return bool(reject_other_values(replace(model, flat=flat)))
    except UnsupportedModelError:
        return True


def test_other_numbers(model: LoweredModel) -> None:
    literals = [*expressions(_trees(model.flat), "Literal")]
    assert len(literals) > 40
    for place, literal in enumerate(literals):
        value = {"Integer": 1 if literal["value"].get("Integer") == 2 else 2}

        def change(trees: list[Any], place: int = place, value: object = value) -> None:
            [*expressions(trees, "Literal")][place]["value"] = value

        assert _is_found(model, change), model.text(literal["span"])


def test_other_variables(model: LoweredModel) -> None:
    """Each name is replaced by that of a variable with the same sizes that only an equation determines."""
    references = [*expressions(_trees(model.flat)[:2], "VarRef")]
    assert len(references) > 35
    for place, reference in enumerate(references):
        name = reference["name"]["name"]
        sizes = model.flat["variables"].get(name, {"dims": []})["dims"]
        other = next(one for one in (("second", "q") if sizes else ("third", "z")) if one != name)

        def change(trees: list[Any], place: int = place, other: str = other) -> None:
            [*expressions(trees[:2], "VarRef")][place]["name"]["name"] = other

        assert _is_found(model, change), (name, other)


def test_other_members(model: LoweredModel) -> None:
    accesses = [*expressions(_trees(model.flat), "FieldAccess")]
    assert len(accesses) >= 4
    for place, access in enumerate(accesses):

        def change(trees: list[Any], place: int = place) -> None:
            one = [*expressions(trees, "FieldAccess")][place]
            one["field"] = "b" if one["field"] == "a" else "a"

        assert _is_found(model, change), access["field"]


def _refused(text: str, folder: Path) -> str:
    file = folder / "M.mo"
    file.write_text(text)
    with pytest.raises(UnsupportedModelError) as caught:
        generate_model(BuildRequest("M", folder, file))
    return str(caught.value)


_NESTED = """
record I Real a = 1; Real b = 2; end I;
record O Real k = 1; I i(a = 7); end O;
{}
"""


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ("model M O c = O(2, I(5, 6)); end M;", "7 instead of 5"),
        ("model M O c = O(2, I(5*time, 6)); end M;", "7 instead of 5 * time"),
        ("model M O c = if time > 1 then O(2, I(5, 6)) else O(3, I(4, 6)); end M;", "7 instead of"),
        ("model S parameter O d; end S; model M parameter O e(k = 3, i(a = 6)); S s(d = e); end M;",
         "7 instead of 6"),
        ("record P = O(k = 9); model M parameter P p = P(i = I(4)); end M;", "7 instead of 4"),
        ("record N I i[2](b = {5, 5}); end N; model M N n = N({I(time, 2), I(time, 6)}); end M;",
         "5 instead of 2"),
        ("model M O o[2] = {O(3, I(time, 2)), O(4, I(1, 6))}; end M;", "7 instead of time"),
        ("record N extends O(i(b = 5)); end N; model M N n = N(3, I(time, 6)); end M;", "instead of"),
        ("record J parameter Real a = 7; end J; record N J i; parameter Real c = i.a; end N; "
         "function f input N u; output Real y; algorithm y := u.c; end f; "
         "model M Real z = f(N(J(3))); end M;", "the equation f(N(J(3))) differs"),
    ],
)  # fmt: skip
def test_values_of_whole_records(model: str, message: str, tmp_path: Path) -> None:
    """They hold instead of those in the declarations of members (section 7.2.3); rumoca takes these."""
    assert message in _refused(_NESTED.format(model), tmp_path)


def test_arguments_of_a_short_class(tmp_path: Path) -> None:
    """The members of `P` have the order of those of `S`; rumoca takes the inherited one for the last."""
    records = (
        "record R parameter Real a=1; end R; record S extends R; parameter Real b=3; end S; record P=S(a=2);"
    )
    assert "instead of" in _refused(f"{records} model M parameter Real q=5; P c=P(q, q+1); end M;", tmp_path)


def test_values_over_final_members(tmp_path: Path) -> None:
    """A final member is no argument, and keeps its value; modifiers further out than a whole value hold."""
    file = tmp_path / "M.mo"
    file.write_text("""
      record R final parameter Real a = 3; parameter Real b; end R;
      record I parameter Real a = 1; end I;
      record O parameter Real k = 1; I i = I(a = 2); end O;
      model M parameter R c = R(b = 2); parameter R d = c; parameter O e(k = 3, i(a = 6)); end M;
    """)
    generate_model(BuildRequest("M", tmp_path, file))


_FUNCTIONS = """
function f input Real x; input Real k = 1; output Real y; algorithm y := k*x; end f;
function g = f(k = 1.5);
{}
"""


@pytest.mark.parametrize(
    "model",
    [
        "function h = g; model M Real b = h(2.0); end M;",
        "model M function h = g; Real b = h(2*time); end M;",
        "model F replaceable function h = f; Real y = h(2.0); end F; "
        "model M F n(redeclare function h = g); end M;",
        "model F replaceable function h = g; Real y = h(2.0); end F; model M F n; end M;",
    ],
)
def test_defaults_of_short_functions(model: str, tmp_path: Path) -> None:
    """The default of `k` is 1.5 through all names of g; rumoca takes 1 through some."""
    assert "differs in the compiler's reading" in _refused(_FUNCTIONS.format(model), tmp_path)


def test_a_note_on_what_is_not_computed(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text("""
      package P
        partial function Of input Real x; output Real y; end Of;
        function double extends Of; algorithm y := 2*x; end double;
        function applied input Of f; input Real x; output Real y; algorithm y := f(x); end applied;
      end P;
      model M Real y = P.applied(function P.double(), time); end M;
    """)
    _, log = generate_model(BuildRequest("M", tmp_path, file))
    assert "Not computed by the second reading" in log
    assert "P.applied(function P.double(), time) in M; the function P.applied." in log


_PACKAGES = """
package Q
  package Base
    constant Real k = 1;
    function f input Real x = k; output Real y = x + k; algorithm end f;
  end Base;
  package Third = Base(k = 3);
  package Fifth extends Base(k = 5); end Fifth;
  model A replaceable package P = Base; Real y = P.f()*time; Real z = P.f(7)*time; end A;
  model M A a(redeclare package P = Third); A b(redeclare package P = Fifth); A c; end M;
end Q;
"""


def test_functions_of_redeclared_packages(tmp_path: Path) -> None:
    """Each has the constants of its package; those of another one, or its function, are found."""
    file = tmp_path / "Q.mo"
    file.write_text(_PACKAGES)
    model = lower(rumoca.Session().load(str(file), model="Q.M"))
    assert reject_other_values(model) == []
    literals = [*expressions(_trees(model.flat), "Literal")]
    for place, literal in enumerate(literals):
        for other in {1, 3, 5} - {literal["value"]["Integer"]}:

            def change(trees: list[Any], place: int = place, other: int = other) -> None:
                [*expressions(trees, "Literal")][place]["value"] = {"Integer": other}

            assert _is_found(model, change), (place, other)
    calls = [one["name"]["name"] for one in expressions(_trees(model.flat), "FunctionCall")]
    assert len({*calls}) == 3
    for place, call in enumerate(calls):
        for name in {*calls} - {call}:

            def rename(trees: list[Any], place: int = place, name: str = name) -> None:
                [*expressions(trees, "FunctionCall")][place]["name"]["name"] = name

            assert _is_found(model, rename), (call, name)


def test_inputs_before_an_extends_clause(tmp_path: Path) -> None:
    """They come first (section 5.6.1); rumoca begins with the inherited ones."""
    message = _refused(
        "partial function G input Real a; output Real y; end G; "
        "function f input Real b; extends G; algorithm y := 10*a + b; end f; "
        "function h = f; model M Real y = h(5*time, 6); end M;",
        tmp_path,
    )
    assert "the equation h(5 * time, 6) differs" in message


_EXTENDED = """
package P
  replaceable partial function g input Real x; output Real y; end g;
  function h input Real x; output Real y; algorithm y := g(x) + 31; end h;
end P;
package Q
  extends P;
  redeclare function extends g algorithm y := 32*x; end g;
end Q;
package R
  extends P(redeclare function g = f(k = 2));
  function f input Real x; input Real k = 1; output Real y; algorithm y := k*x; end f;
end R;
model M Real y = {}.h(time); end M;
"""


def test_functions_that_heirs_redeclare(tmp_path: Path) -> None:
    """Those that extend the inherited one are computed; of others, rumoca takes the wrong defaults."""
    file = tmp_path / "M.mo"
    file.write_text(_EXTENDED.format("Q"))
    _, log = generate_model(BuildRequest("M", tmp_path, file))
    assert "Not computed" not in log
    assert "the function h differs" in _refused(_EXTENDED.format("R"), tmp_path)
