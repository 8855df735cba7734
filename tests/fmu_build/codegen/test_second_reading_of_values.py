"""What a second reading of the source computes: expressions, and constants that heirs of a package change."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import pytest
import rumoca

from fmu_build import UnsupportedModelError
from fmu_build.codegen.compiled import expressions
from fmu_build.codegen.lowered import LoweredModel, lower
from fmu_build.codegen.modelica_source.text import blanked
from fmu_build.codegen.second_reading import scopes
from fmu_build.codegen.second_reading.arithmetic import Chosen, value_of
from fmu_build.codegen.second_reading.check import reject_other_values
from fmu_build.codegen.second_reading.gathered import indexed
from fmu_build.codegen.second_reading.operations import UnknownError, Value, as_value
from fmu_build.codegen.second_reading.syntax import TOKEN, Class
from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.request import BuildRequest
from tests.fmu_build.package_under_test import PackageUnderTest

_VARIABLES = {"x": 2.0, "y": -3.0, "v": [1.0, 2.0, 3.0], "m": [[1.0, 2.0], [3.0, 4.0]]}


class _Names:
    """Some variables, all of which are random."""

    def __init__(self, *, is_smooth: bool) -> None:
        self.is_smooth = is_smooth

    def is_random(self, reference: Chosen) -> bool:
        return reference[0][0] in _VARIABLES

    def value(self, reference: Chosen) -> Value:
        ((name, subscripts),) = reference
        if name not in _VARIABLES:
            raise UnknownError
        return indexed(as_value(_VARIABLES[name]), subscripts)

    def sizes(self, reference: Chosen) -> Sequence[int]:
        return self.value(reference).shape

    def applied(self, operator: str, reference: Chosen) -> Value:
        return 10 * self.value(reference) if operator == "der" else self.value(reference)

    def called(
        self, name: str, arguments: Sequence[Value], named: Mapping[str, Value], place: int
    ) -> Value | None:
        return as_value(sum([*arguments, *named.values()])) if name == "f" else None

    def member(self, name: str, result: Value, members: Sequence[str]) -> Value:
        return result[int(name == "f")] if members == ("a",) else as_value(0)


def _value(text: str, *, is_smooth: bool = False) -> object:
    return value_of(tuple(TOKEN.findall(blanked(text))), _Names(is_smooth=is_smooth)).tolist()


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-2^2*3", -12.0),
        ("1 - 2 - 3", -4.0),
        ("12/2/3", 2.0),
        ("2 + 3*x^2", 14.0),
        ("if x > 1 and not y > 0 or false then 4 elseif true then 5 else 6", 4.0),
        ("v*v", 14.0),
        ("m*{1, 2}", [5.0, 11.0]),
        ("{1, 2}*m", [7.0, 10.0]),
        ("m*m", [[7.0, 10.0], [15.0, 22.0]]),
        ("m .* m", [[1.0, 4.0], [9.0, 16.0]]),
        ("v .+ 1", [2.0, 3.0, 4.0]),
        ("v[2:end]", [2.0, 3.0]),
        ("m[end, :]", [3.0, 4.0]),
        ("m[:, {2, 1}]", [[2.0, 1.0], [4.0, 3.0]]),
        ("[v[1:2], v[2:3]; 7, 8]", [[1.0, 2.0], [2.0, 3.0], [7.0, 8.0]]),
        ("sum(i^2 for i in 1:3)", 14.0),
        ("{i + 10*j for i in 1:2, j in 1:3}", [[11.0, 12.0], [21.0, 22.0], [31.0, 32.0]]),
        ("max(v) + min(x, y)", 0.0),
        ("cat(1, v, {4})", [1.0, 2.0, 3.0, 4.0]),
        ("transpose(m)", [[1.0, 3.0], [2.0, 4.0]]),
        ("cross({1, 0, 0}, {0, 1, 0})", [0.0, 0.0, 1.0]),
        ("size(m, 2) + size(v, 1)", 5.0),
        ("mod(-7, 3) + rem(-7, 3) + div(-7, 3)", -1.0),
        ("der(x) + pre(y)", 17.0),
        ("f(1, b = x)", 3.0),
        ("1:2:7", [1.0, 3.0, 5.0, 7.0]),
        ("smooth(0, noEvent(x))", 2.0),
        ("homotopy(simplified = 1, actual = x)", 2.0),
        ("z", None),
        ("v + 1", None),
        ("v[4]", None),
        ('"a" == "b"', None),
    ],
)
def test_expressions(text: str, value: object) -> None:
    """By the rules of Modelica 3.6, chapters 3 and 10; None is unknown."""
    if value is None:
        with pytest.raises(UnknownError):
            _value(text)
    else:
        assert _value(text) == value


@pytest.mark.parametrize(
    ("one", "other", "agree"),
    [
        ("if x > 5 then 1 else 2", "if x > 6 then 1 else 2", False),
        ("if x > 5 then 1 else 2", "if x > 5 then 1 else 3", False),
        ("if x > 5 then 1 else 2", "if not x <= 5 then 1 else 2", True),
        ("if x > 5 and y > 1 then 1 else 2", "if y > 1 and 5 < x then 1 else 2", True),
        ("if true then x else y", "x", True),
        ("floor(x/100)", "floor(x/200)", False),
        ("min(x, 50)", "min(x, 60)", False),
        ("min(x, 50)", "min(50, x)", True),
    ],
)
def test_branches_that_do_not_hold(one: str, other: str, agree: bool) -> None:
    """At a smooth point, expressions differ if they can differ at all."""
    first, second = (_value(text, is_smooth=True) for text in (one, other))
    assert isinstance(first, float)
    assert isinstance(second, float)
    assert math.isclose(first, second) == agree


def _generate(text: str, folder: Path) -> None:
    file = folder / "M.mo"
    file.write_text(text)
    generate_model(BuildRequest("M", folder, file))


#: Of B, k is 1.5 and c is 3; rumoca takes 7 and 14 in components.
_HEIRS = """
package Base constant Real k=7; constant Real c=2*k; constant Integer n=3; constant Integer m=n+1;
  constant Real w[2]={{k, 3*k}}; constant Real u[2]={{1, 2}}; constant String s="a"; end Base;
package B extends Base(k=1.5, n=1, u={{2, 1}}, s="b"); end B;
function f input Real x; output Real y; algorithm y:=x; end f;
model C {} end C;
model M C b; end M;
"""


@pytest.mark.parametrize(
    "body",
    [
        "Real y; equation y=B.c;",
        "Real y; equation y=B.c+5-3;",
        "Real y; equation y=3*B.c;",
        "Real y; equation y=sin(B.c);",
        "Real y; equation y=f(B.c);",
        "Real y; equation y=if time<2 then B.c else 0;",
        "Real y; equation y=if time>B.c then 1 else 2;",
        "Real y; equation y=sum({B.c, 1});",
        "Real y; equation y=B.w[2];",
        "Real y; equation y=B.u[1];",
        "Real y; equation y=if B.m==2 then 1 else 2;",
        'Real y; equation if B.s=="b" then y=2; else y=1; end if;',
        'Real y; equation y=if B.s=="b" then 2 else 1;',
        "Real y; equation if time<2 then y=B.c; else y=0; end if;",
        "Real v[2]; equation for i in 1:2 loop v[i]=i*B.c; end for;",
        "Real y; algorithm y:=B.c;",
        "discrete Real y(start=0, fixed=true); equation when time>0.5 then y=B.c; end when;",
        "discrete Real y(start=0, fixed=true); equation when time>B.c then y=1; end when;",
        "Real y(start=0, fixed=true); equation der(y)=0; when time>0.5 then reinit(y, B.c); end when;",
        'Real y=time; equation assert(time < B.c, "late");',
        "Real y(start=0); initial equation if time<1 then y=B.c; else y=0; end if; equation der(y)=0;",
    ],
)
def test_constants_of_heirs(body: str, tmp_path: Path) -> None:
    """Those that depend on what an heir changes are refused, wherever they stand."""
    with pytest.raises(UnsupportedModelError):
        _generate(_HEIRS.format(body), tmp_path)


def test_an_assertion_on_constants_of_two_heirs(tmp_path: Path) -> None:
    text = (
        "partial package Base constant Real k; constant Real c=2*k; end Base; "
        "package A extends Base(k=4); end A; package B extends Base(k=0.5); end B; "
        'model M Real y=B.c; equation assert(time<B.c+0.5 and time<A.c, "x"); end M;'
    )
    with pytest.raises(UnsupportedModelError):
        _generate(text, tmp_path)


def test_a_file_that_cannot_be_read_hides_nothing(tmp_path: Path) -> None:
    """A broken file in the folder of a model that is read wrongly."""
    (tmp_path / "Broken.mo").write_text("model Broken Real x equation")
    with pytest.raises(UnsupportedModelError, match=r"B\.c"):
        _generate(_HEIRS.format("Real y; equation y=B.c;"), tmp_path)


def test_a_base_with_the_name_of_its_heir(tmp_path: Path) -> None:
    package = PackageUnderTest("""
package R
  package Q
    model C extends R.C(q=2); end C;
  end Q;
  model C parameter Real q=1; end C;
  model M
    {}
  end M;
end R;
""")
    assert package.values(tmp_path, "extends Q.C; Real y=q*time;", {"y": 2.0}) == {"y": 2.0}


_NOWHERE = {"source": 0, "start": 0, "end": 0}


def _lowered(text: str, folder: Path) -> LoweredModel:
    file = folder / "M.mo"
    file.write_text(text)
    return lower(rumoca.Session().load(str(file), model="M"))


@pytest.mark.parametrize(
    ("variable", "attribute"),
    [("x", "start"), ("x", "min"), ("x", "max"), ("x", "nominal"), ("b", "start")],
)
@pytest.mark.parametrize("other", [None, {"Literal": {"value": {"Real": 0.0}, "span": _NOWHERE}}])
def test_attributes(variable: str, attribute: str, other: object, tmp_path: Path) -> None:
    """Also those that follow from parameters, and those of Booleans."""
    model = _lowered(
        "model M parameter Real p=2; Real x(start=3*p, fixed=true, min=-p, max=50*p, nominal=p); "
        "Boolean b(start=true, fixed=true); equation der(x)=-x; when x < 1 then b=false; end when; end M;",
        tmp_path,
    )
    reject_other_values(model)
    model.flat["variables"][variable][attribute] = other
    with pytest.raises(UnsupportedModelError, match=rf"the {attribute} value .* of {variable}, or"):
        reject_other_values(model)


def test_integer_parameters_of_the_same_value(tmp_path: Path) -> None:
    """One in the place of another is found, although both are 2."""
    model = _lowered(
        "model M parameter Integer m=2; parameter Integer n=2; Real y; equation y=n*time + m; end M;",
        tmp_path,
    )
    reject_other_values(model)
    for reference in expressions(model.flat["equations"], "VarRef"):
        if reference["name"]["name"] == "n":
            reference["name"]["name"] = "m"
    with pytest.raises(UnsupportedModelError, match="n means m"):
        reject_other_values(model)


def test_a_file_of_the_model_that_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = _lowered("model M Real y=time; equation end M;", tmp_path)

    def read(text: str, number: int) -> Iterator[tuple[str, Class]]:
        raise SyntaxError("a word is missing")

    monkeypatch.setattr(scopes, "read_classes", read)
    with pytest.raises(UnsupportedModelError, match="the file cannot be checked: a word is missing"):
        reject_other_values(model)


_RECORDS = """
record R parameter Real a=1; end R;
record S extends R; parameter Real c=a+1; end S;
model C parameter S s; Real y=s.c*time; end C;
{}
"""


@pytest.mark.parametrize(
    "model",
    [
        "model M parameter S q=S(a=5); Real c=q.c*time; end M;",
        "model M parameter S q=S(5); Real c=q.c*time; end M;",
        "model M parameter Real p=5; parameter S q=S(a=p); Real c=q.c*time; end M;",
        "model M C c(s=S(a=5)); end M;",
        "model B parameter S q; C c(s=q); end B; model M B b(q=S(a=5)); end M;",
        "record T parameter S s=S(a=6); end T; model M T t; Real c=t.s.c*time; end M;",
        "model M parameter S t[2]={S(a=6), S(a=2)}; Real c=t[1].c*time; end M;",
    ],
)
def test_members_that_follow_others_of_a_constructor(model: str, tmp_path: Path) -> None:
    """Of S(a=5), c is 6 (section 12.6); rumoca takes the a of R."""
    with pytest.raises(UnsupportedModelError):
        _generate(_RECORDS.format(model), tmp_path)


@pytest.mark.parametrize(
    "model",
    [
        "model M parameter S q=S(a=5, c=16); Real c=q.c*time; end M;",
        "model M parameter S q(a=5); Real c=q.c*time; end M;",
        "model M parameter R q=R(5); Real c=q.a*time; end M;",
        "model A parameter Real k=1; Real y; end A; model B extends A(k=3); equation y=2*k*time; end B; "
        "model D replaceable A t[2]; Real y=t[1].y+t[2].y; end D; model M D d(redeclare B t[2]); end M;",
        "model I input Real u; output Real y=2*u; end I; "
        "model O I a(u=u); input Real u; output Real y=a.y; end O; model M O o(u=time); end M;",
    ],
)
def test_values_that_are_passed_on(model: str, tmp_path: Path) -> None:
    _generate(_RECORDS.format(model), tmp_path)


@pytest.mark.parametrize(
    "model",
    [
        "model M Real v[2, 2] = time*{i for i in 1:2, j in 1:2}; end M;",
        "function f input Real w[:]; output Real y[size(w, 1), size(w, 1)]; "
        "algorithm y := {w[i] for i in 1:size(w, 1), j in 1:size(w, 1)}; end f; "
        "model M Real v[2, 2] = f({1, 3*time}); end M;",
    ],
)
def test_several_iterators(model: str, tmp_path: Path) -> None:
    """The first one belongs to the last dimension (section 10.4.1.1); rumoca takes the first dimension."""
    with pytest.raises(UnsupportedModelError, match="differs in the compiler's reading"):
        _generate(model, tmp_path)


def test_several_iterators_of_a_symmetric_matrix(tmp_path: Path) -> None:
    _generate("model M Real v[2, 2] = time*{1/(i + j - 1) for i in 1:2, j in 1:2}; end M;", tmp_path)


_MEDIA = """
package Base
  constant Real k = 7; constant Integer n = 2; constant Real b = 2*k; constant Real a[n] = fill(k, n);
end Base;
model T replaceable package Medium = Base; {} end T;
model M T t(redeclare package Medium = Base({})); end M;
"""


@pytest.mark.parametrize(
    "equation",
    ["Real y = time*Medium.b;", "Real y = time*sum(Medium.a);", "Real v[Medium.n] = time*Medium.a;"],
)
def test_packages_that_are_redeclared_with_modifiers(equation: str, tmp_path: Path) -> None:
    """What follows from `k` has its new value; rumoca takes that of Base."""
    with pytest.raises(UnsupportedModelError, match="differs in the compiler's reading"):
        _generate(_MEDIA.format(equation, "k = 2"), tmp_path)


_CLAUSE = "extends S(redeclare replaceable package Medium = Base constrainedby Base(k = 9));"


@pytest.mark.parametrize("model", ["T t(redeclare package Medium = W);", "T t;", _CLAUSE])
def test_modifiers_of_a_constraining_clause(model: str, tmp_path: Path) -> None:
    """They hold for the default and for what replaces it (section 7.3.2); rumoca forgets them."""
    text = (
        "package Base constant Real k = 3; constant Real j = 2; end Base; package W = Base(j = 4); "
        "model S replaceable package Medium = Base constrainedby Base; Real y = Medium.k*time; end S; "
        "model T replaceable package Medium = Base constrainedby Base(k = 9); Real y = Medium.k*time; end T; "
    )
    with pytest.raises(UnsupportedModelError, match=r"Medium\.k is not 3"):
        _generate(f"{text} model M {model} end M;", tmp_path)


_BASES = """
package P constant Real k = 1; model A Real y = k*time; end A; end P;
package Q extends P(k = 3); model B extends {}; end B; end Q;
model M Q.B b; end M;
"""


def test_bases_by_their_full_names(tmp_path: Path) -> None:
    """The `k` of `P.A` is that of P, that of the inherited `A` the one of Q (section 5.6.1)."""
    _generate(_BASES.format("A"), tmp_path)
    with pytest.raises(UnsupportedModelError, match="k is not 3"):
        _generate(_BASES.format("P.A"), tmp_path)


@pytest.mark.parametrize("model", ["T t;", "T t(redeclare function f = h);"])
def test_modifiers_of_a_constraining_clause_of_a_function(model: str, tmp_path: Path) -> None:
    text = (
        "function g input Real x; input Real a = 1; output Real y = a*x; algorithm end g; "
        "function h input Real x; input Real a = 1; output Real y = 2*a*x; algorithm end h; "
        "model T replaceable function f = g constrainedby g(a = 7); Real y = f(time); end T; "
    )
    with pytest.raises(UnsupportedModelError, match="differs in the compiler's reading"):
        _generate(f"{text} model M {model} end M;", tmp_path)


def test_packages_that_are_redeclared_with_modifiers_that_change_nothing_else(tmp_path: Path) -> None:
    _generate(_MEDIA.format("Real y = time*Medium.k;", "k = 2"), tmp_path)
