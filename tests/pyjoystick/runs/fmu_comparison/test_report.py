"""A comparison as JSON."""

from __future__ import annotations

import json
import math
from pathlib import Path

from pyjoystick.fmu import read_description
from pyjoystick.motion import Difference
from pyjoystick.runs import RunComparison, Tolerances, as_json, compare_declarations
from pyjoystick.support import versions

RUNS = [
    RunComparison(
        "ModelExchange",
        "-20 deg",
        (
            Difference("x", "m", 2e-3, 0.5, 0.25, 1e-3, 0.125),
            Difference("y", "", math.nan, math.inf, 0.5, 1.0, 0.5),
        ),
        frozenset({"x"}),
    ),
    RunComparison("CoSimulation", "-20 deg", failures=("first FMU, it has stopped",)),
]


def _not_json(name: str) -> None:
    """Python's reader takes NaN and Infinity, which are no JSON."""
    raise AssertionError(f"{name} is not JSON")


def test_everything_is_there_and_it_is_json(pair: Path) -> None:
    fmus = [read_description(pair / f"{name}.fmu") for name in ("First", "Second")]
    text = as_json(fmus, RUNS, Tolerances(1e-7, 1e-9), declarations=compare_declarations(*fmus))
    assert text.endswith("}\n")
    content = json.loads(text, parse_constant=_not_json)
    assert [fmu["model"] for fmu in content["fmus"]] == ["Pair.First", "Pair.Second"]
    assert content["fmus"][0]["path"] == str(pair / "First.fmu")
    assert content["tolerances"] == {"co_simulation": 1e-7, "model_exchange": 1e-9}
    assert content["within_limits"] is False
    assert content["made_with"] == versions()
    assert content["declarations"]["only_second"] == ["z"]
    assert {"variable": "n", "attribute": "start", "first": "3", "second": "4"} in content["declarations"][
        "differences"
    ]
    run, failed = content["runs"]
    assert run["differences"][0] == {
        "variable": "x",
        "unit": "m",
        "largest": 2e-3,
        "relative": 0.5,
        "time": 0.25,
        "limit": 1e-3,
        "parted_at": 0.125,
        "judged": True,
        "within_limit": False,
    }
    y = run["differences"][1]
    assert (y["largest"], y["relative"], y["judged"], y["within_limit"]) == (None, None, False, False)
    assert failed["failures"] == ["first FMU, it has stopped"]
    assert failed["within_limits"] is False


def test_one_fmu_declares_nothing_else(pair: Path) -> None:
    content = json.loads(as_json([read_description(pair / "First.fmu")], [], Tolerances()))
    assert content["within_limits"] is True
    assert "declarations" not in content
