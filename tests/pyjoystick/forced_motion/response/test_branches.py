from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pandas as pd
import pytest

from pyjoystick import NOMINAL, Fmu
from pyjoystick.forced_motion import (
    Response,
    ShakenJoystick,
    Shaking,
    Steps,
    backbone,
    branch_report,
    branch_table,
    distinct_solutions,
    plot_response,
    special_table,
)
from pyjoystick.model import undamped_oscillation
from pyjoystick.support import ParameterError

C_OVER_J = 0.045 / 0.01135


@pytest.fixture(scope="module")
def fmu() -> Iterator[Fmu]:
    with Fmu("Joystick") as opened:
        yield opened


@pytest.fixture(scope="module")
def response() -> Iterator[Response]:
    """The branch of the large motion at 0.6 N m, around the frequency below which there is none."""
    with Fmu("Joystick") as fmu:
        shaken = ShakenJoystick(fmu, NOMINAL, Shaking(0.6, 4.0))
        found = Response(shaken, (3.42, 4.1), steps=Steps(most=0.4, points=60))
        found.follow(shaken, found.start_at(np.array([-0.38, -5.5]), 4.0))
        yield found


def test_the_large_motion_is_lost_at_a_fold(response: Response) -> None:
    (fold,) = [point for point in response.branches[0].special if point.kind == "fold"]
    assert fold.solution.parameter == pytest.approx(3.48697, abs=1e-5)
    # At the fold one multiplier is 1: the product then gives the other.
    assert fold.solution.multipliers[0] == pytest.approx(1.0, abs=1e-5)
    other = math.exp(-C_OVER_J / fold.solution.parameter)
    assert fold.solution.multipliers[1] == pytest.approx(other, abs=1e-6)


def test_every_monodromy_has_the_determinant_of_the_damping(response: Response) -> None:
    for one in response.branches[0].solutions:
        expected = math.exp(-C_OVER_J / one.parameter)
        assert np.linalg.det(one.map.monodromy) == pytest.approx(expected, rel=1e-9)


def test_stability_changes_at_the_fold_only(response: Response) -> None:
    stable = [one.is_stable for one in response.branches[0].solutions]
    assert np.count_nonzero(np.diff(stable)) == 1


def test_a_solution_of_the_branch_is_known(response: Response) -> None:
    start = response.start_at(np.array([-0.38, -5.5]), 4.0)
    assert response.is_known(response.shaken, start)


def test_tables_report_and_figure_say_the_same(response: Response) -> None:
    table, special = branch_table(response), special_table(response)
    assert len(table) == len(response.branches[0].solutions)
    assert (table["amplitude"] == 0.5 * (table["theta_max"] - table["theta_min"])).all()
    assert "fold" in set(special["kind"])
    assert "3.48697" in branch_report(response)
    lines = plot_response(response).axes[0].get_lines()
    labels = {str(line.get_label()) for line in lines}
    assert {"stable", "unstable", "fold", "undamped, free"} <= labels


def test_the_backbone_passes_through_known_points() -> None:
    """docs/period.md: 250.6 ms for a release from -20 degrees; the shortest period is 55.5 ms."""
    found = backbone(NOMINAL, np.radians(np.geomspace(0.1, 25.0, 200)))
    assert 1.0 / found["frequency"].max() == pytest.approx(55.5e-3, abs=0.05e-3)
    released = undamped_oscillation(NOMINAL, math.radians(-20.0))
    amplitude = 0.5 * (released.forward + released.backward)
    frequency = np.interp(amplitude, found["amplitude"], found["frequency"])
    assert frequency == pytest.approx(1.0 / 250.6e-3, rel=2e-4)


@pytest.mark.parametrize("degrees", [0.3, 1.0, 5.0, 10.0, 20.0, 35.0])
def test_the_backbone_is_what_shooting_finds(fmu: Fmu, degrees: float) -> None:
    """Undamped runs of the FMU against the quadrature of docs/period.md: both turns, to 1e-9."""
    release = math.radians(degrees)
    found = backbone(NOMINAL, np.array([release])).iloc[0]
    turn, back = 0.5 / found["frequency"], 1.0 / found["frequency"]
    for _ in range(3):
        half = _undamped(fmu, release, turn)
        turn -= half["omega"] / half["alpha"]
        whole = _undamped(fmu, release, back)
        back -= whole["omega"] / whole["alpha"]
    assert abs(half["omega"]) < 1e-9
    assert abs(whole["omega"]) < 1e-9
    assert whole["theta"] == pytest.approx(release, rel=1e-9)
    assert 1.0 / back == pytest.approx(found["frequency"], rel=1e-9)
    assert 0.5 * (whole["theta"] - half["theta"]) == pytest.approx(found["amplitude"], rel=1e-9)


def _undamped(fmu: Fmu, release: float, time: float) -> pd.Series:
    parameters = {"theta_start": release, "damping.C": 0.0}
    return fmu.run([0.0, time], parameters=parameters, tolerance=1e-13).iloc[-1]


@pytest.mark.parametrize(("degrees", "hertz"), [(20.0, 3.99), (1.0, 13.8)])
def test_the_backbone_at_releases_that_the_pages_name(degrees: float, hertz: float) -> None:
    found = undamped_oscillation(NOMINAL, math.radians(-degrees))
    assert 1.0 / found.period == pytest.approx(hertz, abs=0.05 if hertz > 10.0 else 0.005)


def test_folds_close_together_at_grazings_are_not_stepped_over() -> None:
    """Where the balance springs begin to engage; the folds are those that steps a quarter as long find."""
    with Fmu("Joystick") as fmu:
        shaken = ShakenJoystick(fmu, NOMINAL, Shaking(0.6, 4.0))
        found = Response(shaken, (6.2, 6.34))
        found.follow(shaken, found.start_at(np.array([-0.05932791, -4.72148709]), 6.21014))
        special = special_table(found)
    folds = sorted(special.loc[special["kind"] == "fold", "frequency"])
    assert folds == pytest.approx([6.239528, 6.250352, 6.315610, 6.316943], abs=1e-6)
    grazings = special["kind"].str.startswith("grazing")
    assert set(special.loc[grazings, "kind"]) == {
        f"grazing {side} x_{i}" for side in ("forward", "backward") for i in (2, 3)
    }


def test_all_motions_at_4_hz_are_told_apart() -> None:
    with Fmu("Joystick") as fmu:
        shaken = ShakenJoystick(fmu, NOMINAL, Shaking(0.6, 4.0))
        found = distinct_solutions(shaken, 4.0)
        largest = [math.degrees(shaken.orbit(one.state, 4.0).amplitude) for one in found]
    assert sum(one.is_stable for one in found) == 1
    # The large motion, the unstable one between it and the small ones, and that of 0.4 degrees.
    for amplitude in (24.78, 12.07, 0.40):
        assert min(abs(one - amplitude) for one in largest) < 0.01


def test_limits_that_do_not_rise_are_refused() -> None:
    with Fmu("Joystick") as fmu:
        shaken = ShakenJoystick(fmu, NOMINAL, Shaking(0.6, 4.0))
        with pytest.raises(ParameterError, match="the first below the second"):
            Response(shaken, (5.0, 3.0))
        with pytest.raises(ParameterError, match="frequency = -1"):
            Response(shaken, (-1.0, 3.0))
        with pytest.raises(ParameterError, match=r"values = 9.0: must be from 3.0 to 5.0"):
            Response(shaken, (3.0, 5.0)).search((9.0,))
