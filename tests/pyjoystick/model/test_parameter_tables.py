"""Parameters as rows of text."""

from __future__ import annotations

import pytest

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    PIVOT_TO_TOP,
    body_table,
    damping_table,
    segment_table,
    spring_table,
)
from pyjoystick.support import TextTable

TABLES = [
    segment_table(NOMINAL),
    body_table(NOMINAL, PIVOT_TO_TOP),
    spring_table(NOMINAL),
    damping_table(NOMINAL.damping, NOMINAL_POWER_LAW.damping),
]


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.rows[0][0])
def test_rows_are_as_wide_as_their_heading_and_fit_into_markdown(table: TextTable) -> None:
    assert all(len(row) == len(table.header) for row in table.rows)
    assert not any("|" in cell for row in table.rows for cell in row)


def test_a_change_shows() -> None:
    changed = NOMINAL.replace({"m": 1.25, "backward.balanceSpring.k_s": 3000.0, "damping.C": 0.05})
    assert ["mass", "1.25", "kg"] in body_table(changed).rows
    assert spring_table(changed).rows[3][1] == "3000"
    assert segment_table(changed).rows[3][4] == "4191"
    assert damping_table(changed.damping).rows == [["constant C", "0.05", "N m s/rad"]]


def test_the_top_is_left_out_where_it_is_not_known() -> None:
    assert not any(row[0] == "pivot to top" for row in body_table(NOMINAL).rows)
    assert ["pivot to top", "0.266", "m"] in body_table(NOMINAL, PIVOT_TO_TOP).rows
