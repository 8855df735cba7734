"""The second reading of a model's source: against an instantiator of its own, and what it refuses."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from fmu_build import ModelicaError, UnsupportedModelError
from fmu_build.codegen.second_reading.instances import Instances
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.request import BuildRequest
from tests.fuzz.models.hierarchies import hierarchy
from tests.fuzz.models.writer import Writer


def _instances(text: str, model: str = "M") -> Instances:
    library = Library({0: text})
    return Instances(library, library.class_of(model))


def _values(text: str) -> dict[str, object]:
    """What the second reading finds, by variable: a value, or a start value."""
    found = _instances(text)
    assert not found.mistakes
    return {
        name: found.value(leaf.given if leaf.given.value else leaf.given.inner["start"]).tolist()
        for name, leaf in found.leaves.items()
    }


@pytest.mark.parametrize("seed", range(200))
def test_random_hierarchies(seed: int) -> None:
    """Classes of classes with modifiers of modifiers, which the fuzzer instantiates itself."""
    writer = Writer(Random(seed))
    hierarchy(writer)
    found = _values("\n".join(("model M", *writer.package, *writer.declarations, "end M;")))
    assert writer.observed
    for name, value in writer.meaning.steps:
        assert found[name] == value({}), name


def test_scopes_of_values() -> None:
    """A name in a modifier means a variable of the component in which the modifier stands."""
    assert _values("""
        model M
          model S parameter Real F = 1; parameter Real k = F/2; end S;
          model P parameter Real F = 3; S s[2](F = {F, 2*F}, each k = 4); S q(F = 2*F); end P;
          P p(F = 7, s(k = {8, 9}));
        end M;""") == {
        "p.F": 7.0,
        "p.s[1].F": 7.0,
        "p.s[1].k": 8.0,
        "p.s[2].F": 14.0,
        "p.s[2].k": 9.0,
        "p.q.F": 14.0,
        "p.q.k": 7.0,
    }


def test_types_sizes_and_imports() -> None:
    assert _values("""
        package Q
          package T type Angle = Real(start = 4); type Small = Angle(max = 1); end T;
          model A
            import T = Q.T;
            parameter Integer n = 2;
            T.Small x(min = 0);
            T.Angle v[n](start = {5, 6});
            A2 b[n - 1](c = -2^2*(1 - 0.5e1)) if n > 1 and not (n == 4 or n <> 3);
            A2 d if n <= 2;
          end A;
          model A2 parameter Real c = 1; end A2;
        end Q;
        model M
          extends Q.A(n = 3, v(start = {7, 8, 9}));
        end M;""") == {"n": 3.0, "x": 4.0, "v": [7.0, 8.0, 9.0], "b[1].c": 16.0, "b[2].c": 16.0}


def test_each() -> None:
    """``each`` holds for all that is in its modifier, at the array at which it stands."""
    assert _values("""
        model M
          model A Real x[2](each start = 7); parameter Real k = 1; end A;
          model B A a[2](k = {5, 6}); end B;
          A a[2](each x(start = {1, 2}), k = {3, 4});
          B b[2](each a(k = {8, 9}));
          B c(a(each k = 2));
        end M;""") == {
        **{f"a[{i}].x": [1.0, 2.0] for i in (1, 2)},
        "a[1].k": 3.0,
        "a[2].k": 4.0,
        **{f"b[{i}].a[{j}].x": 7.0 for i in (1, 2) for j in (1, 2)},
        **{f"b[{i}].a[{j}].k": 7.0 + j for i in (1, 2) for j in (1, 2)},
        **{f"c.a[{j}].x": 7.0 for j in (1, 2)},
        **{f"c.a[{j}].k": 2.0 for j in (1, 2)},
    }


def test_redeclared_components() -> None:
    """The type stands in the scope of the redeclaration; what the declaration gives is kept."""
    assert _values("""
        package Q
          model A parameter Real k = 1; end A;
          model C replaceable A a(k = 4); end C;
          model D extends C; redeclare B a(k = 3); model B extends A; end B; A c; end D;
        end Q;
        model M
          model A extends Q.A(k = 6); parameter Real z = k; end A;
          Q.C c(redeclare A a(z = 8));
          Q.C e(redeclare A a);
          Q.D d;
        end M;""") == {"c.a.k": 4.0, "c.a.z": 8.0, "e.a.k": 4.0, "e.a.z": 4.0, "d.a.k": 3.0, "d.c.k": 1.0}


def test_redeclared_classes() -> None:
    """A replaceable class is what the modifiers around say; those of its default remain (section 7.3.2)."""
    assert _values("""
        model M
          model A parameter Real k = 1; end A;
          model B = A(k = 2);
          model C replaceable model D = A(k = 9); D d; D e(k = 5); end C;
          model F extends C(redeclare model D = B); D f; end F;
          C c(redeclare model D = B);
          F f(redeclare model D = A);
          F g;
          C h;
        end M;""") == {
        "c.d.k": 9.0,
        "c.e.k": 5.0,
        "f.d.k": 9.0,
        "f.e.k": 5.0,
        "f.f.k": 9.0,
        "g.d.k": 9.0,
        "g.e.k": 5.0,
        "g.f.k": 9.0,
        "h.d.k": 9.0,
        "h.e.k": 5.0,
    }


def test_modifiers_of_a_short_class_are_not_read_in_it() -> None:
    """In ``model X = Y(k = p)``, p is not that of Y, but that of the class around."""
    found = _instances("""
        model M
          constant Real p = 3;
          model Y parameter Real p = 1; parameter Real k = 2; end Y;
          model X = Y(k = p);
          X x;
        end M;""")
    assert found.value(found.leaves["x.k"].given) == 3


def test_what_is_not_known_is_left_out() -> None:
    found = _instances("""
        model M
          model A parameter Real k = 1; end A;
          model B = A(k = 2);
          model C
            replaceable A a constrainedby A;
            replaceable A f constrainedby A(k = 3);
            replaceable package D end D;
            D.X d;
            A e;
          end C;
          C c(redeclare B a, redeclare B f);
          outer C o;
        end M;""")
    assert found.leaves.keys() == {"c.a.k", "c.f.k", "c.e.k"}
    assert found.value(found.leaves["c.f.k"].given) == 3
    assert not found.mistakes


#: Declarations of a model M, and what the message must say.
_LOST = {
    "the branch of a connection": (
        "connector P Real v; flow Real i; end P; model R P p; equation p.v=p.i; end R; "
        "model V P p; equation p.v=6; end V; parameter Boolean t=true; parameter Boolean f=false; "
        "R a; R b; V v; equation if if t then f else true then connect(v.p, a.p); "
        "else connect(v.p, b.p); end if;",
        "the equation a.p.i = 0 of connections is lost: the compiler has misread a connection",
    ),
    "a parameter after an array that gets the same name": (
        "model Res parameter Real R=1; end Res; model Line Res r[3](R={1,2,3}); parameter Real R=100; "
        "end Line; Line t(R=5);",
        "the value is 100 instead of 5: the compiler has lost or misplaced a modifier of t.R",
    ),
    "a start value for a variable beside a component": (
        "model Wall Real T(start=270,fixed=true); equation der(T)=0; end Wall; model Room Wall wall; "
        "Real T(start=290,fixed=true); equation der(T)=0; end Room; model House Room r(wall(T(start=300))); "
        "Real T(start=250,fixed=true); equation der(T)=0; end House; House h(T(start=280));",
        "the start value is 280 instead of 290: the compiler has lost or misplaced a modifier of h.r.T",
    ),
    "the same, redeclared": (
        "model A parameter Real p=17; Real w(start=2,fixed=true); equation der(w)=0; end A; "
        "model C extends A; end C; model B extends A(p=1); replaceable A a(w(start=10*p)); end B; "
        "B b(redeclare C a);",
        "the start value is 170 instead of 10: the compiler has lost or misplaced a modifier of b.a.w",
    ),
    "an expression in a class that extends that of the component": (
        "model A parameter Real p=17; Real w(start=2,fixed=true); equation der(w)=0; end A; "
        "model B extends A(p=1); A a(w(start=10*p)); end B; B b;",
        "the start value is 170 instead of 10: the compiler has lost or misplaced a modifier of b.a.w",
    ),
}


#: Declarations in which names are written that the compiler writes differently.
_RIGHT = {
    "slices": "model A parameter Real k=1; end A; A a[3](k={1,2,3}); Real y = sum(a[2:3].k);",
    "inner and outer": "model W parameter Real g=1; Real v=g; end W; model B outer W w; end B; "
    "inner W w(g=5); B b; Real y = b.w.v;",
}


@pytest.mark.parametrize("declarations", _RIGHT.values(), ids=_RIGHT.keys())
def test_other_names_for_the_same(declarations: str, tmp_path: Path) -> None:
    _generate(declarations, tmp_path)


@pytest.mark.parametrize(("declarations", "message"), _LOST.values(), ids=_LOST.keys())
def test_lost_modifiers(declarations: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedModelError) as caught:
        _generate(declarations, tmp_path)
    assert message in str(caught.value)


_INVALID = {
    "an unknown name in a nested modifier": (
        "model A parameter Real k=1; end A; model B A a; end B; B b(a(q=3));",
        "A has no element q, which b.a is given",
    ),
    "in an extends clause": (
        "model A parameter Real k=1; end A; model B extends A(q=3); end B; B b;",
        "A has no element q, which b is given",
    ),
    "in a short class": (
        "model A parameter Real k=1; end A; model B = A(q=3); B b;",
        "A has no element q, which b is given",
    ),
    "an unknown attribute": (
        "model A Real x(start=1,fixed=true); equation der(x)=0; end A; A a(x(strat=3));",
        "M.mo:2:69: a.x has no attribute strat",
    ),
    "another value for what is final": (
        "model A parameter Real k=1; end A; model B A a(final k=2); end B; "
        "model C extends B(a(k=5)); end C; C c;",
        "c.a.k is final and cannot be given another value",
    ),
    "a constant without a value": (
        'model A constant String s = "text"; constant Real c; end A; A a;',
        "the constant a.c has no value",
    ),
    "connectors with different variables": (
        "connector P Real v; flow Real i; end P; connector Q Real v; flow Real i; Real w; flow Real j; "
        "end Q; model A P p; equation p.v=1; end A; model B Q p; equation p.i=1; p.w=1; end B; A a; B b; "
        "equation connect(a.p, b.p);",
        "a.p and b.p have different variables",
    ),
    "two bases with different classes of one name": (
        "model A model S Real y=1; end S; S s; end A; model B model S Real y=2; end S; S t; end B; "
        "model C extends A; extends B; end C; C c;",
        "C has two classes S that differ",
    ),
    "a variable of a base, declared again": (
        "model A parameter Real k=1; end A; model B extends A; parameter Real k=2; end B; B b;",
        "b.k is declared in A and in B, differently",
    ),
}


@pytest.mark.parametrize(("declarations", "message"), _INVALID.values(), ids=_INVALID.keys())
def test_invalid_modifiers(declarations: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(ModelicaError) as caught:
        _generate(declarations, tmp_path)
    assert message in str(caught.value)


#: Packages with a model M in which the compiler looks names up in the wrong class, and the message.
_PACKAGE = """
package P constant Real k=2; constant Integer n=2; {} end P;
model S Real y=time; end S;
model M {} end M;
"""
_MISPLACED = {
    "a constant in an equation of a base": (
        "model B Real y; equation y=k; end B;",
        "extends P.B; parameter Real k=3;",
        "k in B, which M inherits, would mean the k of M",
    ),
    "in a size": (
        "model B Real v[n](each start=1, each fixed=true); equation der(v)=-v; end B;",
        "extends P.B; parameter Integer n=3;",
        "the sizes of v are [3] instead of [2]",
    ),
    "in a range": (
        "model B Real y; equation y=sum(i for i in 1:n); end B;",
        "extends P.B; parameter Integer n=5;",
        "n in B, which M inherits, would mean the n of M",
    ),
    "in a modifier": (
        "model S parameter Real p=1; Real y=p; end S; model B S a(p=k); end B;",
        "extends P.B; parameter Real k=3;",
        "the value is 3 instead of 2",
    ),
    "in a condition": (
        "constant Boolean on=true; model S Real y=1; end S; model B S s if on; end B;",
        "extends P.B; parameter Boolean on=false;",
        "the variable s.y is lost",
    ),
    "a qualified constant, captured by a component": (
        "package C constant Real k=2; end C; record K Real k=9; end K; model B Real y; "
        "equation y=C.k; end B;",
        "extends P.B; P.K C;",
        "C in B, which M inherits, would mean the C of M",
    ),
    "in a function": (
        "function f input Real x; output Real y; algorithm y:=k*x; end f;",
        "function g extends P.f; protected Real k=7; end g; Real s=g(time);",
        "k, which f does not declare, means the k of the function that extends it",
    ),
    "in a package": (
        "package Q constant Real b=k+3; end Q; package R extends Q; constant Real k=100; end R;",
        "Real y=P.R.b;",
        "the equation P.R.b differs in the compiler's reading",
    ),
    "the default of a record": (
        "record R Real a=k; Real b=1; end R;",
        "parameter Real k=3; P.R r=P.R(b=time); Real s=r.a;",
        "the equation k differs in the compiler's reading",
    ),
    "the size of a type": (
        "type V=Real[n];",
        "parameter Integer n=3; P.V v(each start=1); equation der(v)=-v;",
        "the sizes of v are [3] instead of [2]",
    ),
    "the size of an array of components": (
        "",
        "S s[P.n]; Real q=sum(s.y);",
        "s.y should not be there, because the sizes of s are [2]",
    ),
    "a size that is not known": (
        "type E = enumeration(a, b);",
        "S s[size(P.E, 1)]; Real q=sum(s.y);",
        "the array s has become a single component",
    ),
    "a size from another component": (
        "model A parameter Integer n=2; end A;",
        "parameter Integer n=3; P.A a; S s[a.n]; Real q=sum(s.y);",
        "s[3].y should not be there, because the sizes of s are [2]",
    ),
    "a size from another component, by a function": (
        "model A parameter Integer n=2; end A; "
        "function f input Integer i; output Integer o; algorithm o:=i; end f;",
        "parameter Integer n=3; P.A a; parameter Integer m=P.f(a.n); S s[m]; Real q=sum(s.y);",
        "the size of s would be read from another variable of the same name",
    ),
    "a constant of a base, if another heir has another one": (
        "partial package B constant Real h=0; end B; package W extends B; end W; "
        "package A extends B(h=50); end A; "
        "model V replaceable package Q=W constrainedby B; Real y; equation y=Q.h+0*time; end V;",
        "P.V a; P.V b(redeclare package Q=P.A);",
        "Q.h is not 50",
    ),
    "in a when-clause": (
        "partial package B constant Real h=0; end B; package W extends B; end W; "
        "package A extends B(h=50); end A; "
        "model V replaceable package Q=W; discrete Real y(start=0, fixed=true); "
        "equation when time > 0.5 then y=Q.h; end when; end V;",
        "P.V a; Real d=P.A.h;",
        "Q.h is not 50",
    ),
    "a Boolean": (
        "partial package B constant Boolean h=false; constant Real g=1; end B; package W extends B; end W; "
        "package A extends B(h=true); end A; "
        "model V Real y; equation y=time*(if P.W.h then 3 else 5); end V;",
        "P.V a; Real d=P.A.g;",
        "the equation y = time *(if P.W.h then 3 else 5) of a differs in the compiler's reading",
    ),
    "a package that a class redeclares": (
        "partial package B constant Real h=0; end B; package W extends B; end W; "
        "package A extends B(h=50); end A; "
        "model V replaceable package Q=A; Real y; equation y=Q.h*time; end V; "
        "model X extends V; redeclare package Q=W; end X;",
        "P.X a;",
        "Q.h is not 50",
    ),
    "a constant of a replaceable package in a function inside": (
        "partial package B constant Real h; end B; package W extends B(h=1); end W; "
        "package A extends B(h=5); end A; "
        "model V replaceable package Q=W constrainedby B; function g input Real x; output Real y; "
        "algorithm y:=x*Q.h; end g; Real y=g(time); end V;",
        "P.V b(redeclare package Q=P.A);",
        "g uses a constant of the replaceable package Q around it, which a component redeclares",
    ),
}


@pytest.mark.parametrize(("package", "model", "message"), _MISPLACED.values(), ids=_MISPLACED.keys())
def test_misplaced_names(package: str, model: str, message: str, tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text(_PACKAGE.format(package, model))
    with pytest.raises(UnsupportedModelError) as caught:
        generate_model(BuildRequest("M", tmp_path, file))
    assert message in str(caught.value)


#: Packages with a model M in which the same names are right.
_WELL_PLACED = {
    "a name that the base declares": (
        "model B parameter Real k=5; Real y; equation y=k; end B;",
        "extends P.B(k=7); parameter Real j=3;",
    ),
    "an iterator and an argument": (
        "model B Real y; equation y=sum(i for i in 1:3)+f(x=2, y=3); end B; "
        "function f input Real x; input Real y; output Real z; algorithm z:=x+y; end f;",
        "extends P.B; parameter Real i=3; parameter Real x=1;",
    ),
    "a size of its own": (
        "",
        "parameter Integer m=n+1; constant Integer n=1; S s[m]; Real q=sum(s.y);",
    ),
    "redeclared packages with constants of their own": (
        "partial package B constant Real h; end B; package W extends B(h=1); end W; "
        "package A extends B(h=5); end A; "
        "model V replaceable package Q=W constrainedby B; parameter Real k=Q.h; Real y=k*time; end V;",
        "P.V a; P.V b(redeclare package Q=P.A, k=3);",
    ),
    "a when-clause of a base, in components of which one is redeclared": (
        "partial model C parameter Real k=1; discrete Real u(start=0, fixed=true); "
        "equation when sample(0.1, 0.1) then u=pre(u)+k; end when; end C; model D extends C; end D; "
        "model L replaceable D c(k=5) constrainedby C; Real y=c.u; end L;",
        "P.L a; P.L b(redeclare P.D c(k=2));",
    ),
    "a literal of an enumeration": (
        "type E = enumeration(a, b);",
        "parameter P.E e=P.E.b; Boolean y=e > P.E.a;",
    ),
    "a constant by a function": (
        "constant Real t[:]={5, 6, 7}; constant Integer m=size(t, 1); constant Real r=sqrt(k)+k^2;",
        "Real y; Real z; equation y=P.t[P.m]+P.k; z=P.m*P.r;",
    ),
    "an import before a constant around": (
        "package C constant Real k=4; end C; model B import P.C.*; Real y; equation y=k; end B;",
        "extends P.B;",
    ),
}


@pytest.mark.parametrize(("package", "model"), _WELL_PLACED.values(), ids=_WELL_PLACED.keys())
def test_well_placed_names(package: str, model: str, tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text(_PACKAGE.format(package, model))
    generate_model(BuildRequest("M", tmp_path, file))


def _generate(declarations: str, folder: Path) -> None:
    file = folder / "M.mo"
    file.write_text(f"model M\n{declarations}\nend M;\n")
    generate_model(BuildRequest("M", folder, file))
