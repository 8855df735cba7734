"""Varied values, checked for one run or for a table of many."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyjoystick.fmu.description import Variable
from pyjoystick.fmu.values import EXACT, INTEGERS, allowed_values, limits, stored_type
from pyjoystick.support import ParameterError, type_text, without_mask

if TYPE_CHECKING:
    import pandas as pd

#: Numbers to NumPy, or to its conversions, that have more than one part, or a unit.
_NO_NUMBERS: Final = (complex, np.complexfloating, np.datetime64, np.timedelta64)


class Varied:
    """The variables that differ between runs, with their allowed values.

    Attributes:
        variables: in the order of a row
        names: names of the variables
    """

    def __init__(self, variables: Sequence[Variable]) -> None:
        self.variables = tuple(variables)
        self.names = tuple(variable.name for variable in variables)
        # Use Python integers where floats do not represent every value.
        is_wide = any(one.type in INTEGERS and stored_type(one) in ("int64", "uint64") for one in variables)
        self._type: Any = object if is_wide else np.float64
        ranges = np.array([limits(variable) for variable in variables], dtype=self._type).reshape(-1, 2)
        self._low, self._high = ranges.T
        self._whole = np.array([one.type in (*INTEGERS, "Boolean") for one in variables], dtype=np.bool_)

    def row(self, values: ArrayLike) -> NDArray[Any]:
        """Values of one run, shape (1, variables); raises ParameterError as `table`."""
        row = self._numbers(values)
        if row.shape != self._low.shape:
            wanted = f"of shape {self._low.shape}, for {', '.join(self.names) or 'no varied parameters'}"
            raise ParameterError("values", f"an array of shape {row.shape}", wanted)
        row = row.reshape(1, -1)
        sound = self._sound(row)
        if not sound.all():
            self._refuse(row, sound, "")
        return row

    def table(self, table: pd.DataFrame | ArrayLike) -> tuple[pd.DataFrame, NDArray[Any]]:
        """Values of many runs, by name and as numbers, shape (runs, variables).

        The numbers are floats, or Python integers if a variable is a 64-bit integer.

        Raises:
            ParameterError: the table has other columns, or a value is NaN, out of range, not an integer or
                not 0 or 1 where it must be, or a float that may represent several integers; the field is
                then ``name[row]``
        """
        named = self._named(table)
        numbers = self._numbers(named)
        sound = self._sound(numbers)
        if not sound.all():
            self._refuse(numbers, sound, f"[{named.index[np.nonzero(~sound)[0][0]]}]")
        return named, numbers

    def _named(self, table: pd.DataFrame | ArrayLike) -> pd.DataFrame:
        import pandas as pd  # only for tables, see `motion.make_table`

        if not isinstance(table, pd.DataFrame):
            numbers = self._numbers(table)
            if numbers.ndim != 2 or numbers.shape[1] != len(self.names):
                wanted = f"of shape (runs, {len(self.names)}), for {', '.join(self.names)}"
                raise ParameterError("table", f"an array of shape {numbers.shape}", wanted)
            return pd.DataFrame(numbers, columns=list(self.names)).infer_objects()
        if sorted(map(str, table.columns)) != sorted(self.names):
            has = ", ".join(map(str, table.columns)) or "none"
            raise ParameterError("table", f"the columns {has}", f"the varied: {', '.join(self.names)}")
        return table[list(self.names)]

    def _sound(self, numbers: NDArray[Any]) -> NDArray[np.bool_]:
        with np.errstate(invalid="ignore"):
            sound: NDArray[np.bool_] = (numbers >= self._low) & (numbers <= self._high)
        if self._whole.any():
            sound &= ~self._whole | (numbers == np.floor(numbers, where=sound, out=numbers.copy()))
        if self._type is object:
            sound &= ~self._whole | ~_is_rounded(numbers)
        return sound

    def _refuse(self, numbers: NDArray[Any], sound: NDArray[np.bool_], place: str) -> None:
        row, column = (int(places[0]) for places in np.nonzero(~sound))
        variable, number = self.variables[column], numbers[row, column]
        allowed = "0 or 1" if variable.type == "Boolean" else allowed_values(variable)
        is_inside = variable.type in INTEGERS and self._low[column] <= number <= self._high[column]
        hint = "a float is exact up to 2^53; give an integer" if is_inside and number % 1 == 0 else ""
        raise ParameterError(f"{variable.name}{place}", number, allowed, hint)

    def _typed_parts(self, values: Any) -> Iterator[tuple[Any, Sequence[Variable]]]:
        """The columns of a table, or the whole of another object of pandas, each with its variables."""
        if getattr(values, "ndim", 0) == 2 and hasattr(values, "iloc"):
            for i in range(values.shape[1]):
                yield values.iloc[:, i], self.variables[i : i + 1]
        elif hasattr(values, "to_numpy"):
            yield values, self.variables

    def _numbers(self, values: Any) -> NDArray[Any]:
        numbers: NDArray[Any] | None = None
        with suppress(TypeError, ValueError):
            # Columns are examined before the conversion, which drops imaginary parts and units of time.
            for part, variables in self._typed_parts(values):
                _require_numbers(part, variables)
            given = values.to_numpy(self._type) if hasattr(values, "to_numpy") else values
            if isinstance(given, np.ma.MaskedArray):
                given = without_mask(given)
            _require_numbers(np.asarray(given), self.variables)
            numbers = np.ascontiguousarray(given, dtype=self._type)
        if numbers is None or (self._type is object and not all(map(_is_real, numbers.flat))):
            raise ParameterError("values", type_text(values), "made of numbers in rows")
        return numbers


def _require_numbers(values: Any, variables: Sequence[Variable]) -> None:
    """Raise TypeError for values with a `dtype` that a conversion to numbers would change."""
    kinds = {values.dtype.kind, np.asarray(values).dtype.kind}
    if kinds & set("cmM") or any(isinstance(one, _NO_NUMBERS) for one in _objects(values)):
        raise TypeError("complex numbers, dates and durations would lose a part or their unit")
    if "b" in kinds and any(one.type != "Boolean" for one in variables):
        raise TypeError("Booleans are no numbers")


def _objects(values: Any) -> Iterable[Any]:
    array = np.asarray(values)
    return array.flat if array.dtype.kind == "O" else ()


def _is_real(value: object) -> bool:
    return isinstance(value, Real | np.bool_)


def _is_rounded(numbers: NDArray[Any]) -> NDArray[np.bool_]:
    """True for floats so large that not every integer is one."""
    rounded = [not isinstance(one, Integral | np.bool_) and not abs(one) <= EXACT for one in numbers.flat]
    return np.array(rounded, dtype=np.bool_).reshape(numbers.shape)
