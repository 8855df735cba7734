"""The largest differences between two tables."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest

from pyjoystick.motion import Quantity, compare, make_table
from pyjoystick.motion.comparison import within_limits
from pyjoystick.support import ParameterError, PyJoystickError, SeriesError, UnknownVariableError

TIME = [0.0, 0.1, 0.2, 0.3]


def table(time: list[float] = TIME, unit: str = "rad", **columns: list[float]) -> pd.DataFrame:
    return make_table(time, columns, [Quantity(name, unit) for name in columns])


def test_size_share_and_place_of_the_largest_difference() -> None:
    (theta, rest) = compare(
        table(theta=[1.0, 2.0, -4.0, 0.5], rest=[0.0] * 4, extra=[1.0] * 4),
        table(theta=[1.0, 2.1, -4.25, 0.5], rest=[0.0] * 4, other=[1.0] * 4),
    )
    assert (theta.variable, theta.unit, theta.time) == ("theta", "rad", 0.2)
    assert theta.largest == 0.25
    assert theta.relative == 0.25 / 4.25
    assert (rest.largest, rest.relative) == (0.0, 0.0)
    assert theta.within_limit


def test_a_difference_from_zero_is_infinitely_large_in_relation() -> None:
    (theta,) = compare(table(theta=[0.0, 1e-9, 0.0, 0.0]), table(theta=[0.0] * 4))
    assert theta.relative == math.inf


def test_limits_are_kept_up_to_their_value() -> None:
    run, expected = table(theta=[0.0, 0.0, 0.25, 0.0]), table(theta=[1.0, 0.0, 0.0, 0.0])
    assert within_limits(compare(run, expected, limits={"theta": 1.0}))
    assert not within_limits(compare(run, expected, limits={"theta": np.nextafter(1.0, 0.0)}))


def test_where_a_limit_is_first_exceeded() -> None:
    run, expected = table(theta=[0.0, 0.1, -0.3, 0.9]), table(theta=[0.0] * 4)
    parted = [compare(run, expected, limits={"theta": limit})[0].parted_at for limit in (0.05, 0.1, 0.5, 0.9)]
    assert parted == [0.1, 0.2, 0.3, None]
    assert compare(run, expected)[0].parted_at is None


def test_nan_exceeds_every_limit() -> None:
    run = table(theta=[0.0, math.nan, 0.0, 0.0])
    for differences in (
        compare(run, table(theta=[0.0] * 4), limits={"theta": 1e9}),
        compare(table(theta=[0.0] * 4), run, limits={"theta": 1e9}),
    ):
        assert not within_limits(differences)
        assert math.isnan(differences[0].largest)
        assert (differences[0].time, differences[0].parted_at) == (0.1, 0.1)


def test_a_difference_has_its_unit_and_its_limit() -> None:
    (row,) = compare(table(theta=[0.5] * 4), table(theta=[1.0] * 4), limits={"theta": 0.1})
    assert (row.unit, row.largest, row.relative, row.limit) == ("rad", 0.5, 0.5, 0.1)


@pytest.mark.parametrize(
    ("run", "expected", "limits", "error", "message"),
    [
        (table(a=[0.0] * 4), table(a=[0.0] * 4), {"b": 1.0}, UnknownVariableError, "no variable 'b'"),
        (table(a=[0.0] * 4), table(a=[0.0] * 4), {"a": 0.0}, ParameterError, "limit of a = 0.0"),
        (table(a=[0.0] * 4), table(a=[0.0] * 4), {"a": math.nan}, ParameterError, "limit of a = nan"),
        (table(a=[0.0] * 4), table(b=[0.0] * 4), {}, ParameterError, "columns = .*: must be some of b"),
        (
            table(a=[0.0] * 4),
            table(unit="deg", a=[0.0] * 4),
            {},
            ParameterError,
            "unit of a = rad: must be deg",
        ),
        (
            table(a=[0.0] * 4),
            table([0.0, 0.1], a=[0.0] * 2),
            {},
            SeriesError,
            "4 instants in one table and 2",
        ),
        (
            table(a=[0.0] * 4),
            table([0.0, 0.1, 0.2, 0.31], a=[0.0] * 4),
            {},
            SeriesError,
            r"is 0\.3 s in one table and 0\.31 s in the other at row 3",
        ),
    ],
)
def test_what_cannot_be_compared(
    run: pd.DataFrame,
    expected: pd.DataFrame,
    limits: dict[str, float],
    error: type[PyJoystickError],
    message: str,
) -> None:
    with pytest.raises(error, match=message):
        compare(run, expected, limits=limits)
