"""Reductions of a run match its samples, and peaks match `find_peaks`."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Extremes, Final, Fmu, Loss, Peaks, Reduction
from pyjoystick.motion import find_peaks
from pyjoystick.support import ParameterError

TIME = np.linspace(0.0, 1.0, 241)
OUTPUTS = ("E", "theta", "omega", "alpha")
STARTS = np.linspace(-0.33, 0.34, 9)[:, None]


def reduced(joystick: Fmu, *reductions: Reduction) -> tuple[pd.DataFrame, list[pd.DataFrame]]:
    """The reduced table, and the samples of each run."""
    plan = joystick.plan(TIME, varied="theta_start", outputs=OUTPUTS)
    table = plan.run_batch(STARTS, reductions=reductions).reduced
    values = plan.run_batch(STARTS).values
    assert table is not None
    assert values is not None
    return table, [pd.DataFrame(run, index=TIME, columns=list(OUTPUTS)) for run in values]


def test_ends_and_extremes(joystick: Fmu, loop: str) -> None:
    table, runs = reduced(joystick, Final("theta"), Loss("E"), Extremes("omega"))
    assert list(table.columns) == [
        "theta.final",
        "E.loss",
        *("omega.max", "omega.max_time", "omega.min", "omega.min_time"),
    ]
    for row, run in zip(table.itertuples(index=False), runs, strict=True):
        expected = [
            run["theta"].iloc[-1],
            run["E"].iloc[0] - run["E"].iloc[-1],
            *(run["omega"].max(), run["omega"].idxmax(), run["omega"].min(), run["omega"].idxmin()),
        ]
        np.testing.assert_array_equal(row, expected)
    assert (table["E.loss"] > 0.1).any()


@pytest.mark.parametrize("derivative", ["alpha", None])
@pytest.mark.parametrize("limits", [{}, {"minimum_height": 2.0}, {"minimum_prominence": 3.0}])
def test_peaks(joystick: Fmu, derivative: str | None, limits: dict[str, float], loop: str) -> None:
    table, runs = reduced(joystick, Final("E"), Peaks("omega", 5, derivative, **limits))
    names = [f"omega.peak{number}{what}" for number in range(1, 6) for what in ("", "_time")]
    assert list(table.columns) == ["E.final", *names]
    counts = []
    for row, run in zip(table[names].to_numpy(), runs, strict=True):
        slope = None if derivative is None else run[derivative]
        peaks = find_peaks(TIME, run["omega"], slope, **limits)[["value", "time"]].to_numpy()[:5]
        counts.append(len(peaks))
        np.testing.assert_array_equal(row[: 2 * len(peaks)], peaks.ravel())
        assert np.isnan(row[2 * len(peaks) :]).all()
    assert max(counts) == 5
    assert min(counts) < 5 or not limits


def test_units(joystick: Fmu) -> None:
    table, _ = reduced(joystick, Extremes("omega"), Peaks("theta", 1), Loss("E"), Final("alpha"))
    omega = {"omega.max": "rad/s", "omega.max_time": "s", "omega.min": "rad/s", "omega.min_time": "s"}
    others = {"theta.peak1": "rad", "theta.peak1_time": "s", "E.loss": "J", "alpha.final": "rad/s2"}
    assert table.attrs["units"] == omega | others


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"count": 0}, "count = 0: must be a whole number, 1 or more"),
        ({"count": 2.0}, "count = 2.0"),
        ({"count": True}, "count = True"),
        ({"count": 2, "minimum_height": -1.0}, "minimum_height = -1.0"),
        ({"count": 2, "minimum_prominence": np.nan}, "minimum_prominence = nan"),
    ],
)
def test_peaks_that_are_refused(settings: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        Peaks("theta", **settings)


@pytest.mark.parametrize("reduction", [Final("y"), Extremes("y"), Loss("y"), Peaks("y", 2)])
def test_results_that_are_not_finite_are_failures(awkward_fmu: Fmu, reduction: Reduction, loop: str) -> None:
    plan = awkward_fmu.plan((0.0, 1.0, 2.0), varied="gain", inputs={"u": 1e308}, outputs="y")
    batch = plan.run_batch([[0.5], [1e308], [0.25]], reductions=[reduction])
    assert batch.reduced is not None
    assert batch.failed.tolist() == [False, True, False]
    assert batch.messages[1] == f"{reduction.columns[0]} is not finite: an output of the FMU was not"
    has_none = batch.reduced.isna().all(axis=1).tolist()
    assert has_none == [isinstance(reduction, Peaks), True, isinstance(reduction, Peaks)]


@pytest.mark.parametrize("derivative", ["alpha", "theta", "M_s"])
def test_peaks_by_the_derivative_of_another_variable(joystick: Fmu, derivative: str) -> None:
    plan = joystick.plan(TIME, varied="theta_start", outputs=["theta", "omega", "alpha", "M_s"])
    with pytest.raises(ParameterError, match=f"= {derivative}: must be the time derivative of theta"):
        plan.run_batch([[-0.3], [0.2]], reductions=[Peaks("theta", 3, derivative=derivative)])
    plan.run_batch([[-0.3], [0.2]], reductions=[Peaks("theta", 3, derivative="omega")])
