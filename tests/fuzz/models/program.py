"""Random Modelica models: functions, components, derived classes, events, states."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from random import Random
from typing import Final

from tests.fuzz.models.classes import components, derived
from tests.fuzz.models.dynamics import discrete, modes, states
from tests.fuzz.models.functions import random_function
from tests.fuzz.models.hierarchies import hierarchy
from tests.fuzz.models.meaning import Meaning, Number
from tests.fuzz.models.scopes import cells, constants, handed_on, redeclared, surrounded
from tests.fuzz.models.terms import Scope, Term
from tests.fuzz.models.variables import coupled, enumeration, record, vectors
from tests.fuzz.models.writer import Writer

PARTS: Final = (
    *(components, derived, states, discrete, modes, vectors, coupled, enumeration, record),
    *(handed_on, constants, surrounded, cells, redeclared, hierarchy),
)


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


def random_program(case: int) -> Program:
    """The model of this number."""
    random = Random(case)
    w = Writer(random)
    given = _parameters(w)
    for i in range(random.randrange(3)):
        text, function = random_function(f"f{i + 1}", random, w.scope.functions)
        w.package.append(text)
        w.scope = replace(w.scope, functions=(*w.scope.functions, function))
    for add in random.sample(PARTS, k=random.randint(1, 5)):
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


def _parameters(w: Writer) -> dict[str, Number]:
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


def _algebraic(w: Writer) -> None:
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
        w.add(name, w.terms().real(3))
        w.scope = w.scope.more(reals=(name,))
