"""Hand-written models compiled with the runtime, and a thin wrapper of their FMI 2.0 functions."""

from __future__ import annotations

import ctypes as c
import os
import shlex
import subprocess
import sys
from collections.abc import Sequence
from importlib import resources
from pathlib import Path

from fmu_build.packaging.binaries import COMPILER_FLAGS
from fmu_build.packaging.sources import FMI_HEADERS, MODULE_FACE, RUNTIME, include_arguments, runtime_files
from fmu_build.support.request import FmiVersion

HERE = Path(__file__).parent
MODELS = HERE / "models"
# What is tested without the rest of the runtime.
UNITS = (
    *("model/linear.c", "model/newton.c", "model/newton_explain.c", "model/newton_starts.c", "model/block.c"),
    *("instant/actions.c", "integration/integrator.c", "integration/location.c"),
)
TOKEN = "{00000000-0000-0000-0000-000000000001}"

OK, WARNING, DISCARD, ERROR, FATAL, PENDING = range(6)
MODEL_EXCHANGE, CO_SIMULATION = 0, 1
DO_STEP_STATUS, PENDING_STATUS, LAST_SUCCESSFUL_TIME, TERMINATED = range(4)

_Logger = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p)


class _Callbacks(c.Structure):
    _fields_ = (
        ("logger", _Logger),
        ("allocate", c.c_void_p),
        ("free", c.c_void_p),
        ("step_finished", c.c_void_p),
        ("environment", c.c_void_p),
    )


class EventInfo(c.Structure):
    """fmi2EventInfo."""

    _fields_ = (
        ("new_discrete_states_needed", c.c_int),
        ("terminate", c.c_int),
        ("nominals_changed", c.c_int),
        ("states_changed", c.c_int),
        ("next_event_time_defined", c.c_int),
        ("next_event_time", c.c_double),
    )


# What test_sanitizers.py sets: a compiler and its flags, in place of the compiler that FMUs are built with.
_COMPILER = shlex.split(os.environ.get("RUNTIME_TEST_COMPILER", "")) or [
    sys.executable,
    "-m",
    "ziglang",
    "cc",
]


class Workshop:
    """Compiles the runtime once and links it with any number of models."""

    def __init__(
        self, folder: Path, fmi_version: FmiVersion = "2.0", compiler: Sequence[str] = _COMPILER
    ) -> None:
        self._folder = folder
        self._compiler = compiler
        headers = resources.files("fmpy") / "c-code"
        standard = folder / "standard"
        standard.mkdir()
        for name in FMI_HEADERS[fmi_version]:
            (standard / name).write_bytes((headers / name).read_bytes())
        (folder / "token.h").write_text(f'#define MODEL_TOKEN "{TOKEN}"\n', "utf-8")
        own = (*include_arguments(), "-I", MODELS, "-I", folder, "-isystem", standard)
        counted = ("-include", HERE / "allocations.h")
        self._flags = (*COMPILER_FLAGS, "-Wpedantic", "-Werror", "-fPIC", *counted, *own)
        runtime = (file for file in runtime_files(fmi_version) if file.suffix == ".c")
        self._compile("-c", *runtime, HERE / "allocations.c")
        self._libraries: dict[str, c.CDLL] = {}

    def _compile(self, *arguments: str | Path) -> None:
        command = [*self._compiler, *map(str, (*self._flags, *arguments))]
        # A sanitizer in front of this process is not meant for the compiler.
        environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
        done = subprocess.run(
            command, cwd=self._folder, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr

    def path(self, name: str) -> Path:
        """The shared library of ``models/<name>.c``."""
        path = self._folder / f"{name}.so"
        if not path.is_file():
            objects = self._folder.glob("*.o")
            self._compile("-shared", "-o", path, MODELS / f"{name}.c", *objects, "-lm")
        return path

    def library(self, name: str) -> c.CDLL:
        """The same, loaded."""
        if name not in self._libraries:
            self._libraries[name] = c.CDLL(str(self.path(name)))
        return self._libraries[name]

    def program(self, name: str, *files: Path) -> Path:
        """The runtime with these files, which define a model and ``main``; each of them is compiled once."""
        folder = self._folder / "programs"
        folder.mkdir(exist_ok=True)
        objects = {file: folder / f"{file.stem}.o" for file in files}
        for file, one in objects.items():
            if not one.is_file():
                self._compile("-I", RUNTIME / MODULE_FACE, "-c", "-o", one, file)
        path = folder / name
        self._compile("-o", path, *objects.values(), *self._folder.glob("*.o"), "-lm")
        return path

    def units(self) -> c.CDLL:
        """`UNITS` with ``units.c`` in place of the rest, all their functions to be called."""
        path = self._folder / "units.so"
        sources = [HERE / "units.c", HERE / "allocations.c", *(RUNTIME / name for name in UNITS)]
        self._compile("-fvisibility=default", "-shared", "-o", path, *sources, "-lm")
        return c.CDLL(str(path))


def live_blocks(library: c.CDLL) -> int:
    """How many blocks of memory the runtime has allocated and not freed."""
    library.test_live.restype = c.c_long
    return int(library.test_live())


def fail_after(library: c.CDLL, number: int) -> None:
    """Lets so many allocations go well and the next one fail; none where the number is negative."""
    library.test_fail_after(c.c_long(number))


class Instance:
    """One instance; `messages` collects (status, category, text) of what it logs."""

    def __init__(
        self,
        library: c.CDLL,
        kind: int = CO_SIMULATION,
        *,
        debug: bool = False,
        token: str = TOKEN,
        name: str = "test",
    ) -> None:
        self.library = library
        self.messages: list[tuple[int, str, str]] = []
        self._logger = _Logger(self._log)
        self._callbacks = _Callbacks(self._logger, None, None, None, None)
        create = library.fmi2Instantiate
        create.restype = c.c_void_p
        create.argtypes = (c.c_char_p, c.c_int, c.c_char_p, c.c_char_p, c.c_void_p, c.c_int, c.c_int)
        self.handle: int | None = create(
            name.encode(), kind, token.encode(), b"", c.addressof(self._callbacks), 0, int(debug)
        )

    def _log(self, _environment: object, name: bytes, status: int, category: bytes, message: bytes) -> None:
        self.messages.append((status, category.decode(), message.decode()))
        self.logged_name = name.decode()

    @property
    def text(self) -> str:
        """Everything logged so far."""
        return "\n".join(message for _, _, message in self.messages)

    def call(self, function: str, *arguments: object) -> int:
        """Calls an fmi2 function on the instance; floats are passed as doubles."""
        converted = [c.c_double(x) if isinstance(x, float) else x for x in arguments]
        return int(self.library[function](c.c_void_p(self.handle), *converted))

    def expect(self, function: str, *arguments: object) -> None:
        """Calls a function that must return fmi2OK."""
        status = self.call(function, *arguments)
        assert status == OK, f"{function}: {status}\n{self.text}"

    def free(self) -> None:
        """Ends the instance."""
        free = self.library.fmi2FreeInstance
        free.restype = None
        free(c.c_void_p(self.handle))
        self.handle = None

    def initialize(self, tolerance: float = 1e-8, start: float = 0.0, stop: float | None = None) -> None:
        """From the instantiated state to the first communication point, or to Event Mode."""
        self.setup(tolerance, start, stop)
        self.expect("fmi2EnterInitializationMode")
        self.expect("fmi2ExitInitializationMode")

    def setup(self, tolerance: float = 1e-8, start: float = 0.0, stop: float | None = None) -> None:
        """fmi2SetupExperiment."""
        self.expect("fmi2SetupExperiment", 1, tolerance, start, int(stop is not None), stop or 0.0)

    def step(self, point: float, size: float) -> int:
        """fmi2DoStep."""
        return self.call("fmi2DoStep", float(point), float(size), 1)

    def advance(self, point: float, size: float) -> None:
        """A step that must return fmi2OK."""
        assert self.step(point, size) == OK, self.text

    def run(self, end: float, steps: int, references: Sequence[int], start: float = 0.0) -> list[list[float]]:
        """Equal communication steps to `end`; values of Real variables at every point, the first included."""
        size = (end - start) / steps
        values = [self.get(*references)]
        for i in range(steps):
            status = self.step(start + i * size, size)
            assert status == OK, f"{status}: {self.text}"
            values.append(self.get(*references))
        return values

    def get(self, *references: int) -> list[float]:
        """Values of Real variables."""
        n = len(references)
        values = (c.c_double * n)()
        self.expect("fmi2GetReal", (c.c_uint * n)(*references), c.c_size_t(n), values)
        return list(values)

    def get_one(self, kind: str, reference: int) -> int:
        """Value of an Integer or Boolean variable."""
        value = c.c_int(-999)
        self.expect(f"fmi2Get{kind}", (c.c_uint * 1)(reference), c.c_size_t(1), c.byref(value))
        return value.value

    def set(self, values: dict[int, float]) -> int:
        """Sets Real variables by value reference."""
        n = len(values)
        return self.call(
            "fmi2SetReal", (c.c_uint * n)(*values), c.c_size_t(n), (c.c_double * n)(*values.values())
        )

    def set_one(self, kind: str, reference: int, value: int) -> int:
        """Sets an Integer or Boolean variable."""
        return self.call(f"fmi2Set{kind}", (c.c_uint * 1)(reference), c.c_size_t(1), (c.c_int * 1)(value))

    def set_slope(self, reference: int, slope: float, order: int = 1) -> int:
        """fmi2SetRealInputDerivatives for one input."""
        return self.call(
            "fmi2SetRealInputDerivatives",
            (c.c_uint * 1)(reference),
            c.c_size_t(1),
            (c.c_int * 1)(order),
            (c.c_double * 1)(slope),
        )

    def save(self) -> c.c_void_p:
        """fmi2GetFMUstate."""
        state = c.c_void_p()
        self.expect("fmi2GetFMUstate", c.byref(state))
        return state

    def restore(self, state: c.c_void_p) -> None:
        """fmi2SetFMUstate."""
        self.expect("fmi2SetFMUstate", state)

    def serialize(self, state: c.c_void_p) -> bytes:
        """A saved state as bytes."""
        size = c.c_size_t()
        self.expect("fmi2SerializedFMUstateSize", state, c.byref(size))
        buffer = c.create_string_buffer(size.value)
        self.expect("fmi2SerializeFMUstate", state, buffer, size)
        return buffer.raw

    def deserialize(self, data: bytes) -> tuple[int, c.c_void_p]:
        """Status and state of fmi2DeSerializeFMUstate."""
        state = c.c_void_p()
        status = self.call("fmi2DeSerializeFMUstate", data, c.c_size_t(len(data)), c.byref(state))
        return status, state

    def discard(self, state: c.c_void_p) -> None:
        """fmi2FreeFMUstate."""
        self.expect("fmi2FreeFMUstate", c.byref(state))
        assert not state.value

    def statistics(self) -> dict[str, int]:
        """Ends the simulation; what the integrator says it has done."""
        self.expect("fmi2SetDebugLogging", 1, c.c_size_t(0), None)
        self.expect("fmi2Terminate")
        words = self.messages[-1][2].replace(",", "").replace(".", "").split()
        numbers = [int(word) for word in words if word.isdigit()]
        return dict(zip(("steps", "rejected", "evaluations", "events"), numbers, strict=True))
