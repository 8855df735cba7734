"""Clocks as represented by rumoca."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from fmu_build import UnsupportedModelError
from fmu_build.codegen.clocks import Clock, periodic_clocks
from fmu_build.codegen.lowered import LoweredModel


def _model(anchor: str) -> LoweredModel:
    """A model with ``sample(0.05, 0.1)`` whose ticks count from `anchor`."""
    lattice = {"period": {"num": 1, "den": 10}, "phase": {"num": 1, "den": 20}}
    clocks: dict[str, Any] = {
        "activation_parameter_indices": [3],
        "periodic_event_schedules": [{"anchor": anchor, "lattice": lattice}],
    }
    return LoweredModel(name="M", flat={}, source_files=(), solve={"clocks": clocks}, dae={})


def test_ticks_count_from_time_zero_or_the_start() -> None:
    """Of all that was tried, rumoca 0.10 writes no other clocks; others would tick at wrong times."""
    clock = Clock(3, period=(1, 10), phase=(1, 20), from_start=False)
    assert periodic_clocks(_model("absolute")) == (clock,)
    assert periodic_clocks(_model("simulation_start")) == (replace(clock, from_start=True),)
    with pytest.raises(UnsupportedModelError, match="a clock anchored at first_tick is not supported"):
        periodic_clocks(_model("first_tick"))
