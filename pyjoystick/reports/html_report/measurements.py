"""Measurements behind a report's joystick, read from files and checked against its parameters."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from pyjoystick.identification import (
    BudgetDocument,
    Contradiction,
    FitDocument,
    contradictions,
    curve_axes,
    read_budget,
    read_fit,
)
from pyjoystick.laboratory import (
    Estimate,
    LoadCurveFit,
    Measured,
    PartsResult,
    SwingPeriod,
    fit_load_curve,
    from_parts,
    inertia_of_swing,
    period_of_record,
    read_load_curve,
    read_parts,
)
from pyjoystick.model import SIDES, ActuatorAssembly, JoystickParameters, ParameterFile, Side, fmu_values
from pyjoystick.motion import Record, read_record
from pyjoystick.support import InputFileError, ParameterError

#: Numbers with a smaller relative difference are the same, because files are rounded.
_ROUNDING = 1e-5
#: Uncertainties are rounded to two digits.
_ROUNDED = 0.06


@dataclass(frozen=True, slots=True, kw_only=True)
class SwingTest:
    """The joystick as a pendulum.

    Attributes:
        source: the file
        record: angle over time
        period: period of small undamped swings
        inertia: resulting moment of inertia, with m, h and g of the joystick (kg m2)
    """

    source: str
    record: Record
    period: SwingPeriod
    inertia: Estimate


@dataclass(frozen=True, slots=True, kw_only=True)
class Measurements:
    """Measurements of a joystick; None or empty if not given.

    Attributes:
        file: its parameter file
        fit: the fit to records of its motion, with the records
        curves: load-deflection curves by side
        curve_sources: their files
        swing: the swing test
        parts: mass, center of mass and moment of inertia from the parts
        parts_source: their file
        budget: contribution of each quantity to the errors
    """

    file: ParameterFile
    fit: FitDocument | None = None
    curves: Mapping[Side, LoadCurveFit] = field(default_factory=dict)
    curve_sources: Mapping[Side, str] = field(default_factory=dict)
    swing: SwingTest | None = None
    parts: PartsResult | None = None
    parts_source: str = ""
    budget: BudgetDocument | None = None

    @property
    def is_empty(self) -> bool:
        """Whether nothing was given."""
        return not (self.fit or self.curves or self.swing or self.parts or self.budget)


def read_measurements(
    file: ParameterFile,
    *,
    fit: Path | None = None,
    curves: Mapping[Side, Path] | None = None,
    swing: Path | None = None,
    parts: Path | None = None,
    budget: Path | None = None,
    curve_fits: Mapping[Side, LoadCurveFit] | None = None,
) -> Measurements:
    """Read the files of the measurements from which a parameter file was made.

    Args:
        file: the parameters of the joystick
        fit: the ``fit.json`` of ``pyjoystick fit``, which has the records and the fitted motion
        curves: load-deflection curves by side
        swing: a recorded swing
        parts: the table of parts
        budget: the JSON file of ``pyjoystick budget``
        curve_fits: fits of the curves, if not those of ``pyjoystick import load-curve``

    Raises:
        InputFileError: a file cannot be read, is of another kind, or gives other values than the parameter
            file
        RecordError, ParameterError: as the commands that import these files
    """
    found = Measurements(
        file=file,
        fit=None if fit is None else read_fit(fit),
        curves={
            side: (curve_fits or {}).get(side) or fit_load_curve(read_load_curve(path))
            for side, path in (curves or {}).items()
        },
        curve_sources={side: path.name for side, path in (curves or {}).items()},
        swing=None if swing is None else _swing_test(file, swing),
        parts=None if parts is None else from_parts(read_parts(parts)),
        parts_source="" if parts is None else parts.name,
        budget=None if budget is None else read_budget(budget),
    )
    for side, path in (curves or {}).items():
        _require_same(file, path, _curve_values(file, side, found.curves[side]), "import it first")
    if parts is not None and found.parts is not None:
        _require_same(file, parts, _parts_values(file, found.parts), "`pyjoystick import parts -p` saves it")
    if fit is not None and found.fit is not None:
        _require_same(file, fit, _fit_values(file, found.fit), "`pyjoystick fit --update` saves it")
    if budget is not None and found.budget is not None:
        _require_same(file, budget, _budget_values(file, found.budget), "`pyjoystick budget --update`")
    return found


def found_contradictions(found: Measurements) -> list[Contradiction]:
    """Parameters whose fitted value contradicts their measurement."""
    fitted = found.fit.freely() if found.fit is not None else {}
    values = found.file.joystick.to_names()
    # With a budget, the file has the total uncertainty, which is never less than the noise.
    whole = {
        name: Measured(values.get(name, one.value), max(one.uncertainty, _uncertainty(found.file, name)))
        for name, one in fitted.items()
    }
    return list(contradictions(whole, dict(_measured(found))))


def _measured(found: Measurements) -> Iterator[tuple[str, tuple[Measured, str]]]:
    """Parameters as measured before the fit, by FMU name, with their sources; the last J counts."""
    if found.parts is not None:
        for name in ("m", "h", "J"):
            one = getattr(found.parts, name)
            yield name, (Measured(one.value, one.uncertainty), f"parts {found.parts_source}")
    if found.swing is not None:
        inertia = found.swing.inertia
        yield "J", (Measured(inertia.value, inertia.uncertainty), f"swing test {found.swing.source}")
    for side, curve in found.curves.items():
        for name, spring in curve.springs().items():
            yield f"{side}.{name}", (Measured(*spring), f"load-deflection curve {found.curve_sources[side]}")


def moved_joysticks(found: Measurements, joystick: JoystickParameters) -> Iterator[JoystickParameters]:
    """The joystick with one quantity at a time moved by its standard uncertainty.

    For a measured load-deflection curve, along the axes of its covariance; without the curve, each
    kink and stiffness is moved alone, which overestimates the effect if they are correlated.
    """
    names = set(joystick.to_names())
    for one in fmu_values(found.file):
        if one.table not in SIDES and one.uncertainty and one.name in names:
            yield from _moved(partial(_with_moved, joystick, one.name, one.value), one.uncertainty)
    for side in SIDES:
        if side in found.curves:
            yield from curve_axes(joystick, side, found.curves[side])
            continue
        for key in ("x", "k"):
            for i in range(4):
                uncertainty = found.file.uncertainties.get(f"{side}.{key}[{i}]", 0.0)
                if uncertainty > 0.0:
                    make = partial(_with_moved_curve, found.file, joystick, side, key, i)
                    yield from _moved(make, uncertainty)


def _with_moved(joystick: JoystickParameters, name: str, value: float, move: float) -> JoystickParameters:
    return joystick.replace({name: value + move})


def _moved(make: Callable[[float], JoystickParameters], error: float) -> Iterator[JoystickParameters]:
    """A joystick moved by an error, up or, if impossible, down; none if both are impossible."""
    for by in (error, -error):
        try:
            yield make(by)
        except ParameterError:
            continue
        return


def _with_moved_curve(
    file: ParameterFile, joystick: JoystickParameters, side: Side, key: str, i: int, move: float
) -> JoystickParameters:
    columns = {"x": list(file.curves[side].x), "k": list(file.curves[side].k)}
    columns[key][i] += move
    actuator = ActuatorAssembly.from_table(columns["x"], columns["k"])
    return replace(joystick, forward=actuator) if side == "forward" else replace(joystick, backward=actuator)


#: Name, value in the file, measured value, and allowed difference.
_Pairs = Iterator[tuple[str, float, float, float]]


def _require_same(file: ParameterFile, path: Path, pairs: _Pairs, hint: str) -> None:
    for name, written, measured, allowed in pairs:
        if not abs(written - measured) <= max(allowed, _ROUNDING * abs(written)):
            reason = f"{file.path.name} does not come from it: {name} = {written:.9g}, not {measured:.9g}"
            raise InputFileError(path, f"{reason} ({hint})")


def _curve_values(file: ParameterFile, side: Side, curve: LoadCurveFit) -> _Pairs:
    known = file.curves[side]
    for key, written, measured, errors in (
        ("x", known.x, curve.table.x, curve.x_errors),
        ("k", known.k, curve.table.k, curve.k_errors),
    ):
        for i, (there, here, error) in enumerate(zip(written, measured, errors, strict=True)):
            yield f"{side}.{key}[{i}]", there, here, float(error)


def _parts_values(file: ParameterFile, parts: PartsResult) -> _Pairs:
    """Mass and its height; a swing or a fit may have replaced the moment of inertia."""
    for name, one in (("m", parts.m), ("h", parts.h)):
        yield name, getattr(file.joystick, name), one.value, one.uncertainty


def _fit_values(file: ParameterFile, fit: FitDocument) -> _Pairs:
    """Fitted values, within their uncertainties, and known ones, exactly."""
    written = file.joystick.to_names()
    for name, one in fit.shared().items():
        if name in written and math.isfinite(one.error):
            yield name, written[name], one.value, max(one.error, _uncertainty(file, name))
    for name, value in (*fit.tied.items(), *fit.fixed.items()):
        if name in written:
            yield name, written[name], value, _uncertainty(file, name)


def _budget_values(file: ParameterFile, budget: BudgetDocument) -> _Pairs:
    written = file.joystick.to_names()
    for name, (value, uncertainty) in budget.fitted.items():
        if name in written:
            yield name, written[name], value, uncertainty
            yield f"u_{name}", _uncertainty(file, name), uncertainty, _ROUNDED * uncertainty


def _uncertainty(file: ParameterFile, name: str) -> float:
    places = {"J": "body.J", "m": "body.m", "h": "body.h", "damping.C": "damping.constant.C"}
    return file.uncertainties.get(places.get(name, name.replace("damping.", "damping.power-law.")), 0.0)


def _swing_test(file: ParameterFile, path: Path) -> SwingTest:
    record = read_record(path, free_oscillation=False)
    period = period_of_record(record)
    m, h, g = (
        Measured(getattr(file.joystick, name), file.uncertainties.get(place, 0.0))
        for name, place in (("m", "body.m"), ("h", "body.h"), ("g", "gravity.g"))
    )
    inertia = inertia_of_swing(period.period, m, h, g)
    return SwingTest(source=path.name, record=record, period=period, inertia=inertia)
