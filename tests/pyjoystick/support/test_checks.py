from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.support import ParameterError, checks


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, "1", None, True, 1j, [1.0]])
def test_what_is_no_finite_number_is_refused(value: object) -> None:
    for check in (checks.finite, checks.positive, checks.not_negative, checks.angle):
        with pytest.raises(ParameterError) as caught:
            check("k_s", value)
        assert caught.value.field == "k_s"
        assert caught.value.value is value


@pytest.mark.parametrize("value", [3, 3.0, np.float32(3.0), np.int64(3)])
def test_any_real_number_becomes_a_float(value: float) -> None:
    for check in (checks.finite, checks.positive, checks.not_negative):
        assert type(check("k_s", value)) is float
        assert check("k_s", value) == 3.0


def test_limits_of_positive_and_not_negative() -> None:
    assert checks.not_negative("F_0", 0.0) == 0.0
    assert checks.positive("k_s", 5e-324) > 0.0
    with pytest.raises(ParameterError, match=r"^k_s = 0\.0: must be a finite number above 0 N/m$"):
        checks.positive("k_s", 0.0, "N/m")
    with pytest.raises(ParameterError, match=r"^F_0 = -1e-09: must be a finite number, 0 N or more$"):
        checks.not_negative("F_0", -1e-9, "N")


def test_degrees_given_for_radians_are_recognized() -> None:
    assert checks.angle("theta_start", -1.5707) == -1.5707
    with pytest.raises(ParameterError, match=r"theta_start = -20: .* -20 degrees are -0\.349066 rad"):
        checks.angle("theta_start", -20)
    with pytest.raises(ParameterError):
        checks.angle("theta_start", math.pi / 2.0)


@pytest.mark.parametrize("value", [True, 0, 11, 3.0, "3", None, math.nan, math.inf])
def test_what_is_no_whole_number_in_range_is_refused(value: object) -> None:
    with pytest.raises(ParameterError, match=r": must be a whole number from 1 to 10$"):
        checks.whole_number("order", value, 1, 10)


def test_whole_numbers_become_integers() -> None:
    assert [checks.whole_number("order", value, 1, 10) for value in (1, 10)] == [1, 10]
    assert type(checks.whole_number("count", np.int64(10**12), 0)) is int
    with pytest.raises(ParameterError, match=r"^count = -1: must be a whole number, 0 or more$"):
        checks.whole_number("count", -1, 0)


@pytest.mark.parametrize(
    "time",
    [
        pd.to_timedelta(["0ms", "1ms"]),
        pd.to_datetime(["2026-01-01", "2026-01-02"]),
        np.array([0.0, 0.1 + 5.0j]),
        [0.0, 1.0j],
        ["0", "1"],
        [0, 10**400],
    ],
)
def test_times_are_real_numbers(time: Any) -> None:
    with pytest.raises(ParameterError, match=r"^time = an object of type .*: must be an array of numbers"):
        checks.increasing_times(time)


def test_masked_values_are_missing() -> None:
    masked = np.ma.masked_array([0.0, 1.0, 2.0], mask=[False, True, False])
    np.testing.assert_array_equal(checks.real_numbers(masked), [0.0, np.nan, 2.0])
    with pytest.raises(ParameterError, match=r"^time\[1\] = nan"):
        checks.increasing_times(masked)
    whole = np.ma.masked_array([1, 2], mask=False)
    np.testing.assert_array_equal(checks.real_numbers(whole), [1.0, 2.0])
