"""Results that are NaN or infinite are told, with the variable and the time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu, NotFiniteWarning, run_model_exchange
from pyjoystick.fmu.not_finite import first_not_finite

TIME = np.linspace(0.0, 3.0, 7)


@pytest.mark.parametrize("own_process", [False, True])
@pytest.mark.parametrize("version", [2, 3])
def test_a_run_warns(version: int, own_process: bool, request: pytest.FixtureRequest) -> None:
    path = request.getfixturevalue("awkward_path" if version == 2 else "awkward3_path")
    with Fmu(path, own_process=own_process) as fmu:
        with pytest.warns(NotFiniteWarning) as told:
            table = fmu.run(TIME, parameters={"gain": 1e308}, inputs={"u": 1.0})
        fmu.run(TIME, inputs={"u": 1.0})
    assert table["y"].tolist()[3:5] == [1.5e308, np.inf]
    (warning,) = told
    assert str(warning.message).startswith(f"{path.name}: results are not finite: y is inf at t = 2 s")
    assert warning.filename == __file__


@pytest.mark.parametrize("own_process", [False, True])
def test_model_exchange_warns(pair: Path, own_process: bool) -> None:
    settings = {"parameters": {"own": 1e308, "x": 5.0}, "outputs": ["x", "inside"]}
    message = r"^First\.fmu: results are not finite: inside is inf at t = 0 s$"
    with pytest.warns(NotFiniteWarning, match=message) as told:
        run_model_exchange(pair / "First.fmu", TIME, **settings, own_process=own_process)  # type: ignore[arg-type]
    assert [one.filename for one in told] == [__file__]


def test_what_is_said() -> None:
    good, text = np.ones(7), np.array(["nan"] * 7, dtype=object)
    late = np.where(TIME < 1.5, 1.0, np.nan)
    columns = {"n": np.arange(7), "text": text, "x": good, "z": late}
    assert first_not_finite(TIME, columns) == "z is nan at t = 1.5 s"
    assert first_not_finite(TIME, columns | {"z": good}) == ""
    many = {f"z{i}": -np.inf * late for i in range(7)}
    assert first_not_finite(TIME, many).endswith("z4 is -inf at t = 0 s, 2 other variables")
