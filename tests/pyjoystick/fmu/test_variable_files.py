"""Inputs of FMUs from CSV files; records of variables are in tests/pyjoystick/identification/fitting."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import (
    FmuDescription,
    checked_inputs,
    find_fmu,
    read_description,
    read_inputs,
    read_variables,
)
from pyjoystick.motion import RecordError
from pyjoystick.support import UnknownInputError


@pytest.fixture
def joystick(fmus_by_name: Path) -> FmuDescription:
    return read_description(find_fmu("Joystick"))


def _file(folder: Path, text: str) -> Path:
    path = folder / "in.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_first_column_is_the_time(tmp_path: Path, joystick: FmuDescription) -> None:
    table = read_inputs(_file(tmp_path, "Zeit (ms);T (N m)\n0;0\n100;0.1\n100;-2\n"), joystick)
    assert table.index.tolist() == [0.0, 0.1, 0.1]
    assert table["T"].tolist() == [0.0, 0.1, -2.0]
    for heading in ("", "t"):
        assert read_inputs(_file(tmp_path, f"{heading},T\n1,2\n"), joystick)["T"].to_dict() == {1.0: 2.0}
    for heading in ("time_ms", "time in ms", "t/ms", "Zeit [ms]"):
        assert read_inputs(_file(tmp_path, f"{heading},T\n1,2\n"), joystick)["T"].to_dict() == {1e-3: 2.0}
    with pytest.raises(RecordError, match="the first column counts the rows and has no name"):
        read_inputs(_file(tmp_path, ",T\n1.0,2\n2.0,3\n3.0,1\n"), joystick)
    for heading in ("x", "Sample", "ms", "omega", "theta (deg)", "dt (s)", "time x1000 (s)"):
        with pytest.raises(RecordError, match=re.escape(f"'{heading}': the first column must be the time")):
            read_inputs(_file(tmp_path, f"{heading},T\n1,2\n"), joystick)


def test_times_that_run_backward_are_refused(tmp_path: Path, joystick: FmuDescription) -> None:
    with pytest.raises(RecordError, match=r"in\.csv, column 'time \(s\)', row 4: the time runs backward"):
        read_inputs(_file(tmp_path, "time (s),T\n0,1\n0.5,2\n0.4,3\n0.6,4\n"), joystick)


def test_more_than_two_rows_of_one_time_are_refused(tmp_path: Path, joystick: FmuDescription) -> None:
    with pytest.raises(RecordError, match=r"column 'time \(s\)', row 5: more than two rows have one time"):
        read_inputs(_file(tmp_path, "time (s),T\n0,1\n0.5,2\n0.5,3\n0.5,4\n"), joystick)


@pytest.mark.parametrize(("unit", "value"), [("Nm", 2.0), ("N·m", 2.0), ("mN.m", 2e-3), ("N cm", 2e-2)])
def test_usual_units_of_an_input(unit: str, value: float, tmp_path: Path, joystick: FmuDescription) -> None:
    table = read_inputs(_file(tmp_path, f"time (s),T ({unit})\n0,2\n1,2\n"), joystick)
    assert table["T"].tolist() == pytest.approx([value, value], rel=1e-15)


def test_two_columns_for_one_input_are_refused(tmp_path: Path, joystick: FmuDescription) -> None:
    with pytest.raises(RecordError, match=r"row 1: has two columns for the input T: 'T \(N\.m\)' and 'T'"):
        read_inputs(_file(tmp_path, "time (s),T (N.m),T\n0,1,0\n1,2,0\n"), joystick)


def test_a_comma_at_the_end_of_every_line_is_no_input(tmp_path: Path, joystick: FmuDescription) -> None:
    table = read_inputs(_file(tmp_path, "time (s),T,\n0,1,\n,,\n1,2,\n"), joystick)
    assert table["T"].to_dict() == {0.0: 1.0, 1.0: 2.0}
    with pytest.raises(UnknownInputError, match="no input ''"):
        read_inputs(_file(tmp_path, "time (s),T,\n0,1,\n1,2,3\n"), joystick)


def test_types_of_inputs(tmp_path: Path, mixed_path: Path) -> None:
    mixed = read_description(mixed_path)
    names = {mixed.variables[name].type: name for name in mixed.names("input")}
    headings = ",".join(names.values())
    cells = {"Real": ("0.5", "1.5"), "Integer": ("2", "3"), "Boolean": ("true", "False")}
    rows = [",".join([str(i), *(cells[kind][i] for kind in names)]) for i in range(2)]
    table = read_inputs(_file(tmp_path, "\n".join([f"time,{headings}", *rows])), mixed)
    checked_inputs(mixed, table)
    for kind, name in names.items():
        assert table[name].dtype == {"Real": np.float64, "Integer": np.int64, "Boolean": np.bool_}[kind]


def test_mistakes_are_named(tmp_path: Path, joystick: FmuDescription) -> None:
    with pytest.raises(UnknownInputError, match="there is no input 'S'"):
        read_inputs(_file(tmp_path, "time,S (N)\n0,0\n"), joystick)
    with pytest.raises(RecordError, match=r"in.csv, column 'T \(lbf\)', row 1: has an unknown unit .* N\.m"):
        read_inputs(_file(tmp_path, "time,T (lbf)\n0,0\n"), joystick)
    with pytest.raises(RecordError, match=r"in.csv, column 'T', row 3: is not a number \(found 'high'\)"):
        read_inputs(_file(tmp_path, "time,T\n0,0\n1,high\n"), joystick)


def test_a_record_in_milliseconds_and_degrees(tmp_path: Path, joystick: FmuDescription) -> None:
    path = _file(tmp_path, "theta (deg),time (ms),other\n-90,0,x\n45,500,y\n")
    table = read_variables(path, joystick, ["theta"])
    assert table.index.tolist() == [0.0, 0.5]
    assert table["theta"].tolist() == pytest.approx([-math.pi / 2, math.pi / 4], rel=1e-15)


def test_a_record_in_the_form_of_a_laboratory(tmp_path: Path, joystick: FmuDescription) -> None:
    rows = "".join(f"{10 * i};{0.5 * i};{0.25 * i}\n" for i in range(4)).replace(".", ",")
    path = _file(tmp_path, f"Stand 3\nZeit [ms];Winkel [Grad];Drehmoment [Nm]\n{rows}")
    table = read_variables(path, joystick, ["theta", "T"])
    assert table.index.tolist() == pytest.approx([0.0, 0.01, 0.02, 0.03])
    assert table["theta"].tolist() == pytest.approx([math.radians(0.5 * i) for i in range(4)])
    assert table["T"].tolist() == [0.0, 0.25, 0.5, 0.75]
