"""Discrete variables and when-conditions that would change between events are refused, others built."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fmu_build.package_under_test import PackageUnderTest

PACKAGE = PackageUnderTest("""
package R
  function whole
    input Real u;
    output Integer n;
  algorithm
    n := integer(3*u);
  end whole;
  function large
    input Real u;
    output Boolean b;
  algorithm
    b := u > 0.5;
  end large;
  function both
    input Real u;
    output Integer n;
    output Real y;
  algorithm
    n := integer(3*u);
    y := u;
  end both;
  model M
    parameter Real p = 1;
    input Integer i = 2;
    Real x(start=0, fixed=true);
    Real slope = der(x);
    Integer n(start=0, fixed=true);
    Real y;
    discrete Real d(start=0, fixed=true);
    Boolean b;
  equation
    der(x) = 1 + 0*x;
    {}
  end M;
end R;
""")

REST_OF_N = "y = n; d = 0; b = false;"
REST_OF_B = "y = 0; d = 0; n = 0;"


@pytest.mark.parametrize(
    ("equations", "message"),
    [
        (
            "n = whole(time); y = 0; d = 0; b = false;",
            r"R\.mo:\d+:\d+: the discrete variable n depends on time",
        ),
        ("n = 2 + whole(x); y = 0; d = 0; b = false;", "n depends on x without an event"),
        ("n = if time > 0.5 then whole(slope) else 3; y = 0; d = 0; b = false;", "n depends on slope"),
        ("(n, y) = both(time); d = 0; b = false;", "n depends on time"),
        (f"b = large(time); {REST_OF_B}", "b depends on time"),
        (f"b = noEvent(x > 0.5); {REST_OF_B}", "b depends on x"),
        (f"b = time > 0.5 and noEvent(x > 0.7); {REST_OF_B}", "b depends on x"),
        (f"n = if noEvent(time > 0.5) then 2 else 1; {REST_OF_N.replace('n;', '0;')}", "n depends on time"),
        ("d = time; n = 0; y = 0; b = false;", "a discrete Real depends on time"),
        ("when large(x) then n = 1; end when; y = n; d = 0; b = false;", "when-clause depends on x"),
        ("when noEvent(time > 0.5) then n = 1; end when; y = n; d = 0; b = false;", "depends on time"),
        (
            "when large(x) then reinit(x, 0); end when; n = 0; y = 0; d = 0; b = false;",
            "when-clause depends on x",
        ),
        (
            'when x > 2 or large(x) then terminate(""); end when; n = 0; y = 0; d = 0; b = false;',
            "depends on x",
        ),
        ("when {large(time), x > 2} then n = 1; end when; y = n; d = 0; b = false;", "depends on time"),
    ],
)
def test_what_changes_without_an_event_is_refused(tmp_path: Path, equations: str, message: str) -> None:
    PACKAGE.refusal(tmp_path, equations, message)


@pytest.mark.parametrize(
    ("equations", "expected"),
    [
        (f"n = whole(p); {REST_OF_N}", {"n": 3, "y": 3}),
        (f"n = whole(i); {REST_OF_N}", {"n": 6}),
        ("when time > 0.5 then d = time; end when; n = whole(d); y = n; b = large(d);", {"n": 1, "b": 0}),
        ("when sample(0, 0.3) then n = whole(time); b = x > 0.5; end when; y = n; d = 0;", {"n": 2, "b": 1}),
        ("n = integer(3*time + 0.1); b = noEvent(n > 2); y = 0; d = 0;", {"n": 3, "b": 1}),
        ("b = whole(time) > 1; n = 0; y = 0; d = 0;", {"b": 1}),
        ("y = whole(time); n = 0; b = false; d = 0;", {"y": 3}),
        ("b = abs(x - 1) < 0.2; n = if x > 0.5 then 2 else 1; y = 0; d = pre(d);", {"b": 1, "n": 2}),
        (f'assert(noEvent(x < 5), ""); b = true; {REST_OF_B}', {"b": 1}),
        ('when x > 0.5 then assert(large(x), ""); d = 1; end when; n = 0; y = 0; b = false;', {"d": 1}),
        (
            "when x > 0.6 then if large(x) then reinit(x, 0); end if; end when; "
            "n = 0; y = 0; d = 0; b = false;",
            {"x": 0.4},
        ),
        (
            "when x > 0.6 then if large(x) then n = 1; else n = 2; end if; end when; "
            "y = 0; d = 0; b = false;",
            {"n": 1},
        ),
        ("when slope > 0.5 and x > 0.9 then n = 4; end when; y = 0; d = 0; b = false;", {"n": 4}),
    ],
)
def test_what_changes_at_events_is_built(tmp_path: Path, equations: str, expected: dict[str, float]) -> None:
    values = PACKAGE.values(tmp_path, equations, expected)
    assert values == pytest.approx(expected)


@pytest.mark.parametrize(
    "equations",
    [
        "when time > 0.5 then d = der(x); end when; n = 0; y = 0; b = false;",
        "when der(x) > 0.5 then n = 1; end when; d = 0; y = 0; b = false;",
        f"b = der(x) > 0.5; {REST_OF_B}",
        "y = if der(x) > 0.5 then 1 else 0; n = 0; d = 0; b = false;",
    ],
)
def test_a_derivative_read_at_an_event_is_named(tmp_path: Path, equations: str) -> None:
    PACKAGE.refusal(
        tmp_path, equations, r"R\.mo:\d+:\d+: der\(x\) is not supported in a when-clause or a rel"
    )
