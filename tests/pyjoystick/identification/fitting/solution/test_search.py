"""Searches from many starts."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from pyjoystick.identification import POWER_LAW_DAMPING, RELEASE, FitSettings, Free, Search, Uncertainty, fit
from pyjoystick.identification.fitting.solution.search import _exchanged
from pyjoystick.model import NOMINAL_POWER_LAW
from pyjoystick.support import ParameterError
from tests.pyjoystick.identification.fitting.made import releases

#: The two minima of the displacement terms: the true one, and the sides exchanged.
EXCHANGED = {"damping.A_pos": 0.051, "damping.n_pos": -0.17, "damping.A_neg": 0.062, "damping.n_neg": 0.10}


def test_the_minimum_with_the_sides_exchanged_is_left(fmus_by_name: Path) -> None:
    joystick = NOMINAL_POWER_LAW.replace({"damping.alpha": 1.0})
    settings = FitSettings(
        fmu="JoystickPowerLaw",
        fixed={"damping.alpha": 1.0},
        free=(*(Free(name, start=value) for name, value in EXCHANGED.items()), *RELEASE),
        search=Search(stages=()),
        uncertainty=Uncertainty(profiles=()),
    )
    records = releases(joystick)
    caught = fit(records, settings)
    assert caught.value("damping.n_pos") < 0.0
    exchanges = POWER_LAW_DAMPING.search.exchanges
    found = fit(records, dataclasses.replace(settings, search=Search(stages=(), exchanges=exchanges)))
    assert found.value("damping.n_pos") == pytest.approx(0.084, rel=1e-4)
    assert [one.found for one in found.minima] == [1, 1]
    assert found.minima[0].cost < found.minima[1].cost


def test_each_pair_is_exchanged_record_by_record_within_the_bounds() -> None:
    names = [("C", None), ("a", 0), ("J", None), ("b", 0), ("a", 1), ("b", 1), ("d", None)]
    free = [SimpleNamespace(name=name, record=record) for name, record in names]
    variables = SimpleNamespace(free=free, lower=np.zeros(7), upper=np.full(7, 5.5))
    problem: Any = SimpleNamespace(variables=variables)
    x = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0])
    found = _exchanged(problem, x, (("C", "J"), ("b", "a")))
    assert list(found) == [3.0, 4.0, 1.0, 2.0, 5.5, 5.0, 5.5]


def test_only_free_parameters_are_exchanged() -> None:
    with pytest.raises(ParameterError, match=r"damping\.B"):
        FitSettings(fmu="Joystick", free=RELEASE, search=Search(exchanges=(("theta_start", "damping.B"),)))
