"""The variables of a search: starts, bounds, and their mapping to parameters of the FMU."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pyjoystick.fmu import FmuDescription, checked_value
from pyjoystick.identification.fitting.problem.instrument import (
    DELAY,
    INSTRUMENT,
    RELEASE_TIME,
    ZERO_OFFSET,
    Instrument,
)
from pyjoystick.identification.fitting.problem.measurement import Measurement, Release, guess_release
from pyjoystick.identification.fitting.problem.settings import FitSettings, Free
from pyjoystick.identification.fitting.problem.ties import Ties, names_in
from pyjoystick.support import FloatArray, ParameterError, UnknownParameterError, UnknownVariableError

#: Range of the release time about its guess (s), and factors that bound the release angle.
_TIME_RANGE = 0.15
_ANGLE_RANGE = (0.7, 1.6)
#: Range of the zero relative to the largest measured value; range of relative values and of times (s).
_ZERO_RANGE = 0.25
_INSTRUMENT_RANGE = 0.2
#: Where the settings leave out a bound, a parameter of the FMU is sought within this factor of its start.
#: Without a limit, a search may try an inertia of a millionth, with which a single run takes half a minute.
_REACH = 1e3
#: A value below this part of its scale counts as possibly zero.
_ROUNDING = 1e-6


@dataclass(frozen=True, slots=True)
class Variable:
    """One variable of the search.

    Attributes:
        name: parameter of the FMU, or number of the `Instrument`
        record: index of the record that it belongs to; None if all records share it
        label: its name in reports
        unit: its unit, empty for a pure number
        start, minimum, maximum: start of the search and bounds, which may be infinite
        uncertainty: standard uncertainty of the start, if that was measured; else None
        reach: the range that a search keeps to where neither settings nor data bound the variable
    """

    name: str
    record: int | None
    label: str
    unit: str
    start: float
    minimum: float
    maximum: float
    uncertainty: float | None = None
    reach: tuple[float, float] = (-math.inf, math.inf)

    @property
    def lowest(self) -> float:
        """The lower limit of a search."""
        return max(self.minimum, self.reach[0])

    @property
    def highest(self) -> float:
        """The upper limit of a search."""
        return min(self.maximum, self.reach[1])

    @property
    def scale(self) -> float:
        """Typical magnitude of a large change.

        The start value; if that is 0, a tenth of the range, or 1 without bounds. A tenth of a second for
        the time of release.
        """
        if self.name == RELEASE_TIME:
            return 0.1
        if self.start != 0.0:
            return abs(self.start)
        width = self.maximum - self.minimum
        return 0.1 * width if math.isfinite(width) else 1.0

    def size(self, value: float) -> float:
        """Reference for percentages: the value, or the scale if the value is zero or a time.

        The zero of a time is arbitrary.
        """
        zero = self.name == RELEASE_TIME or abs(value) <= _ROUNDING * self.scale
        return self.scale if zero else abs(value)

    @property
    def of_instrument(self) -> bool:
        """Whether it describes the instrument of a record and not the FMU."""
        return self.name in INSTRUMENT


class Variables:
    """All variables of a fit, in the order of the vectors x used throughout the package.

    Attributes:
        free: the variables: parameters of the FMU, and auxiliary ones that only ties use
        varied: the FMU's parameters that they determine, ties included
        tied: the varied parameters that are computed from others
        in_ties: names that these computations use
    """

    def __init__(
        self, settings: FitSettings, description: FmuDescription, records: Sequence[Measurement]
    ) -> None:
        """Raises ParameterError or UnknownParameterError if a name, bound or expression is not allowed."""
        self._count = len(records)
        for name in (*(one.name for one in settings.free), *settings.fixed):
            if name in INSTRUMENT and name in description.variables:
                raise ParameterError(name, "given", "left out: the FMU has a variable of this name itself")
        self._instrument = {
            name: float(value) for name, value in settings.fixed.items() if name in INSTRUMENT
        }
        guesses = [_release_of(settings, record) for record in records]
        free: list[Variable] = []
        own = [one.name for one in settings.free if one.name not in INSTRUMENT]
        self.in_ties = names_in(settings.ties.values())
        for one in settings.free:
            require_known(one, description, self.in_ties)
            first = settings.outputs[0]
            largest = [_largest(record, first) for record in records]
            if one.per_record:
                free += [
                    _variable(one, description, first, _Seen(guess, size), i, record.name)
                    for i, (guess, size, record) in enumerate(zip(guesses, largest, records, strict=True))
                ]
            else:
                free.append(_variable(one, description, first, _Seen(guesses[0], max(largest)), None, ""))
        self.free = tuple(free)
        self.tied = tuple(settings.ties)
        self._settable = [k for k, name in enumerate(own) if name in description.variables]
        self.varied = (*(own[k] for k in self._settable), *self.tied)
        self._starts = [float(record.time[0]) for record in records]
        self._places = [[self.place(name, record) for name in own] for record in range(self._count)]
        self._instrument_places = [
            {name: place for name in INSTRUMENT if (place := self.place(name, record)) is not None}
            for record in range(self._count)
        ]
        self._ties = Ties(own, settings.ties, description)

    @property
    def start(self) -> FloatArray:
        """Start values, shape (variables,)."""
        return np.array([variable.start for variable in self.free])

    @property
    def lower(self) -> FloatArray:
        """Lower limits of a search, shape (variables,)."""
        return np.array([variable.lowest for variable in self.free])

    @property
    def upper(self) -> FloatArray:
        """Upper limits of a search, shape (variables,)."""
        return np.array([variable.highest for variable in self.free])

    @property
    def origins(self) -> FloatArray:
        """Origins from which a search counts x, shape (variables,): the guess for a time, else 0."""
        return np.array([one.start if one.name == RELEASE_TIME else 0.0 for one in self.free])

    @property
    def labels(self) -> tuple[str, ...]:
        """Names for reports."""
        return tuple(variable.label for variable in self.free)

    def row(self, x: FloatArray, record: int) -> FloatArray:
        """Values of `varied` for one record, shape (len(varied),)."""
        own = [float(x[place]) for place in self._places[record] if place is not None]
        return np.array([own[k] for k in self._settable] + self._ties.values(own))

    def tied_values(self, x: FloatArray, record: int) -> FloatArray:
        """Values of `tied` for one record, shape (len(tied),)."""
        return self.row(x, record)[len(self.varied) - len(self.tied) :]

    def instrument(self, x: FloatArray, record: int) -> Instrument:
        """The instrument of a record; without a release time, the FMU starts with the record."""
        free = {name: float(x[place]) for name, place in self._instrument_places[record].items()}
        return Instrument(**({RELEASE_TIME: self._starts[record]} | self._instrument | free))

    def instrument_places(self, record: int) -> Mapping[str, int]:
        """Indices of the variables that belong to a record's instrument, by name."""
        return self._instrument_places[record]

    def concerns(self, variable: int, record: int) -> bool:
        """Whether a variable affects a record."""
        return self.free[variable].record in (None, record)

    def place(self, name: str, record: int) -> int | None:
        """Index of the variable of this name that affects a record; None if it is not free."""
        return next(
            (i for i, v in enumerate(self.free) if v.name == name and v.record in (None, record)), None
        )


def _release_of(settings: FitSettings, record: Measurement) -> Release | None:
    """Guess of the release, if the release is fitted."""
    wanted = {one.name for one in settings.free} & {RELEASE_TIME, "theta_start"}
    if not wanted or "theta" not in record.columns:
        return None
    theta = record.series("theta")
    if settings.inputs:
        # A driven motion may start anywhere.
        return Release(float(theta[0]), float(record.time[0]), _ZERO_RANGE * float(np.max(np.abs(theta))))
    return guess_release(record.time, theta)


def _largest(record: Measurement, output: str) -> float:
    """The largest value of an output, 1 if the record does not have it."""
    return float(np.max(np.abs(record.series(output)))) if output in record.columns else 1.0


def require_known(one: Free, description: FmuDescription, in_ties: Set[str]) -> None:
    """Check a free parameter against the FMU.

    Args:
        one: the free parameter
        description: description of the FMU
        in_ties: names that ties use; those that the FMU does not have are auxiliary parameters

    Raises:
        UnknownParameterError: FMU, instrument and ties have no parameter of this name
        ParameterError: the parameter cannot be free, its values are outside the limits of the FMU, or an
            auxiliary parameter has no start
    """
    if one.name in INSTRUMENT:
        return
    if one.name not in description.variables:
        if one.name not in in_ties:
            raise UnknownParameterError(one.name, [*INSTRUMENT, *description.settable_names()])
        if one.start is None:
            raise ParameterError(f"{one.name}.start", None, "given: the FMU has no parameter of this name")
        return
    known = description.variables[one.name]
    if known.type != "Real" or not known.settable_at_start:
        raise ParameterError(one.name, "free", "a real parameter or start value that can be set")
    for value in (one.start, one.minimum, one.maximum):
        if value is not None:
            checked_value(known, value)


class _Seen(NamedTuple):
    """What a record shows: its release, if required, and its largest value."""

    release: Release | None
    largest: float


def _variable(
    one: Free, description: FmuDescription, output: str, seen: _Seen, record: int | None, record_name: str
) -> Variable:
    label = f"{one.name} [{record_name}]" if record is not None else one.name
    guess = seen.release
    if one.name == RELEASE_TIME:
        start, low, high, unit = _release_time(one, guess)
    elif one.name == ZERO_OFFSET:
        if output not in description.variables:
            raise UnknownVariableError(output, description.variables)
        start, unit = 0.0, description.variables[output].unit or ""
        high = _ZERO_RANGE * (seen.largest or 1.0)
        low = -high
    elif one.name in INSTRUMENT:
        start, low, high = 0.0, -_INSTRUMENT_RANGE, _INSTRUMENT_RANGE
        unit = "s" if one.name == DELAY else ""
    elif one.name not in description.variables:
        start, low, high, unit = 0.0, -math.inf, math.inf, ""
    else:
        start, low, high = _fmu_parameter(one, description, guess)
        unit = description.variables[one.name].unit or ""
    low = low if one.minimum is None else one.minimum
    high = high if one.maximum is None else one.maximum
    start = start if one.start is None else one.start
    if not low < high or not low <= start <= high:
        raise ParameterError(f"{one.name}.start", start, f"within the bounds, {low:g} to {high:g}")
    reach = _reach(one, start, low) if one.name in description.variables else (-math.inf, math.inf)
    return Variable(one.name, record, label, unit, start, low, high, one.uncertainty, reach)


def _reach(one: Free, start: float, low: float) -> tuple[float, float]:
    """Range about the start of a parameter of the FMU where the settings leave out a bound.

    Downwards only for one that cannot be zero: damping or friction may well vanish.
    """
    if start <= 0.0 or low < 0.0:
        return -math.inf, math.inf
    least = start / _REACH if low > 0.0 and one.minimum is None else -math.inf
    return least, start * _REACH if one.maximum is None else math.inf


def _release_time(one: Free, guess: Release | None) -> tuple[float, float, float, str]:
    if guess is None and (one.start is None or one.minimum is None or one.maximum is None):
        raise ParameterError(RELEASE_TIME, "free", "given with start, minimum and maximum for this record")
    time = guess.time if guess is not None else 0.0
    return time, time - _TIME_RANGE, time + _TIME_RANGE, "s"


def _fmu_parameter(
    one: Free, description: FmuDescription, guess: Release | None
) -> tuple[float, float, float]:
    known = description.variables[one.name]
    low = -math.inf if known.minimum is None else float(known.minimum)
    high = math.inf if known.maximum is None else float(known.maximum)
    if one.name == "theta_start" and guess is not None:
        ends = sorted(factor * guess.angle for factor in _ANGLE_RANGE)
        if guess.spread:
            ends = [guess.angle - guess.spread, guess.angle + guess.spread]
        return guess.angle, max(low, ends[0]), min(high, ends[1])
    return float(known.start or 0.0), low, high
