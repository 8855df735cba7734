"""The kernel compiled by Numba.

The addresses of an FMU's functions are arguments, so one compilation serves every FMU. It is cached on
disk, next to this package or in the user's cache folder, and repeated in each process if neither is writable.
"""

from __future__ import annotations

import hashlib
import inspect
import logging
import sys
from collections.abc import Callable
from types import FunctionType
from typing import Any, Final, cast

from llvmlite import ir
from numba import njit, typeof, types
from numba.core import event
from numba.extending import intrinsic, overload, register_jitable

from pyjoystick.fmu.stepping import calls, decoding, kernel, program, reducing
from pyjoystick.motion import EXTREMA_FUNCTIONS

_LOG = logging.getLogger(__name__)

_SOURCES: Final = (sys.modules[EXTREMA_FUNCTIONS[0].__module__], calls, decoding, kernel, program, reducing)
_C_TYPES: Final = {"w": types.intp, "i": types.int32, "d": types.float64}


def compiled(arguments: tuple[object, ...]) -> Callable[..., int]:
    """`kernel.run_many` compiled for the types of these arguments, which are those of every call."""
    for plain, letters in calls.SIGNATURES.items():
        overload(plain)(_typing(letters))
    for function in kernel.FUNCTIONS:
        register_jitable(function)
    signature = tuple(typeof(argument) for argument in arguments)
    try:
        return _dispatcher(signature, cache=True)
    except (RuntimeError, OSError):
        # Numba found no writable folder, or failed to write its cache.
        return _dispatcher(signature, cache=False)


class _CompilationLog(event.Listener):  # type: ignore[misc]  # Numba has no annotations
    """Logs the first compilation only: those of the functions that the loop calls are part of it."""

    def __init__(self) -> None:
        self._is_logged = False

    def on_start(self, event: Any) -> None:
        """Log why the program waits."""
        if not self._is_logged:
            _LOG.info("compiling the loop of the runs; this takes some seconds the first time")
        self._is_logged = True

    def on_end(self, event: Any) -> None:
        """Do nothing; the interface requires it."""


def _dispatcher(signature: tuple[Any, ...], *, cache: bool) -> Callable[..., int]:
    dispatcher = njit(nogil=True, cache=cache)(_versioned(cast(FunctionType, kernel.run_many)))
    # Numba reports a compilation only if it has found nothing on disk.
    with event.install_listener("numba:compile", _CompilationLog()):
        dispatcher.compile(signature)
    dispatcher.disable_compile()
    return cast(Callable[..., int], dispatcher)


def _versioned(function: FunctionType) -> FunctionType:
    """The same function under a name that changes with its sources.

    Numba's disk cache is keyed by the name and the modification time of the function's own file, and ignores
    the files of functions that it calls.
    """
    sources = "".join(inspect.getsource(module) for module in _SOURCES) + inspect.getsource(_typing)
    copy = FunctionType(function.__code__, function.__globals__, function.__name__)
    copy.__qualname__ = f"{function.__qualname__}_{hashlib.sha256(sources.encode()).hexdigest()[:16]}"
    return copy


def _typing(letters: str) -> Callable[..., Any]:
    """Machine code for a function of `calls`, as required by Numba's `overload`."""

    def typed(_context: Any, address: Any, arguments: Any) -> tuple[Any, Callable[..., Any]]:
        wanted = [_C_TYPES[letter] for letter in letters]

        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            pointer, given = values
            c_values = [
                context.cast(builder, builder.extract_value(given, i), kind, wanted[i])
                for i, kind in enumerate(signature.args[1].types)
            ]
            c_types = [context.get_value_type(kind) for kind in wanted]
            function_type = ir.FunctionType(ir.IntType(32), c_types)
            return builder.call(builder.inttoptr(pointer, function_type.as_pointer()), c_values)

        return types.int32(types.intp, arguments), generate

    call = intrinsic(typed)

    def choose(function: Any, *arguments: Any) -> Callable[..., Any]:
        def body(function: Any, *arguments: Any) -> Any:
            return call(function, arguments)

        return body

    return choose
