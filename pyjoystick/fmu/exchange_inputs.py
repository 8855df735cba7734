"""Inputs of Model Exchange runs through FMPy's loop."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import pandas as pd
from fmpy.simulation import Input
from numpy.typing import NDArray

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.values import INTEGERS

_TYPES: Final = {"Boolean": np.bool_} | dict.fromkeys(INTEGERS, np.int64)


def input_signals(description: FmuDescription, table: pd.DataFrame) -> NDArray[Any]:
    """All inputs over the time as FMPy takes them; those that the table lacks keep their start values."""
    variables = [description.variables[name] for name in description.names("input")]
    types = [("time", np.float64), *((one.name, _TYPES.get(one.type, np.float64)) for one in variables)]
    signals = np.empty(len(table), dtype=types)
    signals["time"] = table.index
    for one in variables:
        signals[one.name] = table[one.name] if one.name in table else _start(one)
    return signals


def _start(variable: Variable) -> float | bool:
    text = variable.start or "0"
    return text in ("true", "1") if variable.type == "Boolean" else float(text)


def apply_inputs_with_time(fmi: Any, model_description: Any, signals: NDArray[Any]) -> None:
    """Have the inputs follow the time wherever it is set.

    FMPy's loop sets the time in the right-hand side that CVode integrates, but the inputs only once a step,
    so that they would be constant in between whatever the tolerance.

    Args:
        fmi: FMPy's object of the instance
        model_description: as FMPy reads it
        signals: as of `input_signals`
    """
    inputs = Input(fmi, model_description, signals)
    set_time = fmi.setTime

    def set_time_and_inputs(time: float) -> None:
        set_time(time)
        # At a jump what comes after it, for CVode begins anew there and evaluates that very instant first.
        inputs.apply(time, discrete=False, after_event=True)

    fmi.setTime = set_time_and_inputs
