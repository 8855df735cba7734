"""Records of any FMU's variables from CSV files."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import FmuDescription, find_fmu, read_description
from pyjoystick.identification import Measurement, read_table_record
from pyjoystick.identification.fitting.problem.measurement import measurements
from pyjoystick.motion import RecordError
from pyjoystick.support import ParameterError, SeriesError, UnknownVariableError

GOOD = "time (s),theta (deg),T\n0,-20,0\n0.1,-10,0.5\n0.3,5,1\n"


@pytest.fixture
def description(fmus_by_name: Path) -> FmuDescription:
    return read_description(find_fmu("Joystick"))


def _read(folder: Path, text: str, description: FmuDescription) -> Measurement:
    (folder / "driven.csv").write_text(text, encoding="utf-8")
    return read_table_record(folder / "driven.csv", ("theta", "T"), description)


def test_units_are_those_of_the_fmu_or_proposed_by_it(tmp_path: Path, description: FmuDescription) -> None:
    found = _read(tmp_path, GOOD, description)
    assert found.name == "driven"
    assert found.time.tolist() == [0.0, 0.1, 0.3]
    assert found.series("theta") == pytest.approx(np.radians([-20.0, -10.0, 5.0]))
    assert found.series("T").tolist() == [0.0, 0.5, 1.0]
    radians = GOOD.replace("theta (deg)", "theta (rad)").replace("-20", str(math.radians(-20.0)))
    assert _read(tmp_path, radians, description).series("theta")[0] == pytest.approx(math.radians(-20.0))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("theta (deg)", "theta (furlong)", "row 1: has an unknown unit (found furlong); known are rad, deg"),
        (",T\n", ",Q\n", "has no column 'T'; which column holds T? There are"),
        ("-10", "nan", "row 3: samples without a finite number"),
        ("0.3,5", "0.1,5", "row 4: the time does not increase"),
        ("0.3,5", "0.05,5", "row 4: the time does not increase"),
    ],
)
def test_bad_files_are_refused(
    tmp_path: Path, description: FmuDescription, old: str, new: str, words: str
) -> None:
    assert old in GOOD
    with pytest.raises(RecordError) as caught:
        _read(tmp_path, GOOD.replace(old, new), description)
    assert words in str(caught.value)
    assert "driven.csv" in str(caught.value)


def test_measurements_are_checked() -> None:
    time = np.array([0.0, 0.1, 0.2])
    with pytest.raises(ParameterError, match="time"):
        Measurement("run", time[::-1], {})
    with pytest.raises(SeriesError, match=r"series 'y': has the shape \(2,\), time has \(3,\)"):
        Measurement("run", time, {"y": np.zeros(2)})
    with pytest.raises(SeriesError, match=r"series 'y': is nan at index 1"):
        Measurement("run", time, {"y": np.array([0.0, np.nan, 0.0])})
    with pytest.raises(UnknownVariableError, match="known are y"):
        Measurement("run", time, {"y": np.zeros(3)}).series("x")


def test_names_are_told_apart() -> None:
    same = [Measurement("run", np.array([0.0, 1.0]), {}) for _ in range(3)]
    assert [one.name for one in measurements(same)] == ["run", "run (2)", "run (3)"]
