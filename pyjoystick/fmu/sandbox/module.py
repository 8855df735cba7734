"""The WebAssembly module of an FMU, compiled for this machine."""

from __future__ import annotations

import zipfile
from importlib.util import find_spec
from typing import Any, Final

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.errors import FmuFileError, UnsupportedFmuError
from pyjoystick.fmu.limits import require_at_most
from pyjoystick.support import ARCHIVE_ERRORS, MissingPackageError, archive_problem

#: Path of the module in FMUs made with `fmu_build --platform wasm32`.
MODULE: Final = "extra/org.pyjoystick/wasm32/{identifier}.wasm"
#: Compiling takes seconds per million bytes and cannot be interrupted.
LARGEST_MODULE: Final = 2**20
#: Types of arguments and results, by name of the function (fmu_build/runtime/wasm/explore.h).
FUNCTIONS: Final[dict[str, tuple[str, str]]] = {
    "malloc": ("i32", "i32"),
    "free": ("i32", ""),
    "explore_begin": ("f64 f64 f64", "i32"),
    "explore_set_real": ("i32 i32 i32", "i32"),
    "explore_set_integer": ("i32 i32 i32", "i32"),
    "explore_set_boolean": ("i32 i32 i32", "i32"),
    "explore_initialize": ("", "i32"),
    "explore_inputs": ("i32 i32 i32 i32 i32", ""),
    "explore_record": ("i32 i32 i32 i32 i32 i32", "i32"),
    "explore_time": ("", "f64"),
    "explore_status": ("", "i32"),
    "explore_message": ("", "i32"),
}
#: WebAssembly features that modules compiled from C do not need.
_SWITCHED_OFF: Final = (
    *("wasm_threads", "shared_memory", "wasm_memory64", "wasm_multi_memory", "wasm_custom_page_sizes"),
    *("wasm_gc", "gc_support", "wasm_exceptions", "wasm_stack_switching", "wasm_component_model"),
    *("wasm_function_references", "wasm_relaxed_simd", "wasm_tail_call"),
)
_STACK: Final = 2**18  # bytes


def require_sandbox(description: FmuDescription) -> None:
    """Raise an error unless the FMU has a module and wasmtime is installed.

    Raises:
        UnsupportedFmuError: the FMU is of FMI 3, or has no Co-Simulation or no module
        MissingPackageError: wasmtime is not installed
    """
    path = description.path
    if not description.fmi_version.startswith("2."):
        reason = f"is an FMU of FMI {description.fmi_version}; a sandbox supports only FMI 2.0"
        raise UnsupportedFmuError(path, reason)
    if "CoSimulation" not in description.interfaces:
        raise UnsupportedFmuError(path, "has no CoSimulation interface, which is what a sandbox runs")
    if find_spec("wasmtime") is None:
        raise MissingPackageError("FMUs in a sandbox", "sandbox")
    if _name(description) not in _names(description):
        advice = "python -m fmu_build MODEL --platform wasm32 builds one with it"
        raise UnsupportedFmuError(path, f"has no WebAssembly module {_name(description)}; {advice}")


def read_module(description: FmuDescription) -> bytes:
    """The module's bytes; raises FmuFileError if it is too large or the archive is damaged."""
    path = description.path
    try:
        with zipfile.ZipFile(path) as archive:
            size = archive.getinfo(_name(description)).file_size
            require_at_most(path, "has a WebAssembly module of {} bytes", size, LARGEST_MODULE)
            return archive.read(_name(description))
    except ARCHIVE_ERRORS as error:
        raise FmuFileError(path, f"cannot be unpacked: {archive_problem(error)}") from error


def new_engine() -> Any:
    """Make a wasmtime engine; code compiled by one can be loaded by another."""
    import wasmtime

    config = wasmtime.Config()
    config.consume_fuel = True
    config.epoch_interruption = True
    config.max_wasm_stack = _STACK
    for feature in _SWITCHED_OFF:
        setattr(config, feature, False)
    return wasmtime.Engine(config)


def compiled(description: FmuDescription) -> bytes:
    """Compile the module for this machine; raises FmuFileError unless it has exactly what runs need."""
    import wasmtime

    path = description.path
    code = read_module(description)
    try:
        module = wasmtime.Module(new_engine(), code)
    except wasmtime.WasmtimeError as error:
        first = str(error).splitlines()[0]
        raise FmuFileError(path, f"its WebAssembly module cannot be compiled: {first}") from error
    if module.imports:
        asked = ", ".join(f"{one.module}.{one.name}" for one in list(module.imports)[:5])
        raise FmuFileError(
            path, f"its WebAssembly module imports functions that the sandbox does not provide: {asked}"
        )
    _require_exports(description, {one.name: one.type for one in module.exports})
    return bytes(module.serialize())


def _require_exports(description: FmuDescription, exports: dict[str | None, Any]) -> None:
    import wasmtime

    wrong = [] if isinstance(exports.get("memory"), wasmtime.MemoryType) else ["memory"]
    for name, (arguments, results) in FUNCTIONS.items():
        found = exports.get(name)
        if not isinstance(found, wasmtime.FuncType) or _signature(found) != (arguments, results):
            wrong.append(name)
    if wrong:
        reason = f"its WebAssembly module does not export what a run needs: {', '.join(wrong)}"
        raise FmuFileError(description.path, reason)


def _signature(function: Any) -> tuple[str, str]:
    arguments, results = (" ".join(map(str, types)) for types in (function.params, function.results))
    return arguments, results


def _name(description: FmuDescription) -> str:
    return MODULE.format(identifier=description.interfaces["CoSimulation"])


def _names(description: FmuDescription) -> list[str]:
    with zipfile.ZipFile(description.path) as archive:
        return archive.namelist()
