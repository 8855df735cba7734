"""Modules that export what a run needs but behave maliciously."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from pathlib import Path

import wasmtime

from pyjoystick.fmu.sandbox.module import FUNCTIONS, MODULE

Smuggle = Callable[[bytes], Path]

_ZERO = {"": "", "i32": "(i32.const 0)", "f64": "(f64.const 0)"}
#: What the module does unless a test says otherwise: every run succeeds, and all values are 0.
_TAME = {"malloc": "(i32.const 1024)", "explore_record": "(local.get 3)"}


def module(memory: str = '(memory (export "memory") 2)', more: str = "", **bodies: str) -> bytes:
    """A module.

    Args:
        memory: its memory
        more: other parts
        bodies: WebAssembly text of functions by name, an empty one to leave the function out
    """
    functions = []
    for name, (arguments, results) in FUNCTIONS.items():
        body = bodies.get(name, _TAME.get(name, _ZERO[results]))
        if body or not results:
            types = f"(param {arguments})" * bool(arguments) + f"(result {results})" * bool(results)
            functions.append(f'(func (export "{name}") {types} {body})')
    made: bytes = wasmtime.wat2wasm(f"(module {more} {memory} {' '.join(functions)})")
    return bytes(made)


def with_module(fmu: Path, target: Path, identifier: str, content: bytes) -> Path:
    """A copy of an FMU with this module and no other."""
    name = MODULE.format(identifier=identifier)
    with zipfile.ZipFile(fmu) as source, zipfile.ZipFile(target, "w") as copy:
        for other in source.namelist():
            if other != name:
                copy.writestr(other, source.read(other))
        copy.writestr(name, content)
    return target
