"""A root that jumps is never zero: `x > c` becomes true with the other relations, even beside `x < c`.

A root that passes through zero continuously makes both false for one event (`StateEvents.mo`, `Friction.mo`).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fmu_build import build_fmu
from pyjoystick import Fmu
from pyjoystick.fmu.model_exchange import run_model_exchange

_BY_REINIT = (
    "Real x(start = 0, fixed = true); equation der(x) = 0; when time >= 0.5 then reinit(x, 0.9); end when;"
)
_BY_EQUATION = "Real x = if time >= 0.5 then 0.9 else 0; equation"
_CONTINUOUSLY = "Real x(start = 0, fixed = true); equation der(x) = 1;"


def _m(declarations: str, clauses: str, folder: Path, *, exchange: bool) -> float:
    file = folder / "M.mo"
    file.write_text(f"model M Integer m(start = 0, fixed = true); {declarations} {clauses} end M;", "utf-8")
    path = build_fmu("M", folder, library=[file]).path
    times = np.linspace(0.0, 1.0, 11)
    if exchange:
        return float(run_model_exchange(path, times, outputs=["m"])["m"].iloc[-1])
    with Fmu(path) as fmu:
        return float(fmu.run(times, outputs=["m"])["m"].iloc[-1])


@pytest.mark.parametrize("exchange", [False, True])
@pytest.mark.parametrize("jump", [_BY_REINIT, _BY_EQUATION])
@pytest.mark.parametrize(
    ("clauses", "expected"),
    [
        ("when x > 0.4 and not x > 0.1 then m = 1; end when;", 0.0),
        ("when not x < 0.1 and not x > 0.1 then m = 1; end when;", 0.0),
        ("when x > 0.4 then m = 3; elsewhen x < 0.1 then m = 7; elsewhen x > 0.1 then m = 1; end when;", 3.0),
    ],
)
def test_a_jump(jump: str, clauses: str, expected: float, exchange: bool, tmp_path: Path) -> None:
    assert _m(jump, clauses, tmp_path, exchange=exchange) == expected


@pytest.mark.parametrize("exchange", [False, True])
@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ("not x < 0.1 and not x > 0.1", 1.0),
        ("x >= 0.1 and not x > 0.1", 1.0),
        ("x <= 0.1 and not x < 0.1", 1.0),
        ("not x < 0.1 and not x >= 0.1 and not x > 5", 0.0),
        ("not x > 0.1 and not x <= 0.1 and not x < -5", 0.0),
    ],
)
def test_a_continuous_passage(condition: str, expected: float, exchange: bool, tmp_path: Path) -> None:
    """All relations of the root see the same zero, also those that hold there."""
    clauses = (
        f"when {condition} then m = pre(m) + 1; end when; "
        "when x < 0.1 then k = 1; elsewhen x > 0.1 then k = 2; end when;"
    )
    declarations = f"Integer k(start = 0, fixed = true); {_CONTINUOUSLY}"
    assert _m(declarations, clauses, tmp_path, exchange=exchange) == expected
