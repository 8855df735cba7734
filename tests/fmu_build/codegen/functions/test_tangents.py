"""Generated tangent functions against finite differences of the functions."""

from __future__ import annotations

import itertools
import math
import random
from collections.abc import Sequence
from typing import Any

import pytest
import rumoca

from fmu_build.codegen.lowered import lower
from tests.fmu_build.codegen.functions.compiled import ALGORITHMS, CompiledFunctions, flat
from tests.fmu_build.codegen.functions.test_algorithms import CASES

STEP = 1e-6
# Functions with Integer or Boolean arguments: these have no neighbors.
WHOLE = {"divisions", "geared", "logic", "picked"}
REAL = sorted(set(CASES) - WHOLE)


@pytest.fixture(scope="module")
def functions(tmp_path_factory: pytest.TempPathFactory) -> CompiledFunctions:
    model = rumoca.Session().load(str(ALGORITHMS), model="Algorithms.Calls")
    return CompiledFunctions(lower(model), tmp_path_factory.mktemp("functions"))


def _moved(arguments: Sequence[Any], directions: Sequence[float], by: float) -> list[Any]:
    rest = iter(directions)
    return [
        argument + by * next(rest)
        if isinstance(argument, float | int)
        else [value + by * direction for value, direction in zip(argument, rest, strict=False)]
        for argument in (a if isinstance(a, float | int) else [*a] for a in arguments)
    ]


@pytest.mark.parametrize("name", REAL)
def test_tangents_are_directional_derivatives(functions: CompiledFunctions, name: str) -> None:
    source = random.Random(f"tangents of {name}")
    compared = 0
    for _ in range(200):
        arguments = CASES[name](source)
        directions = [source.uniform(-1.0, 1.0) for _ in flat(arguments)]
        arguments = _moved(arguments, directions, 1e-3)  # away from where branches meet
        before, here, after = (
            functions.call(name, *_moved(arguments, directions, by)) for by in (-STEP, 0.0, STEP)
        )
        found = functions.tangents(name, arguments, directions)
        for low, middle, high, tangent in zip(before, here, after, found, strict=True):
            size = 1.0 + abs(middle) + abs(tangent)
            ahead, behind = (high - middle) / STEP, (middle - low) / STEP
            if math.isnan(middle) or not abs(ahead - behind) <= 1e-3 * size:
                continue  # outside of the domain, or a kink between the points
            assert abs(tangent - (high - low) / (2.0 * STEP)) <= 1e-6 * size, (arguments, directions)
            compared += 1
    assert compared >= 100


def test_tangents_of_what_is_chosen_by_whole_numbers(functions: CompiledFunctions) -> None:
    weights, a = (0.1, 0.2, 0.3, 0.4), [2.0, 3.0, 5.0]
    for k in (1, 2):
        element, of_matrix, *b = functions.tangents("picked", [k, a], [0.0, 0.1, 0.2, 0.3])
        assert element == pytest.approx(0.1 * k)
        assert of_matrix == pytest.approx((0.2 if k == 1 else 0.0) + 0.1 * k)
        assert b == [0.0 if i == k else pytest.approx(0.1 * i) for i in (1, 2, 3)]
    assert functions.call("picked", 1, a)[0] == a[0] + weights[0]
    for gear, factor in ((1, 1.0), (2, 2.0), (3, 3.0)):
        assert functions.tangents("geared", [gear, 0.7], [0.0, 1.0]) == [factor]


def test_the_values_along_the_way_are_those_of_the_function(functions: CompiledFunctions) -> None:
    """A sum of directions moves the results by the sum, also through branches, loops and exchanges."""
    source = random.Random("linear")
    for name in ("sorted", "matrices", "chain", "nested"):
        arguments = [[source.uniform(0.1, 2.0) for _ in range(5 if name == "sorted" else 4)]]
        if name in ("chain", "nested"):
            arguments = [source.uniform(0.1, 2.0)]  # type: ignore[list-item]
        n = len(flat(arguments))
        units = [[float(i == j) for i in range(n)] for j in range(n)]
        columns = [functions.tangents(name, arguments, unit) for unit in units]
        together = functions.tangents(name, arguments, [1.0] * n)
        sums = [sum(parts) for parts in zip(*columns, strict=True)]
        assert together == pytest.approx(sums, rel=1e-12)
        assert any(value != 0.0 for value in itertools.chain(*columns))
