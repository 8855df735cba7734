"""Runs in a sandbox give the same results as the FMU's binary."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Extremes, Final, Fmu, FmuEndedError, FmuFileError, FmuRunError, UnsupportedFmuError
from pyjoystick.fmu.sandbox import run as sandboxed_run
from pyjoystick.support import MissingPackageError, ParameterError

_TIME = np.linspace(0.0, 2.0, 41)


@pytest.fixture(scope="module")
def native(visitor: Path) -> Iterator[Fmu]:
    with Fmu(visitor) as fmu:
        yield fmu


@pytest.fixture(scope="module")
def sandboxed(visitor: Path) -> Iterator[Fmu]:
    with Fmu(visitor, sandbox=True) as fmu:
        yield fmu


def _inputs() -> pd.DataFrame:
    """Straight lines and jumps of all types, some between the instants that are recorded."""
    rows = {
        0.0: (0.5, 0.0, 1, True),
        0.31: (2.0, 0.0, 1, True),
        0.62: (2.0, -1.0, 4, True),
        1.0: (1.0, 0.5, 4, False),
        1.33: (0.2, 0.5, 2, True),
    }
    frame = pd.DataFrame.from_dict(rows, orient="index", columns=["u", "v", "k", "up"])
    jump = pd.DataFrame({"u": [3.0], "v": [0.5], "k": [2], "up": [True]}, index=[1.33])
    return pd.concat([frame, jump])


@pytest.mark.parametrize("piece", [2**16, 64])
def test_inputs_and_outputs_of_all_types(
    native: Fmu, sandboxed: Fmu, monkeypatch: pytest.MonkeyPatch, piece: int
) -> None:
    monkeypatch.setattr(sandboxed_run, "_PIECE", piece)
    settings = {"parameters": {"n": 5, "inverted": True, "start": 0.25}, "inputs": _inputs()}
    expected = native.run(_TIME, **settings)
    found = sandboxed.run(_TIME, **settings)
    pd.testing.assert_frame_equal(found, expected, check_exact=True)
    assert found.attrs == expected.attrs
    assert expected["steps"].nunique() > 3
    assert expected["above"].nunique() == 2


def test_errors_carry_the_messages_of_the_model_and_the_next_run_works(native: Fmu, sandboxed: Fmu) -> None:
    before = sandboxed.run(_TIME)
    for parameters, time in (({"last": 0.33}, 0.3), ({"hurry": 1.0}, 0.95)):
        errors = []
        for fmu in (native, sandboxed):
            with pytest.raises(FmuRunError) as caught:
                fmu.run(_TIME, parameters=parameters)
            errors.append(caught.value)
        assert errors[1].time == errors[0].time == pytest.approx(time)
        assert errors[1].messages == errors[0].messages
        assert "run failed with status 3 (error)" in str(errors[1])
    pd.testing.assert_frame_equal(sandboxed.run(_TIME), before, check_exact=True)


def test_the_model_ends_the_simulation(native: Fmu, sandboxed: Fmu) -> None:
    ends = []
    for fmu in (native, sandboxed):
        with pytest.raises(FmuEndedError, match="the goal is reached") as caught:
            fmu.run(_TIME, parameters={"goal": 0.62})
        ends.append(caught.value)
    assert ends[1].time == ends[0].time == pytest.approx(1.24, abs=1e-9)
    pd.testing.assert_frame_equal(ends[1].samples, ends[0].samples, check_exact=True)
    assert len(ends[1].samples) == 26


def test_start_values_that_the_model_refuses(native: Fmu, sandboxed: Fmu) -> None:
    for fmu in (native, sandboxed):
        with pytest.raises(FmuRunError, match="past the last moment") as caught:
            fmu.run(_TIME, parameters={"last": -1.0})
        assert caught.value.time == 0.0


def test_batches_with_failures_and_reductions(native: Fmu, sandboxed: Fmu) -> None:
    rows = np.column_stack([np.linspace(0.0, 1.0, 12), [1e9, 0.33] * 6])
    plans = [
        fmu.plan(_TIME, varied=["start", "last"], outputs=["integral", "y"]) for fmu in (native, sandboxed)
    ]
    expected, found = (plan.run_batch(rows, threads=2) for plan in plans)
    assert expected.values is not None
    assert found.values is not None
    np.testing.assert_array_equal(found.values, expected.values)
    np.testing.assert_array_equal(found.failed, [False, True] * 6)
    assert [bool(message) for message in found.messages] == [False, True] * 6
    kept = [Final("y"), Extremes("integral")]
    reduced = [plan.run_batch(rows, reductions=kept).reduced for plan in plans]
    pd.testing.assert_frame_equal(reduced[1], reduced[0], check_exact=True)


def test_a_sandbox_survives_pickling(sandboxed: Fmu) -> None:
    with pickle.loads(pickle.dumps(sandboxed)) as again:
        pd.testing.assert_frame_equal(again.run(_TIME), sandboxed.run(_TIME), check_exact=True)
        with pytest.raises(UnsupportedFmuError, match="runs in a sandbox"):
            again.start()


def test_what_a_sandbox_does_not_do(sandboxed: Fmu, visitor: Path) -> None:
    with pytest.raises(UnsupportedFmuError, match="runs in a sandbox, which supports only whole runs"):
        sandboxed.start()
    with pytest.raises(UnsupportedFmuError, match="runs in a sandbox, which supports only whole runs"):
        sandboxed.linearize()
    with pytest.raises(ParameterError, match="own_process = True"):
        Fmu(visitor, sandbox=True, own_process=True)
    with pytest.raises(ParameterError, match="time_limit"):
        Fmu(visitor, sandbox=True, time_limit=0.0)


def test_fmus_without_a_module(joystick_path: Path, joystick_fmus3: Path) -> None:
    with pytest.raises(
        UnsupportedFmuError, match=r"no WebAssembly module .*wasm32/Joystick\.wasm; .*--platform"
    ):
        Fmu(joystick_path, sandbox=True)
    with pytest.raises(UnsupportedFmuError, match=r"of FMI 3\.0; a sandbox supports only FMI 2\.0"):
        Fmu(joystick_fmus3 / "Joystick.fmu", sandbox=True)


def test_wasmtime_is_missing(visitor: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pyjoystick.fmu.sandbox.module.find_spec", lambda _name: None)
    with pytest.raises(MissingPackageError, match=r"pip install 'pyjoystick\[sandbox\]'"):
        Fmu(visitor, sandbox=True)


def test_a_closed_fmu_gives_up_its_machines(visitor: Path) -> None:
    fmu = Fmu(visitor, sandbox=True)
    fmu.close()
    fmu.close()
    with pytest.raises(Exception, match="has been closed") as caught:
        fmu.run(_TIME)
    assert not isinstance(caught.value, FmuFileError)
