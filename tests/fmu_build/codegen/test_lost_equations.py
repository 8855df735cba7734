"""When-clauses and assertions in if-equations: rumoca leaves some of them out."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.request import BuildRequest
from pyjoystick.support import SimulationError
from tests.fmu_build.package_under_test import PackageUnderTest

PACKAGE = PackageUnderTest("""
package R
  model Start
    parameter Boolean b = true;
    Real x(start = 0, fixed = true);
  equation
    der(x) = 1;
  end Start;
  model Falls
    extends Start;
  equation
    if b then
      when x > 0.5 then
        reinit(x, 0);
      end when;
    else
      when x > 0.7 then
        reinit(x, 0);
      end when;
    end if;
  end Falls;
  model Counts
    parameter Boolean up = true;
    Integer n(start = 0, fixed = true);
  equation
    if up then
      when time > 0.5 then
        n = 1;
      end when;
    else
      when time > 0.7 then
        n = -1;
      end when;
    end if;
  end Counts;
  {}
end R;
""")
_N = "discrete Integer n(start = 0, fixed = true);"
_B = "parameter Boolean b = true;"
_BC = f"{_B} parameter Boolean c = true;"
_BELOW = (
    'function below input Real x; algorithm assert(x < 0.5, "large"); end below; '
    "function same input Real x; output Real y; algorithm y := x; end same; "
)
_WITH_ARGUMENT = (
    "partial function base input Real x; output Real y; end base; "
    "function scaled extends base; input Real a; algorithm y := a*x; end scaled; "
    "function of input base f; input Real x; output Real y; algorithm y := f(x); end of; "
)
_SET = "when time > {} then n = {}; end when;"
ONE, TWO, THREE = (_SET.format(0.2 * number, number) for number in (1, 2, 3))


@pytest.mark.parametrize(
    ("declarations", "equations"),
    [
        (f"{_B} {_N}", f"if b then {ONE} else {TWO} end if;"),
        (f"{_BC} {_N}", f"if b then {ONE} elseif c then {TWO} else {THREE} end if;"),
        (f"{_BC} {_N}", f"if b then {ONE} else if c then {TWO} else {THREE} end if; end if;"),
        ("extends Start;", 'if b then assert(x < 2, "a"); else assert(x < 3, "b"); end if;'),
        ("extends Start;", 'if x > 1 then assert(x < 2, "a"); end if;'),
        ("extends Start; Boolean u = time > 1;", 'if u then assert(x < 2, "a"); end if;'),
        ("extends Start; Real y;", 'if x > 1 then y = 1; assert(x < 2, "a"); else y = 2; end if;'),
        ("extends Start; Boolean u = x > 1;", 'if b then if u then assert(x < 2, "a"); end if; end if;'),
        ("extends Start;", 'if b then when x > 1 then terminate("a"); end when; '
         'else when x > 2 then terminate("b"); end when; end if;'),
        ("Falls a;", ""),
        ("Counts a[2];", ""),
        ("Counts a(final up = true); Counts b;", ""),
        # Scanned from the source, where it once seemed to be part of a function.
        (f"{_WITH_ARGUMENT} {_B} {_N} Real y = of(function scaled(a = 5), time);",
         f"if b then {ONE} else {TWO} end if;"),
    ],
)  # fmt: skip
def test_clauses_that_would_be_left_out_are_refused(
    declarations: str, equations: str, tmp_path: Path
) -> None:
    """All of them ran without the clause, without a word."""
    model = f"model M {declarations} equation {equations} end M;"
    PACKAGE.refusal(tmp_path, model, r"R\.mo:\d+:\d+: a when-clause or an assertion in this if-equation")


@pytest.mark.parametrize(
    "equations",
    [
        "below(x);",
        "if x > 0.5 then below(x); end if;",
        "initial equation below(x);",
        'terminate("end");',
        'if b then terminate("end"); end if;',
    ],
)
def test_calls_that_would_be_left_out_are_refused(equations: str, tmp_path: Path) -> None:
    model = f"{_BELOW} model M extends Start; equation {equations} end M;"
    PACKAGE.refusal(
        tmp_path,
        model,
        r"(?:calling below\(\) as an equation|terminate\(\) outside of a when-clause) is not supported",
    )


def test_the_same_calls_elsewhere_are_none_of_these(tmp_path: Path) -> None:
    equations = (
        "y = if x < 2 then same(x) else same(0); "
        'when x > 0.5 then terminate("end"); end when; '
        'if b then z = same(1); else z = same(2); end if; assert(same(x) < 2, "large"); annotation(Icon());'
    )
    declarations = "Real y, z; Real v[2] = [1, 2; same(x), 3] * {1, 1};"
    model = f"{_BELOW} model M extends Start; {declarations} equation {equations} end M;"
    generate_model(BuildRequest("R.M", tmp_path, PACKAGE.write(tmp_path, model)))


@pytest.mark.parametrize(
    ("declarations", "equations", "expected"),
    [
        (f"final {_B} {_N}", f"if b then {ONE} else {TWO} end if;", {"n": 1}),
        (f"final {_B} {_N}", f"if not b then {ONE} else {TWO} end if;", {"n": 2}),
        (f"{_B} {_N}", f"if b then {ONE} end if;", {"n": 1}),
        (f"{_B} {_N}", f"if not b then {ONE} end if;", {"n": 0}),
        (f"{_BC} {_N}", f"if not b then {ONE} elseif c then {TWO} end if;", {"n": 2}),
        (f"{_B} {_N} Real y;", f"if b then {ONE} y = 1; else y = 2; end if;", {"n": 1, "y": 1}),
        ("Counts a(final up = true), b[2](each final up = false);", "", {"a.n": 1, "b[2].n": -1}),
    ],
)  # fmt: skip
def test_other_clauses_are_kept(
    declarations: str, equations: str, expected: dict[str, float], tmp_path: Path
) -> None:
    model = f"model M Real t(start = 0, fixed = true); {declarations} equation der(t) = 1; {equations} end M;"
    assert PACKAGE.values(tmp_path, model, expected) == expected


def test_other_assertions_are_kept(tmp_path: Path) -> None:
    for equation in (
        'if b then assert(x < 0.5, "large"); end if;',
        'assert(if b then x < 0.5 else true, "large");',
    ):
        model = f"model M extends Start; equation {equation} end M;"
        with pytest.raises(SimulationError, match="large"):
            PACKAGE.values(tmp_path, model, ["x"])
