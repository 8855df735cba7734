"""Inputs requested by FMI 3 FMUs within a step (intermediate update); FMI 2 uses derivatives instead."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.inputs import InputSeries
from pyjoystick.fmu.stepping.program import PLACE_SIZE, POINT
from pyjoystick.fmu.values import REALS
from pyjoystick.support import FloatArray


def inputs_asked_for(description: FmuDescription) -> list[Variable]:
    """Inputs that may change within a step: continuous numbers that the FMU declares so; else none."""
    if not description.asks_for_inputs:
        return []
    variables = [description.variables[name] for name in description.names("input")]
    return [
        one
        for one in variables
        if one.is_set_in_steps
        and one.variability == "continuous"
        and one.type in REALS
        and not one.is_array
        and one.element is None
    ]


class Drive:
    """Inputs over the time of a run, linear between communication points."""

    def __init__(self, points: FloatArray, series: Sequence[InputSeries]) -> None:
        """Store the inputs.

        Args:
            points: communication points (s), shape (n,)
            series: the changing inputs
        """
        self._points = points
        self._series = tuple(series)

    def set_at(self, fmi: Any, time: float, point: int) -> None:
        """Set an instance's inputs for a time (s) within the step from a communication point, or at its ends.

        An input that jumps at the point has its later value there.
        """
        since = time - float(self._points[point])
        for one in self._series:
            value = float(one.values[point]) + float(one.slopes[point]) * since
            getattr(fmi, f"set{one.variable.type}")([one.variable.value_reference], [value])


class IntermediateUpdate:
    """Answers the input requests of one instance.

    Attributes:
        drive: inputs of the current run
        place: its progress, with the communication point from which the FMU steps
        failure: an exception or Ctrl-C during an answer, since exceptions cannot pass through the FMU
    """

    def __init__(self, fmi: Any) -> None:
        self._fmi = fmi
        self.drive: Drive | None = None
        self.place: NDArray[np.intp] = np.zeros(PLACE_SIZE, np.intp)
        self.failure: BaseException | None = None

    def answer(
        self, _environment: object, time: float, is_asked: bool, _gets: bool, _done: bool, _may: bool,
        early: Any, _early_time: Any,
    ) -> None:  # fmt: skip
        """Implements `fmi3IntermediateUpdateCallback`."""
        try:
            if early:
                early[0] = False
            if is_asked and self.drive is not None:
                self.drive.set_at(self._fmi, time, int(self.place[POINT]))
        except BaseException as error:
            self.failure = self.failure or error
