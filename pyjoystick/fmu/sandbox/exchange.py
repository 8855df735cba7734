"""Data exchange with a module: conversion between the rows of a plan and bytes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from ctypes import string_at
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.preparation import Preparation
from pyjoystick.fmu.stepping.program import Group
from pyjoystick.support import FloatArray

#: FMI's getters, and kinds of columns in the module; see fmu_build/runtime/wasm/explore.h.
_KINDS: Final = {"fmi2GetReal": b"r", "fmi2GetInteger": b"i", "fmi2GetBoolean": b"b"}
_SETTERS: Final = {
    "fmi2SetReal": "explore_set_real",
    "fmi2SetInteger": "explore_set_integer",
    "fmi2SetBoolean": "explore_set_boolean",
}
#: Alignment for 64-bit numbers that the module reads.
_ALIGNMENT: Final = 8


def packed(parts: Iterable[bytes]) -> tuple[bytes, list[int]]:
    """Concatenate parts, each aligned; also returns the offset of each."""
    content, begins = bytearray(), []
    for part in parts:
        begins.append(len(content))
        content += part + bytes(-len(part) % _ALIGNMENT)
    return bytes(content), begins


@dataclass(frozen=True, slots=True)
class Setting:
    """Variables of one type to set: the function, value references and values."""

    function: str
    references: bytes
    values: bytes

    @property
    def n(self) -> int:
        """Number of variables."""
        return len(self.references) // 4


def settings_of(preparation: Preparation, groups: Sequence[Group], row: int) -> list[Setting]:
    """Settings for the row of values at this address."""
    functions = preparation.interface.functions
    return [
        Setting(
            _SETTERS[functions[group.function]],
            _references(group),
            string_at(row + group.offset, group.size * _width(functions[group.function])),
        )
        for group in groups
        if group.size
    ]


def _references(group: Group) -> bytes:
    return string_at(group.references, 4 * group.size)


def _width(function: str) -> int:
    return 8 if function.endswith("Real") else 4


class InputTables:
    """Inputs of a run.

    Attributes:
        n: number of real inputs, or 0 if none changes; they have a table of values and slopes, and other
            inputs are set when they change
        references: value references of the table
    """

    def __init__(self, preparation: Preparation) -> None:
        self._preparation = preparation
        program = preparation.program
        points = len(program.times)
        changed = program.changed
        self._tabled = [
            i
            for i, group in enumerate(program.inputs)
            if changed[:, i].any() and preparation.interface.functions[group.function] == "fmi2SetReal"
        ]
        others = [i for i in range(len(program.inputs)) if i not in self._tabled]
        self._others = [program.inputs[i] for i in others]
        self._changes = np.flatnonzero(changed[:, others].any(axis=1))
        self.n = sum(program.inputs[i].size for i in self._tabled)  # at most one group has real inputs
        self.references = b"".join(_references(program.inputs[i]) for i in self._tabled)
        self._values = np.zeros((points, self.n))
        self._slopes = np.zeros((points, self.n))
        if self.n:
            self._fill_table(points)

    def _fill_table(self, points: int) -> None:
        program = self._preparation.program
        (group,) = (program.inputs[i] for i in self._tabled)
        rows = np.frombuffer(string_at(program.inputs_rows, points * program.inputs_stride), np.uint8)
        columns = rows.reshape(points, -1)[:, group.offset : group.offset + 8 * group.size]
        self._values = np.ascontiguousarray(columns).view(np.float64)
        if program.moving:
            place = {one: i for i, one in enumerate(np.frombuffer(self.references, np.uint32).tolist())}
            moving = np.frombuffer(string_at(program.moving_references, 4 * program.moving), np.uint32)
            size = 8 * program.moving * (points - 1)
            slopes = np.frombuffer(string_at(program.slopes, size), np.float64)
            at = [place[one] for one in moving.tolist()]
            self._slopes[:-1, at] = slopes.reshape(points - 1, -1)

    def at_start(self) -> list[Setting]:
        """All inputs at the first point."""
        program = self._preparation.program
        return settings_of(self._preparation, program.inputs, program.inputs_rows)

    def at(self, point: int) -> list[Setting]:
        """Inputs without a table at a communication point."""
        program = self._preparation.program
        row = program.inputs_rows + point * program.inputs_stride
        return settings_of(self._preparation, self._others, row)

    def next_change(self, point: int, last: int) -> int:
        """The next communication point at which an input without a table changes, or the last."""
        later = self._changes[self._changes > point]
        return int(later[0]) if len(later) else last

    def table(self, first: int, until: int) -> tuple[bytes, bytes]:
        """Values and slopes from one communication point to another, inclusive."""
        rows = slice(first, until + 1)
        return self._values[rows].tobytes(), self._slopes[rows].tobytes()


class Layout:
    """Columns of a module's table, grouped by type.

    Attributes:
        references, kinds: value reference and kind of each column, as the module expects them
        columns: index of each column in the table of samples
    """

    def __init__(self, preparation: Preparation) -> None:
        program, functions = preparation.program, preparation.interface.functions
        self._form = preparation.outputs
        self.references = b"".join(_references(group) for group in program.outputs)
        self.kinds = b"".join(_KINDS[functions[group.function]] * group.size for group in program.outputs)
        self.columns = np.array(program.columns, dtype=np.intp)

    @property
    def n(self) -> int:
        """Number of columns."""
        return len(self.kinds)

    def wrong_column(self, table: FloatArray) -> str | None:
        """Name of a variable with a value outside its type, which a sound module does not return."""
        for column, kind in enumerate(self.kinds):
            if kind == ord("r"):
                continue
            numbers = table[:, column]
            low, high = (-(2**31), 2**31 - 1) if kind == ord("i") else (0, 1)
            with np.errstate(invalid="ignore"):
                is_sound = (numbers == np.floor(numbers)) & (numbers >= low) & (numbers <= high)
            if not is_sound.all():
                return self._name(column)
        return None

    def rows(self, table: FloatArray) -> NDArray[np.void]:
        """The table in the types of the FMU, by variable, shape (samples,)."""
        rows: NDArray[Any] = self._form.rows(len(table))
        for column in range(self.n):
            rows[self._name(column)] = table[:, column]
        return rows

    def _name(self, column: int) -> str:
        names = self._form.dtype.names or ()
        return str(names[self.columns[column]])
