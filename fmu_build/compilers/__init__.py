"""The Modelica compilers that build FMUs, by name."""

from __future__ import annotations

from collections.abc import Callable

from fmu_build.compilers.base import Compiler
from fmu_build.support.errors import BuildError, UnknownCompilerError
from fmu_build.support.request import BuildRequest, BuildResult

__all__ = ["build", "compiler_names", "get_compiler"]


def _rumoca() -> Compiler:
    from fmu_build.compilers.rumoca import RumocaCompiler

    return RumocaCompiler()


def _openmodelica() -> Compiler:
    from fmu_build.compilers.openmodelica import OpenModelicaCompiler

    return OpenModelicaCompiler()


# Imported on first use: a compiler's Python package may be large, or not be installed.
_COMPILERS: dict[str, Callable[[], Compiler]] = {"rumoca": _rumoca, "openmodelica": _openmodelica}


def compiler_names() -> tuple[str, ...]:
    """Return the names that `get_compiler` accepts, the default first."""
    return tuple(_COMPILERS)


def get_compiler(name: str) -> Compiler:
    """Return the backend with this name; raises `UnknownCompilerError`, which lists the valid names."""
    if name not in _COMPILERS:
        raise UnknownCompilerError(f"unknown compiler {name!r}; use {' or '.join(_COMPILERS)}")
    return _COMPILERS[name]()


def build(compiler: str, request: BuildRequest) -> BuildResult:
    """Build with the compiler of this name; raises `BuildError` for options that it does not offer."""
    backend = get_compiler(compiler)
    unknown = [name for name in request.options if name not in backend.options]
    if unknown:
        known = f"it has {', '.join(backend.options)}" if backend.options else "it has none"
        raise BuildError(f"the compiler {compiler} has no option {unknown[0]!r}; {known}")
    if request.sensitivity is not None and not backend.computes_sensitivities:
        able = [name for name in compiler_names() if get_compiler(name).computes_sensitivities]
        raise BuildError(f"the compiler {compiler} computes no sensitivities; use {' or '.join(able)}")
    return backend.build(request)
