"""Components and classes of random models, with modifiers and redeclarations."""

from __future__ import annotations

from typing import Any

from tests.fuzz.models.terms import Scope, Terms
from tests.fuzz.models.writer import Writer


def components(w: Writer) -> None:
    """Components with parameters, single and in arrays, with modifiers of their own and in arrays."""
    inner = Scope(reals=("k", "c", "u", "time"), integers=("n",))
    first, body = Terms(w.random, Scope(reals=("k",))).real(1), Terms(w.random, inner).real(2)
    w.package.append(
        f"  model Part\n    parameter Real k = 0.5;\n    parameter Real c = {first.text};\n"
        "    parameter Integer n = 2;\n    Real u;\n    Real y;\n  equation\n"
        f"    y = {body.text};\n  end Part;"
    )
    n = w.random.randint(1, 4)
    constant = Scope(reals=("p1", "p2", "q1"), integers=("n1",), booleans=("b1",))
    k, c = Terms(w.random, constant).real(1), Terms(w.random, constant).real(1)
    given_c = w.random.random() < 0.5
    modifiers = [f"k = {k.text}", f"n = {n}", *([f"c = {c.text}"] if given_c else [])]
    u = w.terms().real(1)

    def values(v: dict[str, Any], of_k: float, of_u: float, of_n: int, of_c: float | None) -> float:
        own = {"k": of_k, "u": of_u, "n": of_n, "time": v["time"]}
        own["c"] = first.value(own) if of_c is None else of_c
        return body.value(own)

    w.declarations.append(f"Part part({', '.join(modifiers)});")
    w.equations.append(f"part.u = {u.text};")
    w.meaning.steps.append(
        ("part.y", lambda v: values(v, k.value(v), u.value(v), n, c.value(v) if given_c else None))
    )
    many = [Terms(w.random, constant).real(1) for _ in range(2)]
    w.declarations.append(f"Part parts[2](k = {{{many[0].text}, {many[1].text}}}, each n = {n});")
    w.equations.append("for i in 1:2 loop parts[i].u = i*part.y; end for;")
    for i in (1, 2):
        w.meaning.steps.append(
            (f"parts[{i}].y", lambda v, i=i: values(v, many[i - 1].value(v), i * v["part.y"], n, None))
        )
    w.observed += ["part.y", "parts[1].y", "parts[2].y"]
    w.scope = w.scope.more(reals=("part.y", "parts[2].y"))


def derived(w: Writer) -> None:
    """A class that extends another, which has a replaceable part."""
    a, b = (Terms(w.random, Scope(reals=("g", "time"))).real(2) for _ in range(2))
    x = Terms(w.random, Scope(reals=("e", "h.z", "time"))).real(2)
    w.package.append(
        "  partial model P\n    parameter Real g = 1;\n    Real z;\n  end P;\n"
        f"  model A\n    extends P;\n  equation\n    z = {a.text};\n  end A;\n"
        f"  model B\n    extends P(g = 2);\n  equation\n    z = {b.text};\n  end B;\n"
        "  model Base\n    parameter Real e = 0.3;\n    replaceable A h(g = e) constrainedby P;\n"
        f"    Real x = {x.text};\n  end Base;"
    )
    constant = Scope(reals=("p1", "p2", "q2"), integers=("n1",))
    e, g = Terms(w.random, constant).real(1), Terms(w.random, constant).real(1)
    form = w.random.randrange(3)
    if form == 0:
        w.package.append(
            "  model Derived\n    parameter Real f = 1;\n    extends Base(e = 2*f);\n  end Derived;"
        )
        w.declarations.append(f"Derived base(f = {e.text});")
    elif form == 1:
        w.package.append(
            "  model Derived\n    parameter Real f = 1;\n    extends Base(e = 2*f, redeclare B h(g = 2));\n"
            "  end Derived;"
        )
        w.declarations.append(f"Derived base(f = {e.text});")
    else:
        w.declarations.append(f"Base base(e = {e.text}, h(g = {g.text}));")
    inner = b if form == 1 else a

    def value(v: dict[str, Any]) -> float:
        own = {"e": e.value(v) if form == 2 else 2 * e.value(v), "time": v["time"]}
        of_g = {0: own["e"], 1: 2.0, 2: g.value(v)}[form]
        own["h.z"] = inner.value({"g": of_g, "time": v["time"]})
        return x.value(own)

    w.meaning.steps.append(("base.x", value))
    w.observed.append("base.x")
    w.scope = w.scope.more(reals=("base.x",))
