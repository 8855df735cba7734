"""The parameters that differ from run to run: one row of numbers a run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from pyjoystick.fmu.description import Variable
from pyjoystick.fmu.values import INTEGERS, allowed_values, limits
from pyjoystick.support import FloatArray, ParameterError


class Varied:
    """The variables that each run gives, with what they may be.

    Attributes:
        variables: in the order of a row
        names: of the variables
    """

    def __init__(self, variables: Sequence[Variable]) -> None:
        self.variables = tuple(variables)
        self.names = tuple(variable.name for variable in variables)
        ranges = np.array([limits(variable) for variable in variables], dtype=np.float64).reshape(-1, 2)
        self._low, self._high = ranges.T
        self._whole = np.array([one.type in (*INTEGERS, "Boolean") for one in variables], dtype=np.bool_)

    def row(self, values: ArrayLike) -> FloatArray:
        """The values of one run, shape (1, variables); raises ParameterError as `table`."""
        row = _numbers(values)
        if row.shape != self._low.shape:
            wanted = f"of shape {self._low.shape}, for {', '.join(self.names) or 'no varied parameters'}"
            raise ParameterError("values", f"an array of shape {row.shape}", wanted)
        row = row.reshape(1, -1)
        sound = self._sound(row)
        if not sound.all():
            self._refuse(row, sound, "")
        return row

    def table(self, table: pd.DataFrame | ArrayLike) -> tuple[pd.DataFrame, FloatArray]:
        """The values of many runs, with names and as numbers, shape (runs, variables).

        Raises:
            ParameterError: the table has other columns, or a value is NaN, out of range, or no whole number
                or no 0 or 1 where it must be; the field is then ``name[row]``
        """
        named = self._named(table)
        numbers = _numbers(named)
        sound = self._sound(numbers)
        if not sound.all():
            self._refuse(numbers, sound, f"[{named.index[np.nonzero(~sound)[0][0]]}]")
        return named, numbers

    def _named(self, table: pd.DataFrame | ArrayLike) -> pd.DataFrame:
        if not isinstance(table, pd.DataFrame):
            numbers = _numbers(table)
            if numbers.ndim != 2 or numbers.shape[1] != len(self.names):
                wanted = f"of shape (runs, {len(self.names)}), for {', '.join(self.names)}"
                raise ParameterError("table", f"an array of shape {numbers.shape}", wanted)
            return pd.DataFrame(numbers, columns=list(self.names))
        if sorted(map(str, table.columns)) != sorted(self.names):
            has = ", ".join(map(str, table.columns)) or "none"
            raise ParameterError("table", f"the columns {has}", f"the varied: {', '.join(self.names)}")
        return table[list(self.names)]

    def _sound(self, numbers: FloatArray) -> np.typing.NDArray[np.bool_]:
        sound: np.typing.NDArray[np.bool_] = (numbers >= self._low) & (numbers <= self._high)
        if self._whole.any():
            sound &= ~self._whole | (numbers == np.floor(numbers))
        return sound

    def _refuse(self, numbers: FloatArray, sound: np.typing.NDArray[np.bool_], place: str) -> None:
        row, column = (int(places[0]) for places in np.nonzero(~sound))
        variable = self.variables[column]
        allowed = "0 or 1" if variable.type == "Boolean" else allowed_values(variable)
        raise ParameterError(f"{variable.name}{place}", numbers[row, column], allowed)


def _numbers(values: pd.DataFrame | ArrayLike) -> FloatArray:
    try:
        return np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ParameterError("values", f"a {type(values).__name__}", "made of numbers in rows") from None
