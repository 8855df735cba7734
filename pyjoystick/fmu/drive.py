"""Inputs that an FMU of FMI 3 asks for within a step (intermediate update), where FMI 2 takes derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.inputs import InputSeries
from pyjoystick.fmu.values import REALS
from pyjoystick.support import FloatArray


def inputs_asked_for(description: FmuDescription) -> list[Variable]:
    """The inputs that may move within a step: continuous numbers of an FMU that asks for them; else none."""
    if not description.asks_for_inputs:
        return []
    variables = [description.variables[name] for name in description.names("input")]
    return [
        one
        for one in variables
        if one.variability == "continuous" and one.type in REALS and not one.is_array and one.element is None
    ]


class Drive:
    """Inputs over the time of a run, straight from one communication point to the next."""

    def __init__(self, points: FloatArray, series: Sequence[InputSeries]) -> None:
        """Keep them.

        Args:
            points: communication points (s), shape (n,)
            series: the inputs that move
        """
        self._points = points
        self._series = tuple(series)

    def set_at(self, fmi: Any, time: float) -> None:
        """Give an instance its inputs at a time (s) within a step, or at the end of one."""
        last = min(max(int(np.searchsorted(self._points, time)) - 1, 0), len(self._points) - 2)
        since = time - float(self._points[last])
        for one in self._series:
            value = float(one.values[last]) + float(one.slopes[last]) * since
            getattr(fmi, f"set{one.variable.type}")([one.variable.value_reference], [value])


class IntermediateUpdate:
    """What answers the questions of one instance.

    Attributes:
        drive: of the run that is under way
        failure: an answer failed, or Ctrl-C fell into it: no exception finds its way out of the FMU
    """

    def __init__(self, fmi: Any) -> None:
        self._fmi = fmi
        self.drive: Drive | None = None
        self.failure: BaseException | None = None

    def answer(
        self, _environment: object, time: float, is_asked: bool, _gets: bool, _done: bool, _may: bool,
        early: Any, _early_time: Any,
    ) -> None:  # fmt: skip
        """`fmi3IntermediateUpdateCallback`."""
        try:
            if early:
                early[0] = False
            if is_asked and self.drive is not None:
                self.drive.set_at(self._fmi, time)
        except BaseException as error:
            self.failure = self.failure or error
