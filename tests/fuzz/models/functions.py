"""Random Modelica functions with loops, branches and local variables, and their meaning."""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random
from typing import Any

from tests.fuzz.models.terms import Function, Scope, Term, Terms

Statement = tuple[list[str], Callable[[dict[str, Any]], None]]


def random_function(
    name: str, random: Random, known: tuple[Function, ...], kinds: tuple[str, ...] = ()
) -> tuple[str, Function]:
    """A function that may call those before it, of any arguments or of these kinds: its text, and itself."""
    kinds = kinds or tuple(random.choice(("scalar", "vector")) for _ in range(random.randint(1, 2)))
    names = [f"u{i}" for i in range(1, len(kinds) + 1)]
    reals = tuple(n for n, kind in zip(names, kinds, strict=True) if kind == "scalar")
    vectors = tuple(n for n, kind in zip(names, kinds, strict=True) if kind == "vector")
    scope = Scope(reals=reals, vectors=vectors, functions=known)
    first = Terms(random, scope).real(2)
    whole = Terms(random, scope).integer(1)
    inner = scope.more(reals=("s", "w"), integers=("n",))
    statements = [_statement(random, inner, 2) for _ in range(random.randint(1, 3))]
    result = Terms(random, inner).real(2)

    def call(*arguments: Any) -> Any:
        values = dict(zip(names, arguments, strict=True))
        values["s"] = first.value(values)
        values |= {"w": 0.5, "n": whole.value(values)}
        for _, run in statements:
            run(values)
        return result.value(values)

    inputs = [
        f"    input Real {n}{'[3]' if kind == 'vector' else ''};"
        for n, kind in zip(names, kinds, strict=True)
    ]
    lines = [
        f"  function {name}",
        *inputs,
        "    output Real y;",
        "  protected",
        f"    Real s = {first.text};",
        "    Real w;",
        "    Integer n;",
        "  algorithm",
        "    w := 0.5;",
        f"    n := {whole.text};",
        *(f"    {line}" for text, _ in statements for line in text),
        f"    y := {result.text};",
        f"  end {name};",
    ]
    return "\n".join(lines), Function(name, kinds, call)


def _statement(random: Random, scope: Scope, depth: int) -> Statement:
    terms = Terms(random, scope)
    choice = random.choices(range(4), (4, 3, 3, 0.2))[0] if depth else 0
    if choice == 0:
        return _assignment(random, terms)
    if choice == 1:
        return _branch(random, scope, terms.boolean(1), depth)
    if choice == 2:
        return _loop(random, scope, depth)
    return _while(random, scope)


def _assignment(random: Random, terms: Terms) -> Statement:
    if random.random() < 0.2:
        return _assigned("n", terms.integer(1))
    return _damped(random.choice("sw"), terms)


def _damped(target: str, terms: Terms) -> Statement:
    """An assignment that stays moderate where a loop repeats it."""
    value = terms.real(1)
    new = Term(f"sin({value.text}) + 0.5*{target}", lambda v: math.sin(value.value(v)) + 0.5 * v[target])
    return _assigned(target, new)


def _assigned(target: str, value: Term) -> Statement:
    def run(values: dict[str, Any]) -> None:
        values[target] = value.value(values)

    return [f"{target} := {value.text};"], run


def _block(statements: list[Statement]) -> Statement:
    def run(values: dict[str, Any]) -> None:
        for _, one in statements:
            one(values)

    return [f"  {line}" for text, _ in statements for line in text], run


def _branch(random: Random, scope: Scope, condition: Term, depth: int) -> Statement:
    yes = _block([_statement(random, scope, depth - 1)])
    no = _block([_statement(random, scope, depth - 1)])

    def run(values: dict[str, Any]) -> None:
        (yes if condition.value(values) else no)[1](values)

    return [f"if {condition.text} then", *yes[0], "else", *no[0], "end if;"], run


def _loop(random: Random, scope: Scope, depth: int) -> Statement:
    index = f"k{depth}"
    last = random.randint(1, 4)
    body = _block([_statement(random, scope.more(integers=(index,)), depth - 1) for _ in range(2)])

    def run(values: dict[str, Any]) -> None:
        for i in range(1, last + 1):
            values[index] = i
            body[1](values)

    return [f"for {index} in 1:{last} loop", *body[0], "end for;"], run


def _while(random: Random, scope: Scope) -> Statement:
    """It ends: the variable grows in every pass."""
    limit = random.choice((0.5, 1.5, 2.5))
    text, run_body = _damped("s", Terms(random, scope))

    def run(values: dict[str, Any]) -> None:
        values["w"] = 0.0
        while values["w"] < limit:
            run_body(values)
            values["w"] += 0.7

    return ["w := 0;", f"while w < {limit} loop", *text, "  w := w + 0.7;", "end while;"], run
