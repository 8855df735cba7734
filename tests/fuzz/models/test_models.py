"""Some random models, and a check that wrong results would be detected."""

from __future__ import annotations

import math

import pytest

from tests.fuzz.models import terms
from tests.fuzz.models.trial import trial


@pytest.mark.parametrize("case", range(7000, 7006))
def test_random_models_are_right_or_refused(case: int) -> None:
    verdict = trial(case)
    assert verdict.kind != "fault", verdict.what


def test_a_wrong_value_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    case = next(one for one in range(7000, 7012) if trial(one).kind == "right")
    monkeypatch.setattr(terms, "math", _Wrong())
    verdict = trial(case)
    assert verdict.kind == "fault"
    assert "should be" in verdict.what


class _Wrong:
    """The module math but for the sine, which is 1e-7 too large."""

    def __getattr__(self, name: str) -> object:
        return (lambda x: math.sin(x) + 1e-7) if name == "sin" else getattr(math, name)
