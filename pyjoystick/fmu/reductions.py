"""Reductions: what a batch keeps of each run instead of its whole trajectory.

Each reduction names the columns that it adds to the table of results. Values are in the unit of the variable,
times in s. A cell is NaN if there is no result: the run failed, or a peak did not occur.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from pyjoystick.fmu.stepping.reducing import EXTREMES, FINAL, LOSS, PEAKS, Operation
from pyjoystick.support import FloatArray, ParameterError, UnknownVariableError, not_negative, whole_number

#: A larger number of peaks is taken for a mistake.
_MOST_PEAKS = 10_000


@dataclass(frozen=True, slots=True)
class Final:
    """The last sample of a variable: ``theta.final``."""

    variable: str

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the result columns."""
        return (f"{self.variable}.final",)


@dataclass(frozen=True, slots=True)
class Extremes:
    """Largest and smallest sample with their times: ``theta.max``, ``.max_time``, ``.min``, ``.min_time``."""

    variable: str

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the result columns."""
        return tuple(f"{self.variable}.{what}" for what in ("max", "max_time", "min", "min_time"))


@dataclass(frozen=True, slots=True)
class Peaks:
    """The first peaks, of both signs, with interpolation by `pyjoystick.motion.peaks.find_peaks`.

    The columns are ``theta.peak1``, ``theta.peak1_time``, ``theta.peak2`` and so on.

    Attributes:
        variable: the series
        count: number of peaks to keep, from 1 to 10,000
        derivative: variable that is its time derivative (``omega`` for ``theta``), which must be recorded as
            well; if None, peaks are found from the samples alone
        minimum_height: peaks with a smaller absolute value are ignored
        minimum_prominence: see `find_peaks`
    """

    variable: str
    count: int
    derivative: str | None = None
    minimum_height: float = 0.0
    minimum_prominence: float = 0.0

    def __post_init__(self) -> None:
        whole_number("count", self.count, 1)
        if self.count > _MOST_PEAKS:
            raise ParameterError("count", self.count, f"{_MOST_PEAKS} at most")
        not_negative("minimum_height", self.minimum_height)
        not_negative("minimum_prominence", self.minimum_prominence)

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the result columns."""
        names = (f"{self.variable}.peak{number}" for number in range(1, self.count + 1))
        return tuple(column for name in names for column in (name, f"{name}_time"))


@dataclass(frozen=True, slots=True)
class Loss:
    """Decrease of a variable, such as the energy ``E``, from the first to the last sample: ``E.loss``."""

    variable: str

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the result columns."""
        return (f"{self.variable}.loss",)


#: Any reduction.
Reduction = Final | Extremes | Peaks | Loss

_KINDS = {Final: FINAL, Extremes: EXTREMES, Loss: LOSS}


def checked_reductions(reductions: Iterable[Reduction], outputs: Sequence[str]) -> tuple[Reduction, ...]:
    """Check that the reductions' variables are recorded and their columns differ.

    Raises:
        UnknownVariableError: a variable is not among the outputs of the plan
        ParameterError: there are no reductions, one is of an unknown kind, or two have a column in common
    """
    if not isinstance(reductions, Iterable):
        raise ParameterError("reductions", reductions, "a sequence of reductions, even if there is one")
    checked = tuple(reductions)
    if not checked:
        raise ParameterError("reductions", "an empty sequence", "one or more, or None to keep the samples")
    columns: set[str] = set()
    for reduction in checked:
        if not isinstance(reduction, Reduction):
            raise ParameterError("reductions", reduction, "made of Final, Extremes, Peaks and Loss")
        for name in (reduction.variable, getattr(reduction, "derivative", None)):
            if name is not None and name not in outputs:
                raise UnknownVariableError(name, outputs)
        for column in reduction.columns:
            if column in columns:
                raise ParameterError("reductions", reduction, f"without a second column {column}")
            columns.add(column)
    return checked


def operations_of(reductions: Sequence[Reduction], outputs: Sequence[str]) -> list[Operation]:
    """Convert checked reductions for the loop, for samples with the columns `outputs`."""
    operations, cell = [], 0
    for one in reductions:
        column = outputs.index(one.variable)
        if isinstance(one, Peaks):
            slope = -1 if one.derivative is None else outputs.index(one.derivative)
            height, prominence = float(one.minimum_height), float(one.minimum_prominence)
            operations.append(Operation(PEAKS, column, slope, cell, one.count, height, prominence))
        else:
            operations.append(Operation(_KINDS[type(one)], column, -1, cell, 0, 0.0, 0.0))
        cell += len(one.columns)
    return operations


def not_finite(reductions: Sequence[Reduction], cells: FloatArray) -> dict[int, str]:
    """Return the runs with results that are NaN or infinite, and the first such result of each.

    NaN does not count for peaks: they may be fewer than wanted.

    Args:
        reductions: what was kept
        cells: the results, shape (runs, columns)
    """
    columns = [column for one in reductions for column in one.columns]
    may_lack = np.array([isinstance(one, Peaks) for one in reductions for _ in one.columns])
    wrong = np.isinf(cells) | (np.isnan(cells) & ~may_lack)
    return {int(run): columns[int(np.argmax(wrong[run]))] for run in np.flatnonzero(wrong.any(axis=1))}


def units_of(reductions: Sequence[Reduction], units: Mapping[str, str]) -> dict[str, str]:
    """Unit of each result column, from those of the variables."""
    return {
        column: "s" if column.endswith("_time") else units[one.variable]
        for one in reductions
        for column in one.columns
    }
