from __future__ import annotations

import math

import numpy as np
import pytest

from pyjoystick.laboratory import Chain
from pyjoystick.laboratory.measurement_errors import StageError, error_budget, error_budget_report
from pyjoystick.model import NOMINAL_POWER_LAW


@pytest.fixture(scope="module")
def budget() -> dict[str, StageError]:
    random = np.random.default_rng(6)
    stages = error_budget(NOMINAL_POWER_LAW, Chain(), release_angle=math.radians(-20.0), random=random)
    return {one.stage: one for one in stages}


def test_the_filter_is_the_largest_part_of_the_error_of_the_velocity(budget: dict[str, StageError]) -> None:
    others = [one.omega for name, one in budget.items() if name != "filter" and not name.startswith("all")]
    assert budget["filter"].omega > 2.0 * max(others)
    assert budget["all"].omega == pytest.approx(budget["filter"].omega, rel=0.05)
    assert budget["differentiation"].theta == 0.0
    assert budget["differentiation"].omega < 0.01 * budget["filter"].omega


def test_the_rest_position_in_the_clearance_moves_the_angle_alone(budget: dict[str, StageError]) -> None:
    whole, moved = budget["all"], budget["all, zero at rest"]
    assert moved.omega == pytest.approx(whole.omega, rel=1e-9)
    offset = math.sqrt(moved.theta**2 - whole.theta**2)
    # The contact begins at 0.075 mm: 0.179 degrees.
    assert offset == pytest.approx(math.radians(0.18), rel=0.2)


def test_without_noise_the_markers_add_nothing_to_the_spline() -> None:
    stages = error_budget(
        NOMINAL_POWER_LAW,
        Chain(),
        release_angle=math.radians(-20.0),
        random=np.random.default_rng(6),
        noise=0.0,
    )
    spline, markers = (next(one for one in stages if word in one.stage) for word in ("camera", "noise"))
    # The sideways motion of the synthetic top, 2 %, tilts the plane a little.
    assert markers.theta == pytest.approx(spline.theta, abs=math.radians(0.03))
    assert markers.omega == pytest.approx(spline.omega, rel=0.05)


def test_the_report_has_a_row_for_each_stage(budget: dict[str, StageError]) -> None:
    report = error_budget_report(list(budget.values()))
    assert len(report.splitlines()) == 2 + len(budget)
    assert "velocity (rad/s)" in report
