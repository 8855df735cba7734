"""Mass, center of mass and moment of inertia of a body from its parts, by the parallel-axis theorem."""

from __future__ import annotations

import dataclasses
import itertools
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np

from pyjoystick.laboratory.inertia.budget import Estimate, Measured, combined
from pyjoystick.motion import UNITS, Column, Heading, RecordError, TableFile, read_table_file
from pyjoystick.support import ParameterError, finite, is_number_text, not_negative, positive

_KINDS: Final = {
    "mass": UNITS["mass"],
    "height": UNITS["length"],
    "inertia": UNITS["moment of inertia"],
    "offset": UNITS["length"],
}
#: Names of rows that add up the others or describe them, and words that may go with these.
_TOTALS: Final = frozenset(
    (
        *("total", "totals", "totale", "sum", "sums", "\u03c3", "gesamt", "summe", "somme", "suma", "soma"),
        *("mean", "average", "mittelwert", "min", "max", "std", "median"),
    )
)
_WITH_TOTALS: Final = frozenset(
    (
        *("all", "alle", "assembly", "complete", "gewicht", "mass", "masse", "of"),
        *("parts", "teile", "the", "weight", "whole"),
    )
)
_COUNTS: Final = frozenset(
    (
        *("amount", "anzahl", "cantidad", "count", "menge", "nb", "pcs", "pieces", "pi\u00e8ces"),
        *("qt\u00e9", "qty", "quantit\u00e9", "quantity", "st\u00fcck"),
        *("aantal", "anz", "number", "quantidade", "quantit\u00e0", "stkzahl", "st\u00fcckzahl"),
    )
)
_IN_NAME: Final = re.compile(
    r"\d+ ?[x\u00d7] .*|.*[ (,][x\u00d7] ?\d+\)?|.*\(\d+ ?[x\u00d7]\)|.*\d+ ?(pcs|stk)\.?", re.IGNORECASE
)
_PIECES: Final = re.compile(
    r"[x\u00d7*]? ?\d+ ?([x\u00d7*]|pcs?\.?|stk\.?|st\u00fcck|pieces?|off)?", re.IGNORECASE
)
_PART: Final = Column("part", {"": 1.0})
_COLUMNS: Final = tuple(
    Column(
        prefix + name, units, required=not prefix and name != "offset", advice="write 0 where there is none"
    )
    for prefix in ("", "u_")
    for name, units in _KINDS.items()
)
#: A center of mass farther off the axis than this part of h is noted.
_OFF_AXIS: Final = 0.02
#: Relative difference of rounded masses that may be equal.
_SAME_MASS: Final = 1e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """A rigid part.

    Attributes:
        name: name in the budget
        mass: (kg), above 0
        height: height of its center above the pivot, along the axis of the joystick (m)
        inertia: about the axis through its own center, parallel to the pivot's (kg m2), 0 or more
        offset: distance of its center from the axis of the joystick, in the plane of motion (m)
    """

    name: str
    mass: Measured
    height: Measured
    inertia: Measured
    offset: Measured = dataclasses.field(default_factory=lambda: Measured(0.0))

    def __post_init__(self) -> None:
        positive(f"{self.name}: mass", self.mass.value, "kg")
        not_negative(f"{self.name}: inertia", self.inertia.value, "kg.m2")
        for what in ("height", "offset"):
            finite(f"{self.name}: {what}", getattr(self, what).value, "m")
        for what in _KINDS:
            not_negative(f"{self.name}: u_{what}", getattr(self, what).uncertainty)


@dataclass(frozen=True, slots=True)
class PartsResult:
    """The body made of the parts.

    Attributes:
        m: mass (kg)
        h: pivot to center of mass, along the axis (m)
        J: moment of inertia about the pivot (kg m2)
        notes: doubts, one sentence each
    """

    m: Estimate
    h: Estimate
    J: Estimate
    notes: tuple[str, ...]

    def estimates(self) -> dict[str, Estimate]:
        """The three estimates by name and unit, for a report."""
        return {"m (kg)": self.m, "h (m)": self.h, "J (kg m2)": self.J}


def from_parts(parts: Sequence[Part]) -> PartsResult:
    """Compute m = sum m_i, h = sum m_i z_i / m, J = sum J_i + m_i (z_i^2 + y_i^2).

    Raises:
        ParameterError: no parts, two with the same name, or a center of mass below the pivot
    """
    names = [part.name for part in parts]
    if not parts or len(set(names)) < len(names):
        raise ParameterError("parts", names, "one part or more, each with its own name")
    quantities = {f"{part.name}: {what}": getattr(part, what) for part in parts for what in _KINDS}

    def of(by_name: Mapping[str, float], name: str) -> tuple[float, float, float, float]:
        mass, height, inertia, offset = (by_name[f"{name}: {what}"] for what in _KINDS)
        return mass, height, inertia, offset

    def total(**by_name: float) -> float:
        return sum(of(by_name, name)[0] for name in names)

    def center(**by_name: float) -> float:
        return sum(of(by_name, name)[0] * of(by_name, name)[1] for name in names) / total(**by_name)

    def inertia(**by_name: float) -> float:
        each = (of(by_name, name) for name in names)
        return sum(own + mass * (height**2 + offset**2) for mass, height, own, offset in each)

    mass, height, about_pivot = (combined(function, quantities) for function in (total, center, inertia))
    if height.value < 0.0:
        raise ParameterError("h", height.value, "0 or more: heights count upward from the pivot (m)")
    off_axis = sum(part.mass.value * part.offset.value for part in parts) / mass.value
    notes = []
    if abs(off_axis) > _OFF_AXIS * height.value:
        notes.append(
            f"the center of mass lies {1e3 * off_axis:.3g} mm off the axis; the model assumes it on the "
            "axis and neglects the moment of the weight at rest"
        )
    notes += (
        f"{name} counts once: give each piece its own row" for name in names if _IN_NAME.fullmatch(name)
    )
    notes += _totals(names, [part.mass.value for part in parts])
    return PartsResult(mass, height, about_pivot, tuple(notes))


def _totals(names: Sequence[str], masses: Sequence[float]) -> Iterator[str]:
    """Yield a note for each part with the mass of two or more that follow one another before or behind it."""
    for i, mass in enumerate(masses):
        for others in (masses[:i][::-1], masses[i + 1 :]):
            sums = itertools.accumulate(others)
            if any(k and math.isclose(one, mass, rel_tol=_SAME_MASS) for k, one in enumerate(sums)):
                yield f"{names[i]} has the mass of the parts beside it: a total would count them twice"
                break


def _is_total(name: str) -> bool:
    words = set(re.findall(r"[^\W\d_]+", name.casefold()))
    return not _TOTALS.isdisjoint(words) and words <= _TOTALS | _WITH_TOTALS


def _require_known(file: TableFile) -> None:
    """Reject columns of numbers that would be ignored, such as a number of pieces."""
    known = {one.heading for one in file.head.match([_PART, *_COLUMNS]).values()}
    for heading in file.head.headings:
        cells = file.texts(heading)
        if heading not in known and (_has_numbers(file, heading) or _counts_pieces(heading, cells)):
            names = ", ".join(column.name for column in (_PART, *_COLUMNS))
            advice = f"known are {names}; a part that is there twice needs two rows"
            raise RecordError(str(file.head.path), "is not known", advice, column=heading.text)


def _counts_pieces(heading: Heading, cells: Sequence[str]) -> bool:
    """Whether the cells are numbers of pieces, by their heading or as ``x4``."""
    words = re.findall(r"[^\W\d_]+", heading.text.casefold())
    return any(cells) and (
        not _COUNTS.isdisjoint(words) or all(_PIECES.fullmatch(cell) for cell in cells if cell)
    )


def _has_numbers(file: TableFile, heading: Heading) -> bool:
    """Whether all cells are numbers, or some under a heading with a unit; a material has neither."""
    try:
        return bool(np.isfinite(file.numbers(heading)).any())
    except RecordError:
        return bool(heading.unit) and any(map(is_number_text, file.texts(heading)))


def read_parts(path: str | PathLike[str]) -> tuple[Part, ...]:
    """Read parts from a CSV file.

    The headings are ``part``, ``mass (g)``, ``height (mm)``, ``inertia (g.cm2)`` and, optionally,
    ``offset (mm)`` and standard uncertainties ``u_mass (g)``, ``u_height (mm)``, ``u_inertia (g.cm2)``,
    ``u_offset (mm)``, in any of `UNITS`.

    Raises:
        RecordError: the file cannot be read; a column is missing, has no unit or an unknown one; a cell is
            not a number or not allowed; a name is missing, that of a total, or there twice; the message names
            file, column and row
    """
    file = read_table_file(Path(path))
    names = file.texts(file.head.match([_PART])["part"].heading)
    series = file.read(_COLUMNS)
    _require_known(file)
    parts = []
    for i, name in enumerate(names):
        if not name or _is_total(name):
            advice = "remove the row if it would count the other parts twice, or give it another name"
            reason = "is no part" if name else "has no name"
            raise RecordError(str(path), reason, advice, rows=[file.rows[i]], value=name)
        numbers = {quantity: float(values[i]) for quantity, values in series.items()}
        if name.casefold() in map(str.casefold, names[:i]):
            raise RecordError(
                str(path), "a part occurs twice", "give each its own name", rows=[file.rows[i]], value=name
            )
        measured = {what: Measured(numbers.get(what, 0.0), numbers.get(f"u_{what}", 0.0)) for what in _KINDS}
        try:
            parts.append(Part(name=name, **measured))
        except ParameterError as error:
            quantity = error.field.split(": ")[-1]
            heading = file.head.match(_COLUMNS)[quantity].heading
            raise RecordError(
                str(path),
                "is not allowed",
                f"must be {'above 0' if quantity == 'mass' else '0 or more'}",
                column=heading.text,
                rows=[file.rows[i]],
                value=f"{file.numbers(heading)[i]:g}",
            ) from None
    return tuple(parts)
