"""Ctrl-C that arrives while an FMU calls Python: no exception passes through native code."""

from __future__ import annotations

import signal
import sys
from ctypes import CFUNCTYPE
from pathlib import Path

import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.fmu.interrupts import CtrlC
from pyjoystick.fmu.log import FmuLog
from tests.pyjoystick.fmu.awkward import Trouble

TIME = [0.0, 0.25, 0.5]


@pytest.fixture
def ctrl_c_in_messages(monkeypatch: pytest.MonkeyPatch) -> None:
    """A real SIGINT at each message of an FMU, handled within the function that the FMU calls."""
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler

    def add(_log: FmuLog, _text: bytes) -> None:
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(FmuLog, "add", add)


@pytest.mark.usefixtures("loop", "ctrl_c_in_messages")
@pytest.mark.parametrize("version", [2, 3])
def test_a_run_ends(version: int, awkward_path: Path, awkward3_path: Path) -> None:
    path = awkward_path if version == 2 else awkward3_path
    with Fmu(path, own_process=False) as fmu:
        plan = fmu.plan(TIME, varied="trouble", inputs={"u": 1.0}, outputs="y")
        before = plan.run([Trouble.NONE])
        with pytest.raises(KeyboardInterrupt):
            plan.run([Trouble.WARNINGS])
        assert (plan.run([Trouble.NONE]) == before).all()


@pytest.mark.usefixtures("ctrl_c_in_messages")
def test_a_step_of_a_live_simulation_ends(awkward_path: Path) -> None:
    with (
        Fmu(awkward_path, own_process=False) as fmu,
        pytest.raises(KeyboardInterrupt),
        fmu.start(parameters={"trouble": Trouble.WARNINGS}) as live,
    ):
        live.step(0.1)


def test_other_exceptions_go_where_they_went(monkeypatch: pytest.MonkeyPatch) -> None:
    others = []
    monkeypatch.setattr(sys, "unraisablehook", others.append)
    hook = sys.unraisablehook

    @CFUNCTYPE(None)
    def fails() -> None:
        raise ValueError

    with CtrlC():
        fails()
    assert [one.exc_type for one in others] == [ValueError]
    assert sys.unraisablehook is hook


def test_an_error_on_its_way_is_not_replaced() -> None:
    @CFUNCTYPE(None)
    def interrupted() -> None:
        raise KeyboardInterrupt

    def fails() -> None:
        with CtrlC():
            interrupted()
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fails()
