"""Releases that come to rest: one minimum per number of swings; the deepest must be found."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu, find_fmu
from pyjoystick.identification import CONSTANT_DAMPING, Search, Uncertainty, fit, with_friction
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.identification.fitting.solution.scan import scan
from pyjoystick.identification.fitting.solution.search import multi_start, search
from pyjoystick.laboratory import synthetic_record
from pyjoystick.model import NOMINAL
from pyjoystick.motion import Record
from pyjoystick.support import ParameterError

NOISE = math.radians(0.1)
SETTINGS = dataclasses.replace(with_friction(CONSTANT_DAMPING), uncertainty=Uncertainty(profiles=()))


def _records(friction: float, degrees: tuple[float, ...], seed: int) -> list[Record]:
    random = np.random.default_rng(seed)
    return [
        synthetic_record(
            NOMINAL.replace({"friction.T_c": friction}),
            release_angle=math.radians(angle),
            random=random,
            name=f"run {number}",
            release_time=0.25,
            duration=1.75,
            noise=NOISE,
        )
        for number, angle in enumerate(degrees)
    ]


def test_the_right_number_of_swings_is_found(fmus_by_name: Path) -> None:
    """A search from the start values ends at another one; a search from the truth says how deep it goes."""
    friction = 0.02
    degrees = (-2.0, -2.0, -2.0, -20.0)
    records = _records(friction, degrees, seed=25)
    with Fmu(find_fmu(SETTINGS.fmu)) as fmu:
        problem = make_problem(records, SETTINGS, fmu)
        (caught,) = multi_start(problem, problem.variables.start, SETTINGS.search)
        true = {"damping.C": 0.045, "friction.T_c": friction, "release_time": 0.25, "zero_offset": 0.0}
        angles = {"theta_start": [math.radians(angle) for angle in degrees]}
        start = [
            angles[one.name][one.record or 0] if one.name in angles else true[one.name]
            for one in problem.variables.free
        ]
        wanted = search(problem, np.array(start), evaluations=100)
        assert caught.cost > 1.05 * wanted.cost
        found = fit(records, SETTINGS, fmu=fmu)
        ends = problem.residuals(found.x)
    assert float(ends @ ends) == pytest.approx(wanted.cost, rel=1e-3)
    assert found.value("friction.T_c") == pytest.approx(friction, abs=4.0 * found.error("friction.T_c"))


def test_motions_that_go_on_cost_one_prediction(fmus_by_name: Path) -> None:
    records = _records(0.0072, (-20.0, -20.0), seed=1)
    with Fmu(find_fmu(SETTINGS.fmu)) as fmu:
        problem = make_problem(records, SETTINGS, fmu)
        (best,) = multi_start(problem, problem.variables.start, SETTINGS.search)
        before = problem.model.runs
        assert scan(problem, best, SETTINGS.scanned, 100) == []
        assert problem.model.runs - before == len(records)


def test_only_shared_parameters_are_scanned() -> None:
    with pytest.raises(ParameterError, match=r"search\.scan"):
        dataclasses.replace(CONSTANT_DAMPING, search=Search(scan=("theta_start",)))
