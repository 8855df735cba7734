"""The dynamics of random models: discrete variables and states."""

from __future__ import annotations

import math
from typing import Final

from tests.fuzz.models.meaning import When
from tests.fuzz.models.terms import Scope, Term, Terms, Values
from tests.fuzz.models.writer import Writer

#: When the last event may be due (s).
END: Final = 2.0


def discrete(w: Writer) -> None:
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


def modes(w: Writer) -> None:
    """A variable of an enumeration that goes on from its value before, at known times."""
    random = w.random
    literals = ("idle", "up", "down", "done")
    w.package.append(f"  type Mode = enumeration({', '.join(literals)});")
    start = random.choice(literals)
    w.declarations.append(f"Mode mode(start = Mode.{start}, fixed = true);")
    w.meaning.starts["mode"] = Term("", lambda _: literals.index(start) + 1)
    asked, there, other = (random.choice(literals) for _ in range(3))
    operator = random.choice(("==", "<>", "<", ">="))
    condition = Terms(random, Scope(reals=("p1", "time"), integers=("n1",))).boolean(1)
    begin, period = round(random.uniform(0.01, 0.5), 3), round(random.uniform(0.15, 0.6), 3)
    w.equations.append(
        f"when sample({begin}, {period}) then mode = "
        f"if pre(mode) {operator} Mode.{asked} and {condition.text} "
        f"then Mode.{there} elseif pre(mode) == Mode.{there} then Mode.{other} else pre(mode); end when;"
    )

    def following(v: Values) -> int:
        asked_for, there_is, now = literals.index(asked) + 1, literals.index(there) + 1, v["pre(mode)"]
        holds = {
            "==": now == asked_for,
            "<>": now != asked_for,
            "<": now < asked_for,
            ">=": now >= asked_for,
        }
        if holds[operator] and condition.value(v):
            return there_is
        return literals.index(other) + 1 if now == there_is else int(now)

    ticks = tuple(begin + i * period for i in range(int((END - begin) / period) + 1))
    w.meaning.whens.append(When(ticks, None, (("mode", Term("", following)),)))
    w.add(
        "of_mode",
        Term(
            "if mode == Mode.up then 0.5 elseif mode > Mode.up then 2*time else -1",
            lambda v: 0.5 if v["mode"] == 2 else 2 * v["time"] if v["mode"] > 2 else -1,
        ),
    )
    w.observed.append("mode")


def states(w: Writer) -> None:
    """Differential equations, with jumps of a state where time or another state says."""
    random = w.random
    names = tuple(f"x{i}" for i in range(1, random.randint(2, 4)))
    scope = Scope(reals=("p1", "p2", "q1", "time", *names), is_smooth=True)
    for name in names:
        start = Terms(random, Scope(reals=("p1", "q2"), integers=("n1",))).real(1)
        w.declarations.append(f"Real {name}(start = 2*tanh({start.text}), fixed = true);")
        w.meaning.starts[name] = Term("", lambda v, start=start: 2 * math.tanh(start.value(v)))
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
