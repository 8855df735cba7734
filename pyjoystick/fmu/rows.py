"""Rows of values as the C functions of an FMU take and give them."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import c_char_p, c_void_p, cast
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.description import Variable
from pyjoystick.fmu.interface import CInterface
from pyjoystick.fmu.stepping.program import Group

_ALIGNMENT = 8


class RowFormat:
    """How the values of some variables lie in a row, those of one type side by side.

    Attributes:
        dtype: of a row, a structure with the names of the variables in the order given
        groups: what the kernel needs for setting or getting a row
        columns: place of each variable among those given, in the order of the groups
    """

    def __init__(self, interface: CInterface, verb: str, variables: Sequence[Variable]) -> None:
        """Lay out the variables for being set or got.

        Args:
            interface: the version of FMI
            verb: ``Set`` or ``Get``
            variables: each once
        """
        by_type: dict[str, list[int]] = {}
        for i, variable in enumerate(variables):
            by_type.setdefault(interface.types[variable.type].name, []).append(i)
        self.groups: list[Group] = []
        self.columns: list[int] = []
        self._references: list[NDArray[np.uint32]] = []
        offsets, size = [0] * len(variables), 0
        for members in by_type.values():
            stored = interface.types[variables[members[0]].type]
            references = np.array([variables[i].value_reference for i in members], dtype=np.uint32)
            self._references.append(references)  # the group has but their address
            function = interface.place(verb, stored)
            self.groups.append(Group(function, references.ctypes.data, len(members), size, stored.kind))
            self.columns += members
            for i in members:
                offsets[i] = size
                size += stored.dtype.itemsize
            size += -size % _ALIGNMENT
        stored_types = [interface.types[variable.type] for variable in variables]
        self.dtype = np.dtype(
            {
                "names": [variable.name for variable in variables],
                "formats": [stored.dtype for stored in stored_types],
                "offsets": offsets,
                "itemsize": max(size, _ALIGNMENT),
            }
        )
        self._texts: list[c_char_p] = []

    def rows(self, count: int) -> NDArray[Any]:
        """That many rows of zeros, to be filled by name."""
        return np.zeros(count, self.dtype)

    def text(self, value: str) -> int:
        """Address of a text, which stays where it is as long as this object."""
        self._texts.append(c_char_p(value.encode()))
        return cast(self._texts[-1], c_void_p).value or 0
