"""Modelica functions compiled by the generator and called from Python."""

from __future__ import annotations

import ctypes
import itertools
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import rumoca

from fmu_build.codegen.functions import FunctionLibrary, FunctionSignature
from fmu_build.codegen.lowered import LoweredModel

ALGORITHMS = Path(__file__).parent / "Algorithms.mo"
_FLAGS = (
    "-std=c11",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Werror",
    "-O1",
    "-ffp-contract=off",
    "-fPIC",
    "-shared",
)
_SIGN = "double sign(double a); double sign(double a) { return (a > 0.0) - (a < 0.0); }"
_Doubles = ctypes.POINTER(ctypes.c_double)


def load(text: str, model: str) -> rumoca.Model:
    """Compile Modelica text."""
    return rumoca.Session().loads(text, model=model)


def compile_c(source: str, path: Path, *arguments: str) -> ctypes.CDLL:
    """A shared library from C source, without any warning."""
    c_file = path.with_suffix(".c")
    c_file.write_text(source, "utf-8")
    command = [
        sys.executable,
        "-m",
        "ziglang",
        "cc",
        *_FLAGS,
        *arguments,
        "-o",
        str(path),
        str(c_file),
        "-lm",
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return ctypes.CDLL(str(path))


class CompiledFunctions:
    """All functions of a model; arguments and results are flat lists of doubles."""

    def __init__(self, lowered: LoweredModel, folder: Path) -> None:
        library = FunctionLibrary(lowered)
        self._signatures: dict[tuple[str, tuple[int | None, ...]], FunctionSignature] = {}
        wrappers = []
        for function in lowered.dae["functions"]:
            signature = library.signature(function["id"])
            wrappers += [_wrapper(signature), _wrapper(signature.tangent)]
            self._signatures[function["name"].rpartition(".")[2], signature.inputs] = signature
        sources = library.sources()
        parts = ["#include <math.h>", _SIGN, sources.source, *sources.tangents.values(), *wrappers]
        source = "\n".join(parts)
        self._library = compile_c(source, folder / "functions.so")

    def call(self, name: str, *arguments: float | Sequence[float]) -> list[float]:
        """All results of a function, the elements of arrays one by one."""
        return self._run(self._signatures[name, _sizes(arguments)], flat(arguments))

    def tangents(
        self, name: str, arguments: Sequence[float | Sequence[float]], directions: Sequence[float]
    ) -> list[float]:
        """How the results move when the arguments, element by element, move in a direction."""
        signature = self._signatures[name, _sizes(arguments)].tangent
        return self._run(signature, [*flat(arguments), *directions])

    def _run(self, signature: FunctionSignature, values: Sequence[float]) -> list[float]:
        function = getattr(self._library, f"call_{signature.name}")
        function.argtypes = (_Doubles, _Doubles)
        function.restype = None
        results = (ctypes.c_double * signature.n_results)()
        function((ctypes.c_double * len(values))(*values), results)
        return list(results)


def _sizes(arguments: Sequence[float | Sequence[float]]) -> tuple[int | None, ...]:
    return tuple(None if isinstance(argument, float | int) else len(argument) for argument in arguments)


def flat(arguments: Sequence[float | Sequence[float]]) -> list[float]:
    """All numbers, one behind the other."""
    parts = ([argument] if isinstance(argument, float | int) else argument for argument in arguments)
    return [float(value) for value in itertools.chain(*parts)]


def _wrapper(signature: FunctionSignature) -> str:
    arguments = []
    place = 0
    for size in signature.inputs:
        arguments.append(f"input[{place}]" if size is None else f"input + {place}")
        place += size or 1
    if signature.returns_value:
        body = f"output[0] = {signature.call(arguments)};"
    else:
        body = f"{signature.call(arguments, 'output')};"
    head = f"void call_{signature.name}(const double *input, double *output)"
    return f"{head};\n{head} {{ (void)input; {body} }}"
