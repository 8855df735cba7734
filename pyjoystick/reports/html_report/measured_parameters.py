"""Parameters of a measured joystick, to their significant digits and with their sources."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

import numpy as np

from pyjoystick.laboratory import Estimate
from pyjoystick.model import SIDES, FmuValue, Side, fmu_values
from pyjoystick.reports.html_report.known_digits import with_uncertainty
from pyjoystick.reports.html_report.measurements import Measurements
from pyjoystick.reports.html_report.page import Section, paragraph
from pyjoystick.support import TextTable

#: Factors and names of units displayed instead of those of the FMU.
_SHOWN: Final = {"m": (1e3, "mm"), "rad": (math.degrees(1.0), "deg")}
_NAMES: Final = {
    "J": "moment of inertia about the pivot, J",
    "m": "mass, m",
    "h": "pivot to center of mass, h",
    "g": "acceleration of gravity, g",
    "a": "pivot to plunger axis, a",
    "b": "pivot to cam surface, b",
    "damping.C": "damping coefficient, C",
}
_HEADER: Final = ("", "value", "standard uncertainty", "unit", "from")


def parameter_section(found: Measurements) -> Section:
    """All parameters of the joystick, to their significant digits and with their sources."""
    values = [_row(found, one) for one in fmu_values(found.file) if one.table not in SIDES]
    rows = [*values, *_handle_rows(found)]
    parts = [TextTable(_HEADER, rows).html("Body, geometry and damping.", texts=2)]
    for side in SIDES:
        rows = [*_segment_rows(found, side), *_spring_rows(found, side)]
        caption = f"Springs, {side}: the curve of Table 1 and the two springs that it stands for. From: "
        caption += f"{_curve_source(found, side)}."
        springs = (one for one in fmu_values(found.file) if one.table == side)
        if side not in found.curves and any(uncertainty_of(found, one) is not None for one in springs):
            caption += (
                " The uncertainties of the two springs are upper bounds: the file does not contain the "
                "correlations of x and k, with which they may be much smaller. Name the curve: --curve."
            )
        parts.append(TextTable(_HEADER[:-1], rows).html(caption, texts=1))
    words = (
        "A value ends with the last digit of its standard uncertainty. Where none is stated, the value is "
        "taken as it stands in the file, and nothing is known of its error."
    )
    return Section("Parameters, and where they are from", [paragraph(words), *parts])


def _row(found: Measurements, one: FmuValue) -> list[str]:
    factor, unit = _SHOWN.get(one.unit, (1.0, one.unit.replace(".", " ")))
    value, error = with_uncertainty(one.value, uncertainty_of(found, one), factor)
    return [_NAMES.get(one.name, one.name), value, error, unit, _source(found, one)]


def _handle_rows(found: Measurements) -> Iterator[list[str]]:
    """Length of the handle, which affects forces at its top but not the motion."""
    top = found.file.pivot_to_top
    if top is not None:
        value = with_uncertainty(top, found.file.uncertainties.get("geometry.pivot_to_top"), 1e3)
        source = found.file.sources.get("geometry", "") or "the file names no source"
        yield ["pivot to the top of the handle", *value, "mm", source]


def _source(found: Measurements, one: FmuValue) -> str:
    """Source of a number of the body, the geometry or the damping."""
    fitted = found.fit.shared() if found.fit is not None else {}
    if found.fit is not None and (one.name in fitted or one.name in found.fit.tied):
        records = ", ".join(found.fit.records)
        error = " and error budget" if found.budget is not None and one.name in found.budget.fitted else ""
        return f"fit to {records}{error}" if records else f"fit{error}"
    is_of_parts = found.parts is not None and one.name in ("m", "h", "J")
    if is_of_parts and is_rounded(one.value, getattr(found.parts, one.name)):
        return f"parts, {found.parts_source}"
    if found.swing is not None and one.name == "J" and is_rounded(one.value, found.swing.inertia):
        return f"swing test, {found.swing.source}"
    if found.fit is not None and one.source.startswith("fit to"):
        return "not from the fit; the file names no other source"
    return one.source or "the file names no source"


def is_rounded(value: float, estimate: Estimate) -> bool:
    """Whether a value of the file is this estimate, rounded to a hundredth of its uncertainty."""
    return abs(estimate.value - value) <= 0.02 * estimate.uncertainty


def _curve_source(found: Measurements, side: Side) -> str:
    if side in found.curve_sources:
        return f"load-deflection curve, {found.curve_sources[side]}"
    return found.file.sources.get(side, "") or "the file names no source"


def uncertainty_of(found: Measurements, one: FmuValue) -> float | None:
    """Standard uncertainty of a value; None if not stated."""
    side = next((side for side in SIDES if side == one.table), None)
    if side is None:
        return one.uncertainty
    if side in found.curves:
        return found.curves[side].springs()[one.name.partition(".")[2]][1]
    return _largest(found, side, one.place)


def _segment_rows(found: Measurements, side: Side) -> Iterator[list[str]]:
    curve = found.file.curves[side]
    for key, values, factor, unit in (("x", curve.x, 1e3, "mm"), ("k", curve.k, 1.0, "N/m")):
        for i, value in enumerate(values):
            stated = found.file.uncertainties.get(f"{side}.{key}[{i}]")
            yield [f"{key}_{i}", *with_uncertainty(value, stated, factor), unit]


def _spring_rows(found: Measurements, side: Side) -> Iterator[list[str]]:
    for one in fmu_values(found.file):
        if one.table == side:
            factor, unit = _SHOWN.get(one.unit, (1.0, one.unit))
            name = one.name.partition(".")[2].replace("Spring.", " spring, ")
            yield [name, *with_uncertainty(one.value, uncertainty_of(found, one), factor), unit]


def _largest(found: Measurements, side: Side, place: str) -> float | None:
    """Upper bound for the uncertainty of a spring from those of the curve, whose correlations are unknown."""
    stated = {
        f"{key}[{i}]": found.file.uncertainties.get(f"{side}.{key}[{i}]") for key in "xk" for i in range(4)
    }
    used = {name: error for name, error in stated.items() if name in place}
    if any(error is None for error in used.values()):
        return None
    curve = found.file.curves[side]
    values = {"x": np.array(curve.x), "k": np.array(curve.k)}
    total = 0.0
    for name, error in used.items():
        ends = []
        for sign in (1.0, -1.0):
            moved = {key: column.copy() for key, column in values.items()}
            moved[name[0]][int(name[2])] += sign * (error or 0.0)
            ends.append(_place_value(place, moved["x"], moved["k"]))
        total += abs(ends[0] - ends[1]) / 2.0
    return total


def _place_value(place: str, x: np.ndarray, k: np.ndarray) -> float:
    """Value at the place given by `FmuValue.place`."""
    stiffness, _, gap = place.partition("*")
    first, _, second = stiffness.strip("()").partition(" - ")
    columns = {"x": x, "k": k}

    def entry(name: str) -> float:
        return float(columns[name[0]][int(name[2])])

    value = entry(first) - (entry(second) if second else 0.0)
    if gap:
        later, _, earlier = gap.strip("()").partition(" - ")
        value *= entry(later) - entry(earlier)
    return value
