"""Calls of an FMU's C functions by address, with one function here for each C signature.

In plain Python they go through ctypes; `compiled` replaces each body with machine code. All return the status
(fmi2Status or fmi3Status). Words are pointers and sizes.
"""

from __future__ import annotations

from collections.abc import Callable
from ctypes import CFUNCTYPE, PYFUNCTYPE, _SimpleCData, c_double, c_int, c_ssize_t
from functools import cache, partial
from types import MappingProxyType
from typing import Any, Final

_C_TYPES: Final[dict[str, Any]] = {"w": c_ssize_t, "i": c_int, "d": c_double}


@cache
def _at(address: int, arguments: str) -> Callable[..., int]:
    return CFUNCTYPE(c_int, *(_C_TYPES[letter] for letter in arguments))(address)


def change_mode(function: int, instance: int) -> int:
    """Reset, Terminate, ExitInitializationMode; in FMI 2 also EnterInitializationMode."""
    return _at(function, "w")(instance)


def begin(
    function: int,
    instance: int,
    tolerance_defined: int,
    tolerance: float,
    start: float,
    stop_defined: int,
    stop: float,
) -> int:
    """fmi2SetupExperiment and fmi3EnterInitializationMode."""
    return _at(function, "widdid")(instance, tolerance_defined, tolerance, start, stop_defined, stop)


def access2(function: int, instance: int, references: int, count: int, values: int) -> int:
    """The setters and getters of FMI 2."""
    return _at(function, "wwww")(instance, references, count, values)


def access3(function: int, instance: int, references: int, count: int, values: int, size: int) -> int:
    """The setters and getters of FMI 3."""
    return _at(function, "wwwww")(instance, references, count, values, size)


def set_input_derivatives(
    function: int, instance: int, references: int, count: int, orders: int, values: int
) -> int:
    """fmi2SetRealInputDerivatives."""
    return _at(function, "wwwww")(instance, references, count, orders, values)


def do_step2(function: int, instance: int, time: float, length: float, no_going_back: int) -> int:
    """fmi2DoStep."""
    return _at(function, "wddi")(instance, time, length, no_going_back)


def do_step3(
    function: int,
    instance: int,
    time: float,
    length: float,
    no_going_back: int,
    event: int,
    terminate: int,
    early: int,
    reached: int,
) -> int:
    """fmi3DoStep; the last four arguments are addresses of its results."""
    return _at(function, "wddiwwww")(instance, time, length, no_going_back, event, terminate, early, reached)


#: Each function with its C argument types: w a word, i an int, d a double.
SIGNATURES: Final = MappingProxyType(
    {
        change_mode: "w",
        begin: "widdid",
        access2: "wwww",
        access3: "wwwww",
        set_input_derivatives: "wwwww",
        do_step2: "wddi",
        do_step3: "wddiwwww",
    }
)


def bound(function: Callable[..., int], address: int, *arguments: Any, is_short: bool) -> Callable[[], int]:
    """Bind a C function to its arguments, for calls in which a microsecond counts.

    Args:
        function: a function of this module
        address: address of the C function
        arguments: numbers, or ctypes objects whose value is read at each call
        is_short: keep the GIL, which takes less time than releasing it
    """
    letters = SIGNATURES[function]
    given = [
        one if isinstance(one, _SimpleCData) else _C_TYPES[letter](one)
        for letter, one in zip(letters, arguments, strict=True)
    ]
    kind = PYFUNCTYPE if is_short else CFUNCTYPE
    return partial(kind(c_int)(address), *given)
