"""Generated C functions against the same functions in Python, for many arguments."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import rumoca

from fmu_build.codegen.lowered import lower
from tests.fmu_build.codegen.functions import python_algorithms
from tests.fmu_build.codegen.functions.compiled import ALGORITHMS, CompiledFunctions

# The two differ by the order of their operations and by the C library's pow: some rounding errors.
RELATIVE, ABSOLUTE = 1e-12, 1e-13

Arguments = list[Any]


@pytest.fixture(scope="module")
def functions(tmp_path_factory: pytest.TempPathFactory) -> CompiledFunctions:
    model = rumoca.Session().load(str(ALGORITHMS), model="Algorithms.Calls")
    return CompiledFunctions(lower(model), tmp_path_factory.mktemp("functions"))


def _numbers(random: random.Random, count: int) -> list[float]:
    return [random.uniform(-1.9, 4.0) for _ in range(count)]


def _scalar(random: random.Random) -> Arguments:
    return _numbers(random, 1)


def _scalars_of(values: tuple[float, ...]) -> Callable[[random.Random], Arguments]:
    """Mostly random numbers, else one of the values at which something changes."""
    return lambda random: [random.choice(values)] if random.random() < 0.3 else _numbers(random, 1)


def _vector(count: int) -> Callable[[random.Random], Arguments]:
    return lambda random: [_numbers(random, count)]


def _table(random: random.Random) -> Arguments:
    places = sorted(_numbers(random, 4))
    x = random.choice(places) if random.random() < 0.3 else random.uniform(-3.0, 5.0)
    return [places, _numbers(random, 4), x]


CASES: dict[str, Callable[[random.Random], Arguments]] = {
    "horner": lambda random: [_numbers(random, random.choice((2, 3))), random.uniform(-2, 2)],
    "interpolate": _table,
    "polar": lambda random: _numbers(random, 2),
    "nested": _scalar,
    "overwritten": _scalar,
    "piecewise": _scalars_of((-1.0, 1.0)),
    "logic": lambda random: [random.choice((0.5, 1.0, 2.0, 3.0, 1.7, 3.2)), random.choice((False, True))],
    "divisions": lambda random: [random.randint(-20, 20), random.choice((-7, -3, -2, 1, 2, 3, 5))],
    "rounding": _scalars_of((-1.0, 0.0, 2.0, 1.5)),
    "elementary": _scalars_of((0.0, 1.0)),
    "ratios": _scalar,
    "early_return": _scalars_of((1.0,)),
    "exchange": _scalars_of((1.0,)),
    "rotated": _scalars_of((0.0,)),
    "chain": _scalars_of((0.5,)),
    "applied": lambda random: [_numbers(random, 6), _numbers(random, 3)],
    "matrices": _vector(4),
    "branches": _scalars_of((0.5, 1.0)),
    "sums": _vector(5),
    "picked": lambda random: [random.randint(-1, 5), _numbers(random, 3)],
    "geared": lambda random: [random.choice((1, 2, 3)), random.uniform(-2, 2)],
    "moved": lambda random: _numbers(random, 3),
    "named": lambda random: [random.uniform(-2, 2), _numbers(random, 4)],
    "never": lambda random: _numbers(random, 2),
}


def _draws(name: str) -> Iterator[Arguments]:
    source = random.Random(name)
    for _ in range(300):
        yield CASES[name](source)


@pytest.mark.parametrize("name", CASES)
def test_results_are_those_of_the_algorithm(functions: CompiledFunctions, name: str) -> None:
    for arguments in _draws(name):
        expected = getattr(python_algorithms, name)(*arguments)
        found = functions.call(name, *arguments)
        assert len(found) == len(expected)
        for a, b in zip(found, expected, strict=True):
            same = math.isclose(a, b, rel_tol=RELATIVE, abs_tol=ABSOLUTE)
            assert same or (math.isnan(a) and math.isnan(b)), (arguments, found, expected)


def test_sorting_through_exchanges_in_an_array(functions: CompiledFunctions) -> None:
    source = random.Random("sorted")
    for _ in range(300):
        values = [float(source.randint(-3, 3)) for _ in range(5)]
        assert functions.call("sorted", values) == sorted(values)


def test_every_function_of_the_package_is_tested() -> None:
    text = ALGORITHMS.read_text("utf-8")
    declared = {line.split()[1] for line in text.splitlines() if line.startswith("  function ")}
    assert declared == {*CASES, "sorted"}
