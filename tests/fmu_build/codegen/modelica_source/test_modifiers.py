from __future__ import annotations

import pytest

from fmu_build.codegen.modelica_source.modifiers import assigned, closing


@pytest.mark.parametrize(
    ("arguments", "paths"),
    [
        ("", set()),
        ("k = 1", {"k"}),
        ("a(s(k = 9)), b = 1", {"a.s.k", "b"}),
        ("final k = f(1, 2), each x(start = {1, 2}, fixed = true)", {"k", "x.start", "x.fixed"}),
        ("s(k = 1) = other", {"s", "s.k"}),
        ("a.s(k = [1, 2; 3, 4])", {"a.s.k"}),
        ("redeclare Spring spring(k = 3), x = if a == b then 1 else 2", {"x"}),
    ],
)
def test_assigned(arguments: str, paths: set[str]) -> None:
    assert {".".join(path) for path in assigned(arguments)} == paths


def test_closing_parenthesis() -> None:
    assert closing("a(b(c)d)e", 1) == 8
    assert closing("a(b", 1) == 3
