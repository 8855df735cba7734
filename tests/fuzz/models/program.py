"""Random Modelica models: functions, components, classes that extend others, events, states."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from random import Random
from typing import Any, Final

from tests.fuzz.models.functions import random_function
from tests.fuzz.models.meaning import Meaning, Number, When
from tests.fuzz.models.terms import N, Scope, Term, Terms

END: Final = 2.0


@dataclass(frozen=True)
class Program:
    """A model of the package R.

    Attributes:
        text: the package
        parameters: values of parameters, other than those in the text
        moves: there are states, which are right to the tolerance of an integrator
        observed: names of the variables to compare
        meaning: what they are over time
    """

    text: str
    parameters: Mapping[str, Number]
    moves: bool
    observed: tuple[str, ...]
    meaning: Meaning


class _Writer:
    """Collects the parts of a model and how its variables follow from each other."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.scope = Scope()
        self.package: list[str] = []
        self.declarations: list[str] = []
        self.equations: list[str] = []
        self.observed: list[str] = []
        self.meaning = Meaning()

    def terms(self, scope: Scope | None = None) -> Terms:
        return Terms(self.random, scope or self.scope)

    def parameter(self, name: str, kind: str, value: Term) -> None:
        self.declarations.append(f"parameter {kind} {name} = {value.text};")
        self.meaning.fixed.append((name, value.value))


def random_program(case: int) -> Program:
    """The model of this number."""
    random = Random(case)
    w = _Writer(random)
    given = _parameters(w)
    for i in range(random.randrange(3)):
        text, function = random_function(f"f{i + 1}", random, w.scope.functions)
        w.package.append(text)
        w.scope = replace(w.scope, functions=(*w.scope.functions, function))
    for add in random.sample((_parts, _derived, _states, _discrete, _vectors), k=random.randint(1, 4)):
        add(w)
    _algebraic(w)
    random.shuffle(w.equations)
    lines = ["package R", *w.package, "  model M"]
    lines += [f"    {line}" for line in w.declarations]
    lines += ["  equation", *(f"    {line}" for line in w.equations), "  end M;", "end R;"]
    return Program(
        text="\n".join(lines) + "\n",
        parameters=given,
        moves=bool(w.meaning.states),
        observed=tuple(w.observed),
        meaning=w.meaning,
    )


def _parameters(w: _Writer) -> dict[str, Number]:
    """Some that can be set, and some that follow from them; returns other values for the first."""
    random = w.random
    others: dict[str, Number] = {}
    plain: list[tuple[str, str, Number, Number]] = [
        ("p1", "Real", round(random.uniform(0.2, 2.0), 2), round(random.uniform(-2.0, 2.0), 2)),
        ("p2", "Real", round(random.uniform(-1.0, 1.0), 2), round(random.uniform(-1.0, 1.0), 2)),
        ("n1", "Integer", random.randint(1, 5), random.randint(1, 5)),
        ("b1", "Boolean", True, False),
    ]
    for name, kind, value, other in plain:
        w.parameter(name, kind, Term(str(value).lower(), lambda _, value=value: value))
        others[name] = other
    w.scope = Scope(reals=("p1", "p2"), integers=("n1",), booleans=("b1",))
    for name, kind in (("q1", "Real"), ("q2", "Real"), ("m1", "Integer")):
        value = w.terms().integer(1) if kind == "Integer" else w.terms().real(2)
        w.parameter(name, kind, value)
        names = {"integers": (name,)} if kind == "Integer" else {"reals": (name,)}
        w.scope = w.scope.more(**names)
    w.scope = w.scope.more(reals=("time",))
    return others


def _add(w: _Writer, name: str, value: Term, size: str = "") -> None:
    """An algebraic variable."""
    w.declarations.append(f"Real {name}{size};")
    w.equations.append(f"{name} = {value.text};")
    w.meaning.steps.append((name, value.value))
    w.observed += [f"{name}[{i}]" for i in range(1, N + 1)] if size else [name]


def _algebraic(w: _Writer) -> None:
    for i in range(1, 5):
        name = f"y{i}"
        if w.random.random() < 0.2:
            condition = w.terms().boolean(2)
            w.declarations.append(f"Boolean {name};")
            w.equations.append(f"{name} = {condition.text};")
            w.meaning.steps.append((name, condition.value))
            w.observed.append(name)
            w.scope = w.scope.more(booleans=(name,))
            continue
        _add(w, name, w.terms().real(3))
        w.scope = w.scope.more(reals=(name,))


def _vectors(w: _Writer) -> None:
    for i in range(1, 3):
        _add(w, f"v{i}", w.terms().vector(2), f"[{N}]")
        w.scope = w.scope.more(vectors=(f"v{i}",))
    value = w.terms().real(1)
    loop = Terms(w.random, w.scope.more(integers=("j",))).real(1)
    w.declarations.append(f"Real r[{N}];")
    w.equations.append(f"for j in 1:{N} loop r[j] = {loop.text} + j*({value.text}); end for;")
    w.meaning.steps.append(
        ("r", lambda v: [loop.value({**v, "j": j}) + j * value.value(v) for j in range(1, N + 1)])
    )
    w.observed += [f"r[{i}]" for i in range(1, N + 1)]


def _parts(w: _Writer) -> None:
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


def _derived(w: _Writer) -> None:
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


def _discrete(w: _Writer) -> None:
    """Discrete variables that when-clauses set at known times."""
    random = w.random
    constant = Scope(reals=("p1", "p2", "q1", "time", "pre(d)"), integers=("n1", "pre(k)"))
    for name, kind, start in (
        ("d", "Real", round(random.uniform(-1, 1), 2)),
        ("k", "Integer", random.randint(0, 3)),
    ):
        w.declarations.append(
            f"{'discrete ' if kind == 'Real' else ''}{kind} {name}(start = {start}, fixed = true);"
        )
        w.meaning.starts[name] = Term("", lambda _, start=start: start)
    new_d = [Terms(random, constant).real(2) for _ in range(2)]
    first, second = sorted(round(random.uniform(0.1, 1.9), 3) for _ in range(2))
    one, other = (
        f"time >= {due} then d = {new.text};" for due, new in zip((first, second), new_d, strict=True)
    )
    w.equations.append(f"when {one} elsewhen {other} end when;")
    w.meaning.whens.append(When((first,), None, (("d", new_d[0]),)))
    w.meaning.whens.append(When((second,), None, (("d", new_d[1]),)))
    start, period = round(random.uniform(0.01, 0.5), 3), round(random.uniform(0.11, 0.6), 3)
    new_k = Terms(random, constant).integer(2)
    w.equations.append(f"when sample({start}, {period}) then k = mod({new_k.text}, 11); end when;")
    ticks = tuple(start + i * period for i in range(int((END - start) / period) + 1))
    w.meaning.whens.append(When(ticks, None, (("k", Term("", lambda v: new_k.value(v) % 11)),)))
    w.observed += ["d", "k"]
    w.scope = w.scope.more(reals=("d",), integers=("k",))


def _states(w: _Writer) -> None:
    """Differential equations, with jumps of a state where time or another state says."""
    random = w.random
    names = tuple(f"x{i}" for i in range(1, random.randint(2, 4)))
    scope = Scope(reals=("p1", "p2", "q1", "time", *names), is_smooth=True)
    for name in names:
        start = Terms(random, Scope(reals=("p1", "q2"), integers=("n1",))).real(1)
        w.declarations.append(f"Real {name}(start = {start.text}, fixed = true);")
        w.meaning.starts[name] = start
        force = Terms(random, scope).real(2)
        rate = round(random.uniform(0.3, 3.0), 2)
        w.equations.append(f"der({name}) = sin({force.text}) - {rate}*{name};")
        w.meaning.states[name] = Term(
            "", lambda v, force=force, rate=rate, name=name: math.sin(force.value(v)) - rate * v[name]
        )
    target = random.choice(names)
    jump = Terms(random, Scope(reals=("p1", f"pre({target})"))).real(1)
    due = round(random.uniform(0.2, 1.8), 3)
    w.equations.append(f"when time >= {due} then reinit({target}, sin({jump.text})); end when;")
    w.meaning.whens.append(When((due,), None, ((target, Term("", lambda v: math.sin(jump.value(v)))),)))
    w.declarations.append("Integer hits(start = 0, fixed = true);")
    w.meaning.starts["hits"] = Term("", lambda _: 0)
    level = round(random.uniform(-0.5, 0.5), 3)
    source = random.choice(names)
    w.equations.append(f"when {source} > {level} then hits = pre(hits) + 1; end when;")
    w.meaning.whens.append(When((), (source, level), (("hits", Term("", lambda v: v["pre(hits)"] + 1)),)))
    w.observed += [*names, "hits"]
