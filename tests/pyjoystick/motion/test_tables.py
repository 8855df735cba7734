"""Tables with units, and their CSV form."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.motion import DisplayUnit, Quantity, make_table, write_csv
from pyjoystick.motion.tables import heading, unit_of
from pyjoystick.support import OutputFileError

QUANTITIES = [
    Quantity("theta", "rad", DisplayUnit("deg", math.degrees(1.0)), "Angle"),
    Quantity("ratio"),
]


@pytest.fixture
def table() -> pd.DataFrame:
    return make_table(
        [0.0, 0.1, 0.3], {"theta": [1.0 / 3.0, -2e-17, 5.0], "ratio": [1.0, 2.0, 3.0]}, QUANTITIES
    )


def test_units_are_kept_as_plain_data(table: pd.DataFrame) -> None:
    assert (unit_of(table, "time"), unit_of(table, "theta"), unit_of(table, "ratio")) == ("s", "rad", "")
    assert (heading(table, "theta"), heading(table, "ratio")) == ("theta (rad)", "ratio")
    display = table.attrs["display_units"]
    assert display == {"theta": {"unit": "deg", "factor": math.degrees(1.0), "offset": 0.0}}
    assert table.attrs["descriptions"]["theta"] == "Angle"
    assert json.loads(json.dumps(table.attrs)) == table.attrs
    assert unit_of(pd.DataFrame(), "theta") == ""


def test_pandas_reads_back_every_digit(table: pd.DataFrame, tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    write_csv(table, path)
    assert path.read_text().splitlines()[0] == "time (s),theta (rad),ratio"
    back = pd.read_csv(path, index_col="time (s)")
    np.testing.assert_array_equal(back.index, table.index)
    np.testing.assert_array_equal(back["theta (rad)"], table["theta"])


def test_a_csv_that_cannot_be_written(table: pd.DataFrame, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(OutputFileError, match=r"cannot write .*run\.csv"):
        write_csv(table, tmp_path / "file" / "run.csv")


def test_a_file_may_be_given_as_text(tmp_path: Path) -> None:
    """As scripts have it; the other writers take their paths from the same function."""
    table = pd.DataFrame({"theta": [1.0]}, index=pd.Index([0.0], name="time"))
    write_csv(table, str(tmp_path / "run.csv"))
    assert (tmp_path / "run.csv").read_text(encoding="utf-8") == "time,theta\n0.0,1.0\n"
