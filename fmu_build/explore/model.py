"""The description of a model for its page, from modelDescription.xml and the inputs of its default run."""

from __future__ import annotations

import csv
import math
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fmpy import read_model_description

from fmu_build.explore.ranges import Range, range_of
from fmu_build.packaging.reference_results import FOLDER
from fmu_build.support.errors import BuildError

_KINDS = {"Real": "r", "Integer": "i", "Enumeration": "i", "Boolean": "b"}
#: Number of inner variables that a page offers for plots of large models.
_MOST_LOCALS = 400
#: Largest number of rows of a run: a plot cannot show more, and it limits the time of the run.
MOST_ROWS = 50_000


@dataclass(frozen=True, slots=True)
class PageVariable:
    """A variable: how it is shown and, if it can be set, its start value and slider."""

    name: str
    reference: int
    kind: str
    """``r``, ``i`` or ``b``: Real; Integer or Enumeration; Boolean."""
    causality: str
    text: str = ""
    unit: str = ""
    display_unit: str = ""
    factor: float = 1.0
    """A value in the display unit is `factor` times the value in the unit plus `offset`."""
    offset: float = 0.0
    derivative: str | None = None
    """Name of the variable that is the time derivative of this one."""
    settable: bool = False
    start: float | None = None
    given: bool = False
    """True if `start` differs from the model's default and must be passed to the model."""
    minimum: float | None = None
    maximum: float | None = None
    range: Range | None = None
    literals: tuple[tuple[int, str], ...] = ()


@dataclass(frozen=True, slots=True)
class PageModel:
    """A model with its default experiment; times in seconds."""

    name: str
    text: str
    start_time: float
    stop_time: float
    step: float
    tolerance: float
    variables: tuple[PageVariable, ...]
    tables: dict[str, tuple[tuple[float, float], ...]]
    """Inputs of the default experiment: (time, value), linear between rows; two rows at one time are a jump.
    """

    def variable(self, name: str) -> PageVariable | None:
        """Return the variable with this name, or None."""
        return next((one for one in self.variables if one.name == name), None)


def page_model(fmu: Path) -> PageModel:
    """Read an FMU with FMI 2 Co-Simulation; raises `BuildError` for any other, or a damaged one."""
    try:
        description = read_model_description(str(fmu), validate=False)
        inputs = _input_rows(
            fmu, description.coSimulation.modelIdentifier if description.coSimulation else ""
        )
    except Exception as error:  # FMPy passes on whatever its XML parser or the archive raises.
        raise BuildError(f"cannot read {fmu} as an FMU: {error}") from error
    if description.fmiVersion != "2.0" or description.coSimulation is None:
        raise BuildError(f"{fmu} has no Co-Simulation of FMI 2.0, which the page needs")
    start, stop, step, tolerance = _experiment(description.defaultExperiment)
    return PageModel(
        name=description.modelName,
        text=description.description or "",
        start_time=start,
        stop_time=stop,
        step=step,
        tolerance=tolerance,
        variables=_variables(description),
        tables=inputs,
    )


def _experiment(given: Any) -> tuple[float, float, float, float]:
    """Start, stop, step and tolerance."""
    start = _number(getattr(given, "startTime", None)) or 0.0
    stop = _number(getattr(given, "stopTime", None))
    stop = start + 1.0 if stop is None or not stop > start else stop
    step = _number(getattr(given, "stepSize", None)) or 0.0
    return (
        start,
        stop,
        step if 0.0 < step <= stop - start else (stop - start) / 500.0,
        _number(getattr(given, "tolerance", None)) or 0.0,
    )


def run_length(start: float, stop: float, step: float) -> tuple[float, float]:
    """Return stop and step (s); a step that would give too many rows is increased.

    Raises `BuildError` if stop is not after start, or if the step is longer than the run.
    """
    if not start < stop < math.inf:
        raise BuildError(f"explore.stop_time = {stop!r} must be above the start at {start!r} s")
    if not 0.0 < step <= stop - start:
        raise BuildError(f"explore.step = {step!r} must be above 0 and at most {stop - start!r} s")
    return stop, step * max(1, math.ceil((stop - start) / step / MOST_ROWS - 1e-9))


def _variables(description: Any) -> tuple[PageVariable, ...]:
    units = {
        (unit.name, display.name): (_number(display.factor) or 1.0, _number(display.offset) or 0.0)
        for unit in description.unitDefinitions
        for display in unit.displayUnits
    }
    rates = {
        one.derivative.name: one.name for one in description.modelVariables if one.derivative is not None
    }
    variables, inner = [], 0
    for one in description.modelVariables:
        if one.type not in _KINDS or one.causality == "independent":
            continue
        inner += one.causality == "local"
        if one.causality == "local" and inner > _MOST_LOCALS and one.name not in rates:
            continue
        variables.append(_variable(one, units, rates.get(one.name)))
    return tuple(variables)


def _variable(one: Any, units: dict[tuple[str, str], tuple[float, float]], rate: str | None) -> PageVariable:
    unit, shown = one.unit or "", one.displayUnit or ""
    factor, offset = units.get((unit, shown), (1.0, 0.0))
    start = _start(one)
    can_be_set = one.causality in ("parameter", "input") or one.initial in ("exact", "approx")
    settable = can_be_set and one.variability != "constant" and start is not None
    minimum, maximum = _number(one.min), _number(one.max)
    literals = getattr(one.declaredType, "items", None) or ()
    return PageVariable(
        name=one.name,
        reference=one.valueReference,
        kind=_KINDS[one.type],
        causality=one.causality or "local",
        text=one.description or "",
        unit=unit,
        display_unit=shown if (unit, shown) in units else unit,
        factor=factor,
        offset=offset,
        derivative=rate,
        settable=settable,
        start=start if settable else None,
        minimum=minimum,
        maximum=maximum,
        range=_range(one, start, minimum, maximum) if settable and one.type in ("Real", "Integer") else None,
        literals=tuple((int(item.value), item.name) for item in literals),
    )


def _range(one: Any, start: float | None, minimum: float | None, maximum: float | None) -> Range:
    found = range_of(start or 0.0, minimum, maximum, _number(one.nominal))
    if one.type == "Real":
        return found
    low, high = math.floor(found.minimum), math.ceil(found.maximum)
    return Range(low, max(high, low + 10 if maximum is None else high), "linear")


def _start(one: Any) -> float | None:
    if one.type == "Boolean":
        return float(str(one.start).lower() in ("true", "1")) if one.start is not None else None
    value = _number(one.start)
    return 0.0 if value is None and one.causality == "input" else value


def _number(text: Any) -> float | None:
    """Return the finite number that a text represents, or None."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return value if math.isfinite(value) else None


def _input_rows(fmu: Path, identifier: str) -> dict[str, tuple[tuple[float, float], ...]]:
    """Return the inputs that vary in the default run, by name, without rows inside constant stretches."""
    with zipfile.ZipFile(fmu) as archive:
        name = f"{FOLDER}/{identifier}_in.csv"
        if name not in archive.namelist():
            return {}
        header, *rows = csv.reader(archive.read(name).decode().splitlines())
    numbers = [[float(cell) for cell in row] for row in rows]
    columns = {name: [(row[0], row[i]) for row in numbers] for i, name in enumerate(header) if i > 0}
    return {name: _corners(points) for name, points in columns.items() if len({v for _, v in points}) > 1}


def _corners(points: Sequence[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    kept = [
        point
        for i, point in enumerate(points)
        if i == 0 or any(point[1] != other[1] for other in points[max(0, i - 1) : i + 2])
    ]
    return tuple(dict.fromkeys(kept))
