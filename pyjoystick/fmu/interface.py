"""What the stepping loop needs to know about an FMI version: functions and storage of values."""

from __future__ import annotations

import math
from collections.abc import Sequence
from ctypes import CFUNCTYPE, POINTER, c_char_p, c_int, c_size_t, c_void_p, cast, string_at
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.description import Variable
from pyjoystick.fmu.stepping import program
from pyjoystick.fmu.stepping.program import Group

_ALIGNMENT = 8


@dataclass(frozen=True, slots=True)
class StoredType:
    """How values of a type are stored and passed.

    Attributes:
        name: name of the type in its setter and getter
        kind: kind for `stepping.decoding`
        dtype: dtype of one value
    """

    name: str
    kind: int
    dtype: np.dtype[Any]


@dataclass(frozen=True, slots=True)
class CInterface:
    """Co-Simulation functions of an FMI version.

    Attributes:
        version: 2 or 3
        fixed: names of the functions in the order of `stepping.program`; empty if there is none
        types: stored types by the type of a variable in the model description
        functions: names of all functions, in the order of `stepping.program.Program.functions`
    """

    version: int
    fixed: tuple[str, ...]
    types: MappingProxyType[str, StoredType]
    functions: tuple[str, ...] = field(init=False)

    def __post_init__(self) -> None:
        names = dict.fromkeys(stored.name for stored in self.types.values())
        accessors = [f"fmi{self.version}{verb}{name}" for verb in ("Set", "Get") for name in names]
        object.__setattr__(self, "functions", (*self.fixed, *accessors))

    def place(self, verb: str, stored: StoredType) -> int:
        """Index in `functions` of the setter (``Set``) or getter (``Get``)."""
        return self.functions.index(f"fmi{self.version}{verb}{stored.name}")

    def addresses(self, fmi: Any) -> list[int]:
        """Addresses of `functions` in a library loaded by FMPy."""
        return [cast(fmi._functions[name], c_void_p).value or 0 if name else 0 for name in self.functions]


def _types(table: dict[str, tuple[str, type[Any], int | None]]) -> MappingProxyType[str, StoredType]:
    """Stored types from names, dtypes and, where the dtype does not determine it, kinds."""
    return MappingProxyType(
        {
            name: StoredType(stored, _kind(np.dtype(dtype)) if kind is None else kind, np.dtype(dtype))
            for name, (stored, dtype, kind) in table.items()
        }
    )


def _kind(dtype: np.dtype[Any]) -> int:
    if dtype.kind == "f":
        return program.FLOAT64 if dtype.itemsize == 8 else program.FLOAT32
    return 4 * dtype.itemsize + (program.SIGNED if dtype.kind == "i" else program.UNSIGNED)


def _boolean(size: int) -> int:
    return 4 * size + program.BOOLEAN


_FMI2: Final = CInterface(
    version=2,
    fixed=(
        "fmi2Reset",
        "fmi2SetupExperiment",
        "fmi2EnterInitializationMode",
        "fmi2ExitInitializationMode",
        "fmi2DoStep",
        "fmi2Terminate",
        "fmi2SetRealInputDerivatives",
    ),
    types=_types(
        {
            "Real": ("Real", np.float64, None),
            "Integer": ("Integer", np.int32, None),
            "Enumeration": ("Integer", np.int32, None),
            "Boolean": ("Boolean", np.int32, _boolean(4)),
            "String": ("String", np.intp, program.TEXT),
        }
    ),
)
_NUMBERS: Final = (
    *("Float64", "Float32", "Int8", "Int16", "Int32", "Int64"),
    *("UInt8", "UInt16", "UInt32", "UInt64"),
)
_FMI3: Final = CInterface(
    version=3,
    fixed=(
        "fmi3Reset",
        "",
        "fmi3EnterInitializationMode",
        "fmi3ExitInitializationMode",
        "fmi3DoStep",
        "fmi3Terminate",
        "",
    ),
    types=_types(
        {
            **{name: (name, np.dtype(name.lower()).type, None) for name in _NUMBERS},
            "Enumeration": ("Int64", np.int64, None),
            "Boolean": ("Boolean", np.uint8, _boolean(1)),
            "String": ("String", np.intp, program.TEXT),
        }
    ),
)


def c_interface(fmi_version: str) -> CInterface:
    """The functions of ``2.0``, ``3.0`` and later versions."""
    return _FMI2 if fmi_version.startswith("2.") else _FMI3


class RowFormat:
    """Layout of values in a row: grouped by type, arrays contiguous.

    Attributes:
        dtype: structured dtype of a row, with the names of the variables in the given order
        groups: what the kernel needs to set or get a row
        columns: index of each value among the given variables, in the order of the groups; -1 for none
    """

    def __init__(self, interface: CInterface, verb: str, variables: Sequence[Variable]) -> None:
        """Lay out the variables for setting or getting.

        Args:
            interface: the FMI version
            verb: ``Set`` or ``Get``
            variables: variables, without repeats
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
            references: list[int] = []
            begins: dict[int, int] = {}  # first index of arrays, by value reference
            count = 0
            for i in members:
                one = variables[i]
                if one.element is None or one.value_reference not in begins:
                    references.append(one.value_reference)
                    begins[one.value_reference] = count
                    count += 1 if one.element is None else math.prod(one.shape)
                    self.columns += [-1] * (count - begins[one.value_reference])
                place = begins[one.value_reference] + (one.element or 0)
                offsets[i] = size + place * stored.dtype.itemsize
                self.columns[place - count] = i
            self._references.append(np.array(references, dtype=np.uint32))  # kept alive for their address
            address = self._references[-1].ctypes.data
            function = interface.place(verb, stored)
            surplus = count - len(references)
            self.groups.append(Group(function, address, count, size, stored.kind, surplus))
            size += count * stored.dtype.itemsize
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
        self._is_text = [stored.kind == program.TEXT for stored in stored_types]
        self._texts: dict[bytes, c_char_p] = {}

    def rows(self, count: int) -> NDArray[Any]:
        """This many rows of zeros, to be filled by name."""
        return np.zeros(count, self.dtype)

    def text(self, value: bytes) -> int:
        """Address of a text, valid for the lifetime of this object."""
        return cast(self._texts.setdefault(value, c_char_p(value)), c_void_p).value or 0

    def readable(self, rows: NDArray[np.void]) -> NDArray[np.void]:
        """Rows with texts in place of their addresses."""
        if not any(self._is_text):
            return rows
        names = self.dtype.names or ()
        kinds = [object if text else self.dtype[i] for i, text in enumerate(self._is_text)]
        readable = np.empty(len(rows), np.dtype(list(zip(names, kinds, strict=True))))
        for name, is_text in zip(names, self._is_text, strict=True):
            column = rows[name]
            readable[name] = [_decoded(address) for address in column.tolist()] if is_text else column
        return readable


def _decoded(address: int) -> str:
    return string_at(address).decode("utf-8", errors="replace")


class TextGetter:
    """An FMU's getter of texts that returns copies; the FMU's own are valid only until its next call.

    Attributes:
        address: address of the C function
    """

    def __init__(self, interface: CInterface, address: int, form: RowFormat) -> None:
        """Wrap the function at `address`, for rows laid out as `form`."""
        self._error: BaseException | None = None
        words: list[Any] = [c_void_p, c_void_p, c_size_t, POINTER(c_void_p)]
        kind = CFUNCTYPE(c_int, *words, *[c_size_t] * (interface.version - 2))
        get = kind(address)

        def copied(instance: int, references: int, count: int, values: Any, *size: int) -> int:
            try:
                status: int = get(instance, references, count, values, *size)
                for i in range(size[0] if size else count) if status in (program.OK, program.WARNING) else ():
                    values[i] = form.text(string_at(values[i]) if values[i] else b"")
            except BaseException as error:  # exceptions cannot leave a callback
                self._error = error
                return program.ERROR
            return status

        self._function = kind(copied)
        self.address = cast(self._function, c_void_p).value or 0

    def check(self) -> None:
        """Raise any Python exception that occurred during the call, which then returned an error."""
        error, self._error = self._error, None
        if error is not None:
            raise error
