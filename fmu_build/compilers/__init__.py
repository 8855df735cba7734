"""The Modelica compilers that can make FMUs, by name."""

from __future__ import annotations

from collections.abc import Callable

from fmu_build.compilers.base import Compiler
from fmu_build.errors import UnknownCompilerError

__all__ = ["compiler_names", "get_compiler"]


def _rumoca() -> Compiler:
    from fmu_build.compilers.rumoca import RumocaCompiler

    return RumocaCompiler()


# Imported on first use: a compiler's Python package may be large, or not be installed.
_COMPILERS: dict[str, Callable[[], Compiler]] = {"rumoca": _rumoca}


def compiler_names() -> tuple[str, ...]:
    """The names that `get_compiler` knows, the default first."""
    return tuple(_COMPILERS)


def get_compiler(name: str) -> Compiler:
    """The backend of that name; raises `UnknownCompilerError` that lists what there is."""
    if name not in _COMPILERS:
        raise UnknownCompilerError(f"unknown compiler {name!r}; there is {', '.join(_COMPILERS)}")
    return _COMPILERS[name]()
