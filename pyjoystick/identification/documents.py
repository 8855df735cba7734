"""Reading the JSON files that the fit and budget commands write."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
from scipy.stats import t as student

from pyjoystick.identification.laboratory_errors import Contribution
from pyjoystick.laboratory import Measured
from pyjoystick.support import FloatArray, InputFileError, versions


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedValue:
    """One fitted number.

    Attributes:
        name: name of the parameter
        record: the record that it belongs to; empty if all records share it
        unit: unit of the value
        value: fitted value
        error: standard error due to the noise of the records alone; infinite if not determined
        interval: interval at the level of the fit, from the profile if there is one, else linear
        is_determined: whether the records determine it
    """

    name: str
    record: str
    unit: str
    value: float
    error: float
    interval: tuple[float, float]
    is_determined: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FittedSeries:
    """One measured series and its fit.

    Attributes:
        record: name of the record
        label: measured quantity: ``theta``
        times: sample times (s), shape (n,)
        data, fit: measured and fitted numbers, shape (n,)
        errors: standard errors of `fit`; None if unknown
        sigma: standard deviation of the noise
        curve: times (s) and values of the fitted motion every millisecond, shape (2, m); NaN in gaps
    """

    record: str
    label: str
    times: FloatArray
    data: FloatArray
    fit: FloatArray
    errors: FloatArray | None
    sigma: float
    curve: FloatArray

    @property
    def residuals(self) -> FloatArray:
        """Data minus fit, shape (n,)."""
        return self.data - self.fit


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FitDocument:
    """Contents of ``fit.json``.

    Attributes:
        source: the file, or another source
        is_complete: the fit was not interrupted
        level: confidence level of the intervals, such as 0.95
        quantile: half-width of an interval in standard errors
        values: the fitted numbers
        tied: values computed from them, by name
        fixed: values taken as known, by name
        known: names of fitted parameters whose measured value the fit used
        open: what the records cannot determine, one sentence each
        checks: name, passed, message
        unseen: effects that the records would hardly show, each with its size and what it shifts
        series: measured and fitted series, record by record; empty if peaks were compared
    """

    source: str
    is_complete: bool
    level: float
    quantile: float
    values: tuple[FittedValue, ...]
    tied: Mapping[str, float]
    fixed: Mapping[str, float]
    known: tuple[str, ...]
    open: tuple[str, ...]
    checks: tuple[tuple[str, bool, str], ...]
    unseen: tuple[str, ...]
    series: tuple[FittedSeries, ...]

    @property
    def records(self) -> tuple[str, ...]:
        """Names of the records."""
        return tuple(dict.fromkeys(one.record for one in self.series))

    def shared(self) -> dict[str, FittedValue]:
        """The fitted values that all records share, by name."""
        return {one.name: one for one in self.values if not one.record}

    def freely(self) -> dict[str, Measured]:
        """Shared values that were fitted without prior knowledge, with the standard errors of the noise."""
        return {
            name: Measured(one.value, one.error)
            for name, one in self.shared().items()
            if one.is_determined and name not in self.known
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class BudgetDocument:
    """Contents of the JSON file of ``pyjoystick budget``.

    Attributes:
        source: the file
        fitted: values and combined standard uncertainties by name
        contributions: contribution of each quantity
        exact: quantities taken as exact
    """

    source: str
    fitted: Mapping[str, tuple[float, float]]
    contributions: tuple[Contribution, ...]
    exact: tuple[str, ...]


def read_fit(path: str | PathLike[str]) -> FitDocument:
    """Read the ``fit.json`` that ``pyjoystick fit --output`` writes.

    Raises:
        InputFileError: the file cannot be read or is not a ``fit.json``
    """
    again = "pyjoystick fit ... --output FOLDER"
    return _read(Path(path), _Kind("fit.json of pyjoystick fit", again, _fit))


def read_budget(path: str | PathLike[str]) -> BudgetDocument:
    """Read the JSON file that ``pyjoystick budget --json`` writes.

    Raises:
        InputFileError: the file cannot be read or is not a budget
    """
    again = "pyjoystick budget ... --json FILE"
    return _read(Path(path), _Kind("JSON file of pyjoystick budget", again, _budget))


_T = TypeVar("_T")


class _Kind(NamedTuple, Generic[_T]):
    """A kind of file, the command that writes it, and the function that parses it."""

    name: str
    again: str
    make: Callable[[Mapping[str, Any], str], _T]


def _read(path: Path, kind: _Kind[_T]) -> _T:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else f"is not JSON: {error}"
        raise InputFileError(path, str(reason)) from error
    try:
        return kind.make(content, path.name)
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        what = f"{error} is missing" if isinstance(error, KeyError) else str(error)
        raise InputFileError(path, _misfit(content, kind, what)) from error


def _misfit(content: object, kind: _Kind[_T], what: str) -> str:
    """Explain why a file cannot be parsed: of another version, edited, or something else."""
    made = content.get("made_with") if isinstance(content, Mapping) else None
    version = made.get("pyjoystick") if isinstance(made, Mapping) else None
    if version is None:
        return f"is no {kind.name}: {what}"
    own = versions()["pyjoystick"]
    cause = f"was written by version {version} of pyjoystick"
    if version == own:
        cause = f"was edited, or written by an earlier state of pyjoystick {own}"
    return f"{cause} ({what}): make it anew with `{kind.again}`, or `pyjoystick run`"


def _fit(content: Mapping[str, Any], source: str) -> FitDocument:
    settings = content["settings"]
    level = float(settings["uncertainty"]["level"])
    is_given = bool(settings["noise"]["sigma"])
    freedom = math.inf if is_given else float(content["degrees_of_freedom"])
    peaks = settings["comparison"] == "peaks"
    return FitDocument(
        source=source,
        is_complete=not content["interrupted"],
        level=level,
        quantile=float(student.ppf(0.5 + level / 2.0, freedom)),
        values=tuple(_value(one) for one in content["parameters"]),
        tied={one["name"]: float(one["value"]) for one in content["tied"]},
        fixed={
            name: float(value)
            for name, value in settings["fixed"].items()
            if isinstance(value, int | float) and not isinstance(value, bool)
        },
        known=tuple(one["name"] for one in settings["free"] if one["uncertainty"] is not None),
        open=tuple(map(str, content["identifiability"]["open"])),
        checks=tuple((one["name"], bool(one["passed"]), one["message"]) for one in content["checks"]),
        unseen=tuple(
            f"{one['suspect']} ({one['size']} moves {one['parameter']} by {100.0 * one['part']:.2g} %)"
            for one in content["unseen"]
        ),
        series=() if peaks else tuple(part for one in content["records"] for part in _series(one)),
    )


def _value(content: Mapping[str, Any]) -> FittedValue:
    profile = content.get("profile")
    interval = _numbers(profile["interval"] if profile and profile["followed"] else content["interval"])
    error = content["standard_error"]
    found = FittedValue(
        name=content["name"],
        record=content["record"] or "",
        unit=content["unit"],
        value=float(_numbers(content["value"])),
        error=math.inf if error is None else float(_numbers(error)),
        interval=(float(interval[0]), float(interval[1])),
        is_determined=bool(content["determined"]) and error is not None,
    )
    least, most = found.interval
    if not found.error >= 0.0 or found.value < least or found.value > most:
        raise ValueError(f"value, standard error and interval of {found.name} contradict one another")
    return found


def _series(content: Mapping[str, Any]) -> list[FittedSeries]:
    labels = np.array(content["labels"])
    columns = {key: _numbers(content[key]) for key in ("times", "data", "fit")}
    errors = None if content["fit_error"] is None else _numbers(content["fit_error"])
    found = []
    for label, sigma in content["noise"].items():
        own = labels == label
        found.append(
            FittedSeries(
                record=content["name"],
                label=label,
                **{key: column[own] for key, column in columns.items()},
                errors=None if errors is None else errors[own],
                sigma=float(sigma),
                curve=np.array([_numbers(content["curve"][key]) for key in ("time", label)]),
            )
        )
    return found


def _budget(content: Mapping[str, Any], source: str) -> BudgetDocument:
    return BudgetDocument(
        source=source,
        fitted={
            one["name"]: (float(one["value"]), float(one["standard_uncertainty"]))
            for one in content["parameters"]
        },
        contributions=tuple(
            Contribution(
                one["stage"],
                *(float(_numbers(one[key])) for key in ("theta", "omega", "period", "J", "C")),
            )
            for one in content["contributions"]
        ),
        exact=tuple(map(str, content["exact"])),
    )


def _numbers(content: Any) -> Any:
    """Convert to numbers, with NaN for null."""
    if isinstance(content, bool):
        raise TypeError(f"{str(content).lower()} is not a number")
    return np.array(content, dtype=np.float64)
