"""What the loop over the steps must know of a version of FMI: its functions and how it stores values."""

from __future__ import annotations

from ctypes import c_void_p, cast
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from pyjoystick.fmu.stepping import program


@dataclass(frozen=True, slots=True)
class StoredType:
    """How values of a type are stored and passed.

    Attributes:
        name: of the type in the names of the setter and the getter
        kind: for `stepping.decoding`
        dtype: of one value
    """

    name: str
    kind: int
    dtype: np.dtype[Any]


@dataclass(frozen=True, slots=True)
class CInterface:
    """The Co-Simulation functions of a version of FMI.

    Attributes:
        version: 2 or 3
        fixed: names of the functions in the order of `stepping.program`; empty where there is none
        types: by the type of a variable in the model description
    """

    version: int
    fixed: tuple[str, ...]
    types: MappingProxyType[str, StoredType]

    @property
    def functions(self) -> tuple[str, ...]:
        """Names of all functions, in the order of `stepping.program.Program.functions`."""
        names = dict.fromkeys(stored.name for stored in self.types.values())
        prefix = f"fmi{self.version}"
        return (*self.fixed, *(f"{prefix}{verb}{name}" for verb in ("Set", "Get") for name in names))

    def place(self, verb: str, stored: StoredType) -> int:
        """Place in `functions` of the setter (``Set``) or getter (``Get``)."""
        return self.functions.index(f"fmi{self.version}{verb}{stored.name}")

    def addresses(self, fmi: Any) -> list[int]:
        """Addresses of `functions` in a library that FMPy has loaded."""
        return [cast(fmi._functions[name], c_void_p).value or 0 if name else 0 for name in self.functions]


def _types(table: dict[str, tuple[str, type[Any], int | None]]) -> MappingProxyType[str, StoredType]:
    """The stored types from names, dtypes and, where the dtype does not say it, kinds."""
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
    """The functions of ``2.0``, ``3.0`` and what comes after it."""
    return _FMI2 if fmi_version.startswith("2.") else _FMI3
