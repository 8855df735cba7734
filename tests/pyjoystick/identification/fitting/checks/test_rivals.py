"""Fits that try what the model may lack stay near the fit, where a run is quick."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import CONSTANT_DAMPING, driven, read_records
from pyjoystick.identification.fitting.checks.rivals import tried
from pyjoystick.identification.fitting.checks.suspect import near
from pyjoystick.identification.fitting.problem import record_runs
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.measurement import measurements
from pyjoystick.identification.fitting.problem.settings import FitSettings, Free
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.model import NOMINAL

DRIVEN = Path(__file__).parents[5] / "scenarios" / "data" / "synthetic_driven_1.csv"


def test_no_rival_leaves_the_neighborhood(joystick_fmus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the sign of the angle reversed, the sum of squares falls with J, down to nothing."""
    settings = driven(CONSTANT_DAMPING)
    seen: list[float] = []
    original = record_runs.run_rows

    def watched(plan: Any, rows: Any, given: Any, *more: Any) -> Any:
        seen.extend(rows[:, given.varied.index("J")])
        assert min(seen) > 1e-2 * NOMINAL.J
        return original(plan, rows, given, *more)

    monkeypatch.setattr(record_runs, "run_rows", watched)
    with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
        records = measurements(read_records([DRIVEN], settings, fmu.description))
        problem = make_problem(records, settings, fmu)

        def make(other: FitSettings, rival: Fmu | None, *, mirrored: bool = False) -> Problem:
            return make_problem([one.mirrored() for one in records] if mirrored else records, other, fmu)

        tried([], {}, problem, settings, problem.variables.start, make)
    assert np.ptp(seen) > 0.1 * NOMINAL.J


def test_a_suspect_keeps_near_the_fit() -> None:
    """A stiffness of nothing has no neighborhood; the FMU's own bounds count."""
    assert near("J", 2.0) == Free("J", 2.0, 1.0, 4.0)
    assert near("k_s", 0.0) == Free("k_s", 0.0)


def test_a_search_without_bounds_keeps_within_reach(joystick_fmus: Path) -> None:
    """What cannot be zero keeps to a thousandth of its start; bounds that are given count as they are."""
    settings = driven(CONSTANT_DAMPING)
    free = (Free("J"), Free("m", minimum=1e-9), Free("damping.C"), Free("h", start=0.0), *settings.free[2:])
    with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
        records = read_records([DRIVEN], settings, fmu.description)
        variables = make_problem(records, dataclasses.replace(settings, free=free), fmu).variables
    assert variables.lower[:4] == pytest.approx([NOMINAL.J / 1e3, 1e-9, 0.0, 0.0])
    assert variables.upper[:4] == pytest.approx([1e3 * NOMINAL.J, 1e3 * NOMINAL.m, 45.0, np.inf])
