"""Algebraic variables of random models: arrays, systems of equations, enumerations, records."""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.fuzz.models.terms import N, Terms
from tests.fuzz.models.writer import Writer


def vectors(w: Writer) -> None:
    for i in range(1, 3):
        w.add(f"v{i}", w.terms().vector(2), f"[{N}]")
        w.scope = w.scope.more(vectors=(f"v{i}",))
    value = w.terms().real(1)
    loop = Terms(w.random, w.scope.more(integers=("j",))).real(1)
    w.declarations.append(f"Real r[{N}];")
    w.equations.append(f"for j in 1:{N} loop r[j] = {loop.text} + j*({value.text}); end for;")
    w.meaning.steps.append(
        ("r", lambda v: [loop.value({**v, "j": j}) + j * value.value(v) for j in range(1, N + 1)])
    )
    w.observed += [f"r[{i}]" for i in range(1, N + 1)]


def coupled(w: Writer) -> None:
    """A system of linear equations, whose coefficients may jump."""
    coefficients = [w.terms().real(2) for _ in range(2)]
    right = [w.terms().real(2) for _ in range(3)]
    w.declarations.append("Real z1, z2, z3;")
    w.equations += [
        f"4*z1 + sin({coefficients[0].text})*z2 - z3 = {right[0].text};",
        f"z1 - 3*z2 + z3 = {right[1].text};",
        f"0 = z2 + (3 + cos({coefficients[1].text}))*z3 - {right[2].text};",
    ]

    def value(v: dict[str, Any], number: int) -> float:
        first, last = np.sin(coefficients[0].value(v)), 3 + np.cos(coefficients[1].value(v))
        matrix = [[4.0, first, -1.0], [1.0, -3.0, 1.0], [0.0, 1.0, last]]
        return float(np.linalg.solve(matrix, [one.value(v) for one in right])[number])

    for number, name in enumerate(("z1", "z2", "z3")):
        w.meaning.steps.append((name, lambda v, number=number: value(v, number)))
        w.observed.append(name)
    w.scope = w.scope.more(reals=("z1", "z2", "z3"))


def enumeration(w: Writer) -> None:
    """A variable of an enumeration that time changes, compared and converted."""
    w.package.append("  type Gear = enumeration(low, middle, high);")
    due, last = round(w.random.uniform(0.2, 1.8), 3), w.random.choice(("low", "high"))
    w.declarations += [
        "Gear gear(start = Gear.middle, fixed = true);",
        "parameter Gear first = Gear.low;",
        "Real ratio[3] = {0.5, 1.5, 4.0};",
        "Real chosen;",
    ]
    w.equations += [
        f"when time >= {due} then gear = Gear.{last}; end when;",
        "chosen = if gear > Gear.middle then ratio[3] + Integer(first) "
        "else ratio[1] + (if gear == first then 1 else 2);",
    ]

    def value(v: dict[str, Any]) -> float:
        gear = 2 if v["time"] < due else {"low": 1, "high": 3}[last]
        return {1: 1.5, 2: 2.5, 3: 5.0}[gear]

    w.meaning.steps.append(("chosen", value))
    w.observed.append("chosen")
    w.scope = w.scope.more(reals=("chosen",))


def record(w: Writer) -> None:
    """A record of parameters, and one of variables that a function makes."""
    w.package.append(
        "  record Data\n    Real a;\n    Real b;\n  end Data;\n"
        "  function made\n    input Real u;\n    input Real b;\n    output Data y;\n  algorithm\n"
        "    y.a := u + 1;\n    y.b := u*b;\n  end made;"
    )
    u, a = w.terms().real(2), w.random.choice((0.25, 3.0))
    w.declarations += [f"parameter Data given(a = {a}, b = 2);", "Data data;"]
    w.equations.append(f"data = made({u.text}, given.b);")
    w.meaning.fixed.append(("given.a", lambda _: a))
    w.meaning.steps += [("data.a", lambda v: u.value(v) + 1), ("data.b", lambda v: u.value(v) * 2)]
    w.observed += ["data.a", "data.b"]
    w.scope = w.scope.more(reals=("data.a", "data.b", "given.a"))
