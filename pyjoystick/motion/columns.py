"""Columns that a reader needs, and their matching with the headings of a table."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from pyjoystick.motion.records.errors import RecordError
from pyjoystick.motion.units import UNITS, plain_unit

_HEADING: Final = re.compile(r"(?P<name>.*?)\s*[(\[](?P<unit>[^()\[\]]*)[)\]]\s*")


@dataclass(frozen=True, slots=True)
class Heading:
    """The heading of a column: ``theta (deg)`` has the name theta and the unit deg, which may be empty."""

    text: str
    name: str
    unit: str

    @classmethod
    def of(cls, text: str) -> Heading:
        """Name and unit of a heading such as ``theta (deg)`` or ``theta [deg]``."""
        match = _HEADING.fullmatch(text)
        return cls(text, match["name"].strip(), match["unit"].strip()) if match else cls(text, text, "")


@dataclass(frozen=True, slots=True)
class Column:
    """A column that a reader needs.

    Attributes:
        name: name of the quantity and of its default heading; case is ignored
        units: factors to SI units by unit, as in `UNITS`; only the empty unit for a column whose unit is not
            known or that contains text
        required: whether a file without it is rejected
        aliases: alternative headings; case matters
        default_unit: unit of a column whose heading has none; if empty, `units` must contain the empty unit
        advice: what to do about cells without a number
    """

    name: str
    units: Mapping[str, float]
    required: bool = True
    aliases: tuple[str, ...] = ()
    default_unit: str = ""
    advice: str = "delete the rows without a number"


#: Time of a sample, in every table of samples.
TIME: Final = Column("time", UNITS["time"], aliases=("t",))


@dataclass(frozen=True, slots=True)
class Match:
    """A matched column: the requested column, its heading, its index from 0, its unit in the file."""

    column: Column
    heading: Heading
    index: int
    unit: str

    @property
    def factor(self) -> float:
        """Factor to SI units."""
        return self.column.units[self.unit]


@dataclass(frozen=True, slots=True)
class TableHead:
    """The headings of a table.

    Attributes:
        path: the file
        headings: one per column
        delimiter: separator of the columns
        line: line number of the headings, from 1; 0 if the file has no such line
    """

    path: Path
    headings: tuple[Heading, ...]
    delimiter: str
    line: int

    @property
    def _rows(self) -> list[int]:
        return [self.line] if self.line else []

    def match(
        self,
        columns: Iterable[Column],
        *,
        headings: Mapping[str, str] | None = None,
        units: Mapping[str, str] | None = None,
    ) -> dict[str, Match]:
        """Find columns and their units, by name; missing optional ones are omitted.

        Args:
            columns: the requested columns
            headings: headings by name of the column, with or without units, if they differ
            units: units by name of the column, if the headings have none or unknown ones

        Raises:
            RecordError: a column is missing or appears twice; it has no unit, an unknown one, or not the
                one given; or a name in `headings` or `units` is not that of a column
        """
        wanted = {column.name: column for column in columns}
        for name in {**(headings or {}), **(units or {})}:
            if name not in wanted:
                raise RecordError(
                    "columns", f"{name!r} is not a known quantity", f"known are {', '.join(wanted)}"
                )
        found = {}
        for name, column in wanted.items():
            heading = self._find(column, (headings or {}).get(name, ""))
            if heading is not None:
                unit = self._unit(column, heading, (units or {}).get(name, ""))
                found[name] = Match(column, heading, self.headings.index(heading), unit)
        return found

    def _find(self, column: Column, wanted: str) -> Heading | None:
        """Heading of a column; None for a missing optional one if no heading is `wanted`."""
        name = wanted or column.name
        # A column without a heading is none of them.
        found = [one for one in self.headings if one.text == wanted != ""] or self.named(name)
        if not (found or wanted):
            found = [heading for heading in self.headings if heading.name in column.aliases]
        if len(found) == 1:
            return found[0]
        if not (found or column.required or wanted):
            return None
        texts = ", ".join(repr(heading.text) for heading in self.headings)
        reason = f"has {len(found) or 'no'} column{'s' * bool(found)} {name!r}"
        advice = f"which column holds {column.name}? There are {texts}: --column {column.name}=HEADING"
        if found:
            advice = f"choose one by its whole heading; there are {texts}"
        elif len(self.headings) == 1:
            advice = f"separate the columns by commas, semicolons or tabs; the heading is {texts}"
        raise RecordError(str(self.path), reason, advice, rows=self._rows)

    def _unit(self, column: Column, heading: Heading, given: str) -> str:
        """The unit of a column as `Column.units` spells it."""
        # The brackets of a variable such as x[1] belong to its name; those of a unit of time do not.
        written = "" if heading.text == column.name != heading.name else heading.unit
        unit, known = written or given or column.default_unit, ", ".join(column.units)
        value = None
        fits = not any(column.units) or plain_unit(written) in map(plain_unit, column.units)
        is_known = fits or any(plain_unit(written) in units for units in UNITS.values())
        if written and given and not is_known:
            unit = given
        if written and given and is_known and plain_unit(written) != plain_unit(given):
            reason = f"has the unit {written} in its heading, but {given} is given"
            advice = "leave one of the two out" if fits else "correct the heading"
        elif not unit and "" not in column.units:
            reason = "has no unit"
            example = f"{heading.text} ({next(iter(column.units))})"
            option = f"--unit {column.name}=UNIT"
            advice = f"write it in the heading, as in {example!r}, or as an option, {option}: {known}"
        else:
            for one in column.units:
                if plain_unit(unit) == plain_unit(one) or not any(column.units):
                    return one
            advice = (
                f"known are {known}: if it is one of them under another name, --unit {column.name}=UNIT; "
                "else convert the column"
            )
            reason, value = "has an unknown unit", unit
        raise RecordError(str(self.path), reason, advice, column=heading.text, rows=self._rows, value=value)

    def named(self, name: str) -> list[Heading]:
        """Headings with this name or text, matching case if possible."""
        exact = [heading for heading in self.headings if name in (heading.text, heading.name)]
        folded = name.casefold()
        return exact or [h for h in self.headings if folded in (h.text.casefold(), h.name.casefold())]
