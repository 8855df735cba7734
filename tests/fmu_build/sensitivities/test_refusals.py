"""Models without sensitivities are refused with a named reason, and nothing is written."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import UnsupportedModelError, build_fmu

LIBRARY = Path(__file__).with_name("Refused.mo")


@pytest.mark.parametrize(
    ("request_text", "message"),
    [
        ("y:k", "there is no variable 'y'"),
        ("x:kk", "there is no variable 'kk'; did you mean k?"),
        ("above:k", "'above' is of type Boolean; a Real variable is needed"),
        ("der(x):k", "'der(x)' is the derivative of a state, whose sensitivity comes with that of the state"),
        ("u:k", "'u' is of causality 'input'"),
        ("k:k", "'k' is of causality 'parameter'"),
        ("time:k", "'time' is of causality 'independent'"),
        ("x:n", "'n' is of type Integer; a Real parameter is needed"),
        ("x:twice", "'twice' is computed from others; name a parameter that can be set"),
        ("x:fixed", "'fixed' is constant in the FMU; name a parameter that can be set"),
        ("x:u", "'u' is of causality 'input'; a parameter that can be set is needed"),
        ("x:x", "'x' is of causality 'output'; a parameter that can be set is needed"),
    ],
)
def test_variables(request_text: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedModelError) as caught:
        build_fmu("Refused.Kinds", tmp_path, library=LIBRARY, sensitivity=request_text)
    assert message in str(caught.value)
    assert "Refused.Kinds" in str(caught.value)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ("Jump", "sign() of a variable jumps without an event"),
        ("Driven", "the time of an event depends on the input u directly"),
    ],
)
def test_models(model: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedModelError, match=r"no sensitivities") as caught:
        build_fmu(f"Refused.{model}", tmp_path, library=LIBRARY, sensitivity="all:all")
    assert message in str(caught.value)
    assert not list(tmp_path.iterdir())
