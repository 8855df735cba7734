"""Valid models that rumoca calls wrong are told to be unsupported; wrong ones remain errors of the source."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.errors import BuildError, ModelicaError, UnsupportedModelError
from fmu_build.support.request import BuildRequest

_V = "model V P p; equation p.v = 6; end V; model M V v; end M;"
_S = "model S parameter Real k = 1; Real y = k*time; end S; "
_C = "connector C Real v; flow Real i; end C; package P constant Integer n = 2; end P; "
_LOOP = "C a[2]; C p; equation for i in 1:{} loop connect(p, a[i]); end for; end M;"
_G = "block G input Real u; output Real y = u; end G; block S output Real y[3] = {1, 2, 3}*time; end S; "
_K = "package K constant Real k = 4; end K; "
_A = "package A0 constant Real k = 4; end A0; package A extends A0; end A; "
_CONNECTOR = "connector P is taken for unbalanced, 1 flow variable(s) vs "
_CONDITION = "the condition of s is not evaluated"

_HEIR = (
    "package P model S Real y = 2; end S; connector Pin Real v; flow Real i; end Pin; end P; "
    "package Q extends P; end Q;"
)

_VALID = {
    "a connector with a base": (
        "partial connector P0 Real v; end P0; connector P extends P0; flow Real i; end P;" + _V,
        _CONNECTOR + "0 potential variable(s): ",
    ),
    "a name of the component in a value that is given to it": (
        "model L parameter Boolean a = false; parameter Real p[2] = {1, 1}; parameter Real g = p[2]; end L;"
        "model D parameter Real a[2] = {1, 2}; L x(p = a); end D; model M D u; end M;",
        "the compiler takes a value for one of another type than its parameter",
    ),
    "a parameter in a connector": (
        "connector P parameter Real q = 1; Real v; flow Real i; end P;" + _V,
        "M.mo:1:1: the " + _CONNECTOR + "2",
    ),
    "a constant in a connector": (
        "connector P constant Real q = 1; Real v; flow Real i; end P;" + _V,
        _CONNECTOR + "2",
    ),
    "an input in a connector": (
        "connector P input Real q; Real v; flow Real i; end P;" + _V,
        _CONNECTOR + "2",
    ),
    "arrays in a connector": (
        "connector P Real v[3]; flow Real f[2]; flow Real g; end P; model M P p; end M;",
        "the connector P is taken for unbalanced, 2 flow variable(s) vs 1 potential variable(s): ",
    ),
    "an import of which nothing is used": (
        _K + "model M import K.*; Real y = time; end M;",
        "M.mo:1:47: import K.* is not supported where the model uses no name of K",
    ),
    "an import of inherited names": (
        _A + "model M import A.*; Real y = k; end M;",
        "import A.* is not supported where the model uses no name of A, or only inherited ones",
    ),
    "an import of an inherited name": (
        _A + "model M import A.k; Real y = k; end M;",
        "the import of A.k, a name that the package inherits, is not supported; write the full name",
    ),
    "a type with a computed size": (
        "package P constant Integer n = 2; type V = Real[n]; model B V v; equation v[1] = time; v[2] = 1; "
        "end B; end P; model M P.B b; end M;",
        "v has a type that is an array, whose size the compiler does not find",
    ),
    "the size of a type": (
        "package P constant Integer n = 2; connector V = output Real[n]; end P; "
        "model A P.V y; Real z = size(y, 1); equation y = {1, 2}; end A; model M A a; end M;",
        "the compiler does not find the size of a type that is an array",
    ),
    "an enumeration in a condition": (
        f"{_S} model M type E = enumeration(a, b); parameter E e = E.b; S s if e > E.a; end M;",
        _CONDITION,
    ),
    "a size in a condition": (
        f"{_S} model M parameter Real v[:] = {{1, 2}}; S s(k = 2) if size(v, 1) > 1; end M;",
        _CONDITION,
    ),
    "a parameter that is a size in a condition": (
        f"{_S} model M parameter Real v[:] = {{1, 2}}; parameter Integer n = size(v, 1); "
        "S s if n > 1; end M;",
        _CONDITION,
    ),
    "a function in a condition": (
        f"{_S} model M parameter Integer n = 2; S s if noEvent(n > 1); end M;",
        _CONDITION,
    ),
    "a constant of a package in a condition": (
        f"{_S} model M package K constant Boolean b = true; end K; S s if K.b; end M;",
        _CONDITION,
    ),
    "a constant of the package around in a condition": (
        f"{_S} package P constant Boolean on = true; model T S s if on; end T; end P; "
        "model M extends P.T; end M;",
        _CONDITION,
    ),
    "a loop over a constant of a package": (
        f"{_C} model M {_LOOP.format('P.n')}",
        "the range 1:P.n of a loop over connections is not evaluated; use numbers",
    ),
    "a loop over an imported constant": (
        f"{_C} model M import P.n; {_LOOP.format('n')}",
        "the range 1:n of a loop over connections is not evaluated",
    ),
    "a loop over a computed parameter": (
        f"{_C} model M parameter Integer n = P.n; {_LOOP.format('n')}",
        "the range 1:n of a loop over connections is not evaluated",
    ),
    "a loop over a size": (
        f"{_C} model M parameter Real r[:] = {{1, 2}}; {_LOOP.format('size(r, 1)')}",
        "the range 1:size(r, 1) of a loop over connections is not evaluated",
    ),
    "a redeclared array with a computed size": (
        f"{_C} {_S} model T extends S; end T; model D replaceable S s[P.n]; end D; "
        "model M D d(redeclare T s[P.n]); end M;",
        "the size of the array s is not evaluated in a redeclaration",
    ),
    "iterators in a matrix of components": (
        "model C parameter Integer i; Real y; equation y = i; end C; "
        "model M C a[2, 2](i = {{i for j in 1:2} for i in 1:2}); end M;",
        "as the compiler counts them; it miscounts a matrix of components whose modifier has iterators",
    ),
    "arrays in an array of components": (
        "model C Real y[2]; end C; model M C a[2]; equation a.y = {{1, 2}, {3, 4}}*time; end M;",
        "it miscounts equations for an array that is a member of an array of components",
    ),
    "a protected connector": (
        "connector H Real t; flow Real q; end H; model K H h; equation h.t = 4; end K; "
        "model C H h; protected H i; equation connect(h, i); i.q = -5; end C; "
        "model M C c; K k; equation connect(c.h, k.h); end M;",
        "as the compiler counts them; it counts one too many for a protected connector: connect a component",
    ),
    "a member that only the redeclaration has": (
        f"{_S} model T extends S; Real w = 2; end T; model D replaceable S c; end D; "
        "model M D d(redeclare T c); Real z; equation z = d.c.w; end M;",
        "w is looked up in the class before its redeclaration",
    ),
    "a constant of a package that a package redeclares": (
        "package P constant Real c = 1; end P; package O constant Real c = 9; end O; "
        "package F replaceable package Q = P; end F; package G extends F(redeclare package Q = O); end G; "
        "model M Real y = G.Q.c; end M;",
        "G.Q.c, a constant of a package that is redeclared in another package, is not supported",
    ),
    "a modifier with a function of an array": (
        "connector P Real v; flow Real i; end P; model A P p, n; parameter Real l = 1; "
        "equation p.v - n.v = l*p.i; p.i + n.i = 0; end A; "
        "model G P p; equation p.v = 0; end G; model S P p; equation p.i = -time; end S; "
        "function f input Real x[:]; output Real y; algorithm y := sum(x); end f; "
        "model M parameter Real r = 2; A a(l = f({r, 1})); G g; S s; "
        "equation connect(g.p, a.n); connect(s.p, a.p); end M;",
        "it miscounts some parameters that a function of an array gives",
    ),
    "a variable declared with a function of an array": (
        "model M function f input Real x; input Real t[:]; output Real y; algorithm y := x*t[1]; end f; "
        "parameter Real p[3] = {1, 0, 0.5}; Real y = f(time, p); Real s(start = 0, fixed = true); "
        "equation der(s) = y; end M;",
        "it miscounts some variables that are declared with a function of an array, such as this one",
    ),
    "a modifier beside a constraining clause": (
        "partial model O Real v; end O; model R extends O; parameter Real r = 1; equation v = r; end R; "
        "model G extends O; parameter Real g = 1; equation v = 1/g; end G; "
        "model A replaceable R r(r = 2) constrainedby O; end A; model M A a(redeclare G r(g = 3)); end M;",
        "the redeclared r gets the modifier r of the declaration",
    ),
    "arguments of a record with a constant": (
        "record I Real a; end I; record O constant Real k = 1; I i; end O; model M O o = O(I(time)); end M;",
        "the compiler counts final and constant members among the arguments of a record",
    ),
    "a modifier of a name with points": (
        "model A Real x(fixed = true); equation der(x) = -x; end A; model C A a; end C; "
        "model M extends C(a(x.start = 8)); end M;",
        "it miscounts modifiers of names with points",
    ),
    "an element of a class that a package inherits": (
        f"{_HEIR} model M Q.S s; Real z = s.y; end M;",
        "s.y: the package that names the class of s inherits this class",
    ),
    "a base class that a package inherits": (
        f"{_HEIR} model M extends Q.S; end M;",
        "Q.S is a class that the package Q inherits",
    ),
    "a class of a short package": (
        "package P constant Real k = 1; model S Real y = k; end S; end P; package Q = P(k = 2); "
        "model M Q.S s; end M;",
        "Q.S is a class that the package Q inherits",
    ),
    "a connector that a package inherits": (
        f"{_HEIR} model M Q.Pin a, b; equation connect(a, b); end M;",
        "Q.Pin is a class that the package Q inherits",
    ),
    "a constructor on the left": (
        "record R Real a; Real b; end R; model M R r; equation R(time, 2) = r; end M;",
        "it miscounts equations with a constructor on their left",
    ),
    "a short class of a partial class in a package": (
        "package P partial model A Real y = time; end A; model B = A; end P; model M P.B b; end M;",
        "the short class B is taken for partial",
    ),
    "a slice in a connection": (
        f"{_G} model M S s; G g[2]; equation connect(s.y[2:3], g.u); end M;",
        "it miscounts connections of a slice with a member of an array of components without a subscript",
    ),
}

_WRONG = {
    "an unbalanced connector": ("connector P Real v; Real w; flow Real i; end P;" + _V, "'P' is unbalanced"),
    "an import of a package that does not exist": ("model M import K.*; Real y = time; end M;", "'K.*'"),
    "an import of a name that does not exist": (
        _K + "model M import K.c; Real y = time; end M;",
        "unresolved import: 'K.c'",
    ),
    "a subscript of a scalar": ("model M Real v; equation v[1] = time; end M;", "`v` has 0 dimension"),
    "a wrong name beside a type with a computed size": (
        "package P constant Integer n = 2; type V = Real[n]; model B V v; Real z = v[1] + true; "
        "equation v = {1, 2}; end B; end P; model M P.B b; end M;",
        "operator `+`",
    ),
    "a condition that changes": (
        f"{_S} model M Real x = time; S s if x > 1; end M;",
        "the condition of s must consist of constants and parameters",
    ),
    "a loop over a variable": (
        f"{_C} model M Integer n = integer(time) + 1; {_LOOP.format('n')}",
        "the range 1:n of a loop over connections must consist of numbers, parameters and constants",
    ),
    "arguments of a record in another order": (
        "record I Real a; end I; record O Real k = 1; I i; end O; model M O o = O(I(time), 1); end M;",
        "type mismatch: expected `Real`, found `I`",
    ),
    "too few equations": (
        "model C Real y[2]; end C; model M C a[2]; Real x; equation a[1].y = {1, 2}; end M;",
        "unbalanced model",
    ),
}


def _refused(source: str, folder: Path) -> BuildError:
    (folder / "M.mo").write_text(source)
    with pytest.raises(BuildError) as caught:
        generate_model(BuildRequest("M", folder, folder / "M.mo"))
    return caught.value


@pytest.mark.parametrize(("source", "message"), _VALID.values(), ids=list(_VALID))
def test_valid(source: str, message: str, tmp_path: Path) -> None:
    error = _refused(source, tmp_path)
    assert type(error) is UnsupportedModelError, error
    assert message in str(error)


@pytest.mark.parametrize(("source", "message"), _WRONG.values(), ids=list(_WRONG))
def test_wrong(source: str, message: str, tmp_path: Path) -> None:
    error = _refused(source, tmp_path)
    assert type(error) is ModelicaError, error
    assert message in str(error)
