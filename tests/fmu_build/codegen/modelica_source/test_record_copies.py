"""Records assigned as a whole, in every way in which Modelica can name them."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import UnsupportedModelError, build_fmu
from fmu_build.codegen.modelica_source.record_copies import with_records_in_parentheses
from pyjoystick.fmu import Fmu

_CLASSES = """
  record A parameter Real x = 1; parameter Real z = 2; end A;
  model C parameter A a; parameter A b = a; Real y = a.x + 10*b.x + 100*b.z; end C;
"""


def _library(folder: Path, classes: str) -> Path:
    file = folder / "P.mo"
    file.write_text(f"package P {_CLASSES} {classes} end P;", "utf-8")
    return file


@pytest.mark.parametrize(
    ("classes", "changed", "c"),
    [
        ("model D parameter A g(x = 4); C c(a = g); end D; model M D d(g(x = 6)); end M;", "d.g.x", "d.c"),
        ("model D parameter A a(x = 4); C c(a = a); end D; model M D d(a(x = 6)); end M;", "d.a.x", "d.c"),
        (
            "model D parameter A g(x = 4); C c(a = .P.A(g.x)); end D; model M extends D(g(x = 6)); end M;",
            "g.x",
            "c",
        ),
        (
            "model D parameter A g(x = 4); C c(a(x = g.x)); end D; model M D d(g(x = 6)); end M;",
            "d.g.x",
            "d.c",
        ),
        (
            "record B parameter A i; parameter A j = i; end B; "
            "model D parameter B g(i(x = 4)); C c(a = g.j); end D; model M D d(g(i(x = 6))); end M;",
            "d.g.i.x",
            "d.c",
        ),
        (
            "model D parameter A g(x = 4); replaceable C c; end D; model E extends D(c(final a = g)); end E; "
            "model M E d(g(x = 6)); end M;",
            "d.g.x",
            "d.c",
        ),
        (
            "model D import R = P.A; parameter R g(x = 4), h = g; C other(a(z = 5)), c(a = h); end D; "
            "model M D d(g(x = 6)); end M;",
            "d.g.x",
            "d.c",
        ),
        (
            "model D parameter A 'the data'(x = 4); C c(a = 'the data'); end D; "
            "model M D d('the data'(x = 6)); end M;",
            "d.'the data'.x",
            "d.c",
        ),
        (
            "model W parameter A g(x = 4); end W; model D outer W w; C c(a = w.g) if true; end D; "
            "model M inner W w(g(x = 6)); D d; end M;",
            "w.g.x",
            "d.c",
        ),
        (
            "model D parameter A g(x = 4); C c[2](each a = g); end D; model M D d(g(x = 6)); end M;",
            "d.g.x",
            "d.c[2]",
        ),
        (
            "model E C c; end E; model D parameter A g(x = 4); E e[2](each c(a = g)); end D; "
            "model M D d(g(x = 6)); end M;",
            "d.g.x",
            "d.e[2].c",
        ),
        (
            "model D parameter A g(x = 4); C c[2](a = {g, g}); end D; model M D d(g(x = 6)); end M;",
            "d.g.x",
            "d.c[2]",
        ),
        (
            "model D parameter A g(x = 4); C c[2](a = fill(g, 2)); end D; model M D d(g(x = 6)); end M;",
            "d.g.x",
            "d.c[2]",
        ),
        (
            "model D parameter A g[2](each x = 4); C c[2](a = g); end D; model M D d(g(x = {5, 6})); end M;",
            "d.g[2].x",
            "d.c[2]",
        ),
        (
            "model D parameter A g[2](x = {3, 4}); C c[2](a = {g[3 - i] for i in 1:2}); end D; "
            "model M D d(g(x = {6, 7})); end M;",
            "d.g[1].x",
            "d.c[2]",
        ),
    ],
)
def test_members_are_those_of_the_record_that_is_given(
    classes: str, changed: str, c: str, tmp_path: Path
) -> None:
    built = build_fmu("P.M", tmp_path, library=_library(tmp_path, classes))
    with Fmu(built.path) as fmu:
        assert changed in fmu.description.variables
        values = [
            fmu.run([0.0, 1.0], parameters=given, outputs=[f"{c}.y"])[f"{c}.y"].iloc[0]
            for given in ({}, {changed: 8.0})
        ]
    assert values == [266.0, 288.0]


def test_what_is_put_in_parentheses() -> None:
    text = """model M R r; S s; T t(r = a, s = a, f = b) "(r = a)"; R q[2] = {.a.b, fill(a.r, 1)};
  R p = f(r = a); T u[2](r = a, each r = a[1]) /* r = a */; R v = if c then a else r;
  parameter R w = a.'r 2'[3], x = r[2:3];
equation
  r = a; v = f(r = a);
public
  T y(r(k = 1) = a);
end M;
record R end R;"""
    expected = """model M R r; S s; T t(r = (a), s = a, f = b) "(r = a)"; R q[2] = {.a.b, fill((a.r), 1)};
  R p = f(r = (a)); T u[2](r = a, each r = (a[1])) /* r = a */; R v = if c then a else r;
  parameter R w = (a.'r 2'[3]), x = r[2:3];
equation
  r = a; v = f(r = a);
public
  T y(r(k = 1) = (a));
end M;
record R end R;"""
    assert with_records_in_parentheses({Path("M.mo"): text}) == {Path("M.mo"): expected}


def test_texts_without_records_stay_as_they_are() -> None:
    texts = {Path("M.mo"): "model M Real a = b; Real b = 1; T t(a = b); end M;"}
    assert with_records_in_parentheses(texts) == texts


@pytest.mark.parametrize(
    ("classes", "message"),
    [
        (
            "model D parameter A g(x = 5); end D; model M parameter A q; D d(g = q); end M;",
            "the declaration of g gives a value to x",
        ),
        (
            "model D parameter A g; end D; model E extends D(g(z = 5)); end E; "
            "model M parameter A q; E other, d(g = q); end M;",
            "the declaration of g gives a value to z",
        ),
        (
            "model D parameter A g(x = 5); end D; model E D d; end E; "
            "model M parameter A q; extends E(d(g = q)); end M;",
            "the declaration of g gives a value to x",
        ),
        (
            "model D parameter A g(x = 5); end D; model E = D; "
            "model M parameter A q; E d[2](each g = q); end M;",
            "the declaration of g gives a value to x",
        ),
        (
            "model M parameter A q; parameter A g(x = 5) = q; end M;",
            "the declaration of g gives a value to x",
        ),
        (
            "model D replaceable parameter A g; end D; "
            "model M parameter A q; D d(redeclare parameter A g = q); end M;",
            "the value of d.g, which a modifier redeclares, cannot be checked",
        ),
        (
            "model D replaceable parameter Real k = 3; end D; "
            "model M D d(redeclare parameter Real k(min = 0, max(y = 2)) = 5); end M;",
            "the value is 3 instead of 5",
        ),
    ],
)
def test_values_that_would_be_lost_are_refused(classes: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedModelError, match=rf"P\.mo:4:\d+: {message}"):
        build_fmu("P.M", tmp_path, library=_library(tmp_path, classes))


@pytest.mark.parametrize(
    "classes",
    [
        "model D parameter A g; end D; model E parameter A g(x = 5); D d(g = g); end E; model M E e; end M;",
        "model D parameter A g(x(min = 0)); end D; model M parameter A q; D d(g = q); end M;",
        "model D parameter Real g(min = 0); end D; model M parameter A g; D d(g = g.x); end M;",
    ],
)
def test_others_of_the_same_name_are_none_of_it(classes: str, tmp_path: Path) -> None:
    build_fmu("P.M", tmp_path, library=_library(tmp_path, classes))


@pytest.mark.parametrize(
    "given",
    ["import a = K;", "package a = K;", "C c(redeclare package a = K);", "replaceable model\n  a = K;"],
)
def test_a_class_with_the_name_of_a_record_is_none(given: str) -> None:
    texts = {Path("P.mo"): f"{_CLASSES} package K end K; model M {given} end M;"}
    assert with_records_in_parentheses(texts)[Path("P.mo")].endswith(f"model M {given} end M;")
