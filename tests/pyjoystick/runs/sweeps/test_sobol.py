"""Sobol indices against a function whose indices are known."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
import pandas as pd
import pytest

from pyjoystick.runs import Sampling, SensitivityError, design, sensitivity
from pyjoystick.runs.sweeps.variations import Uniform
from pyjoystick.support import UnknownVariableError

#: Ishigami's function sin x1 + a sin^2 x2 + b x3^4 sin x1 with a = 7, b = 0.1 on [-pi, pi]^3 has the variance
#: a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2, of which x1 alone has (1 + b pi^4/5)^2/2, x2 a^2/8, x3 none, and x1
#: with x3 8 b^2 pi^8/225.
_A, _B = 7.0, 0.1
_ALONE = np.array([0.5 * (1.0 + _B * np.pi**4 / 5.0) ** 2, _A**2 / 8.0, 0.0])
_JOINT = 8.0 * _B**2 * np.pi**8 / 225.0
_VARIANCE = _ALONE.sum() + _JOINT
FIRST = _ALONE / _VARIANCE
TOTAL = (_ALONE + np.array([_JOINT, 0.0, _JOINT])) / _VARIANCE


def _ishigami(samples: int, method: str = "saltelli") -> pd.DataFrame:
    varied = {f"x{i}": Uniform(-np.pi, np.pi) for i in (1, 2, 3)}
    table = design(varied, Sampling("saltelli", samples, 3))
    y = np.sin(table["x1"]) + _A * np.sin(table["x2"]) ** 2 + _B * table["x3"] ** 4 * np.sin(table["x1"])
    table = table.assign(y=y + 1000.0, flat=1.0, failed=False, message="")
    table.attrs["sweep"] = {
        "settings": {"vary": {name: {} for name in varied}, "sampling": {"method": method}},
        "units": {},
        "runs": len(table),
    }
    return table


def test_known_indices_lie_within_narrow_intervals() -> None:
    indices = sensitivity(_ishigami(2048), ["y"])
    assert indices["parameter"].tolist() == ["x1", "x2", "x3"]
    for name, known in (("first", FIRST), ("total", TOTAL)):
        np.testing.assert_allclose(indices[name], known, atol=0.03)
        assert (indices[f"{name}_low"] <= known + 1e-12).all()
        assert (indices[f"{name}_high"] >= known - 1e-12).all()
        assert (indices[f"{name}_high"] - indices[f"{name}_low"]).max() < 0.2


def test_the_order_of_the_rows_does_not_matter() -> None:
    table = _ishigami(64)
    pd.testing.assert_frame_equal(sensitivity(table.sort_values("x1")), sensitivity(table), check_exact=True)


@pytest.mark.parametrize("runs", [range(1, 320), [0, *range(319)], range(315)])
def test_runs_that_are_missing_or_there_twice(runs: Sequence[int]) -> None:
    with pytest.raises(SensitivityError, match="need all runs of the sweep, each once"):
        sensitivity(_ishigami(64).iloc[list(runs)])


def test_more_samples_narrow_the_intervals() -> None:
    few, many = (sensitivity(_ishigami(n), ["y"]) for n in (128, 2048))
    width = [(one["total_high"] - one["total_low"]).mean() for one in (few, many)]
    assert width[1] < width[0] / 2.5  # the square root of 16 is 4


def test_the_same_runs_give_the_same_intervals() -> None:
    pd.testing.assert_frame_equal(sensitivity(_ishigami(64)), sensitivity(_ishigami(64)), check_exact=True)


def test_a_result_without_variance_is_left_out_and_told() -> None:
    indices = sensitivity(_ishigami(64))
    assert set(indices["result"]) == {"y"}
    assert indices.attrs["left_out"] == {"flat": "is the same in all runs"}
    with pytest.raises(SensitivityError, match="flat is the same in all runs"):
        sensitivity(_ishigami(64), ["flat"])


def test_a_result_beyond_the_squares_of_numbers_is_left_out_and_told() -> None:
    table = _ishigami(64)
    table["large"] = table["y"] * 1e200
    reason = sensitivity(table).attrs["left_out"]["large"]
    assert re.fullmatch(r"is too large for a variance: up to [\d.]+e\+20\d", reason)


def test_a_result_that_is_missing_in_a_run_has_no_indices() -> None:
    table = _ishigami(64)
    table.loc[5, "y"] = np.nan
    with pytest.raises(SensitivityError, match="y is missing in 1 of 320 runs"):
        sensitivity(table, ["y"])


def test_failed_runs_are_not_passed_over() -> None:
    table = _ishigami(64)
    table.loc[[5, 6], "failed"] = True
    with pytest.raises(SensitivityError, match="2 of 320 runs failed"):
        sensitivity(table)


def test_other_designs_and_names_are_refused() -> None:
    with pytest.raises(SensitivityError, match="need a sweep with method saltelli, this one has random"):
        sensitivity(_ishigami(64, "random"))
    with pytest.raises(UnknownVariableError, match="did you mean flat"):
        sensitivity(_ishigami(64), ["flats"])
