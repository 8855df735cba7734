"""A thin wrapper of the runtime's FMI 3.0 functions."""

from __future__ import annotations

import ctypes as c
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from tests.fmu_build.runtime.library import CO_SIMULATION, OK, TOKEN

_Log = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p)
_Update = c.CFUNCTYPE(
    None,
    c.c_void_p,
    c.c_double,
    *(c.c_bool,) * 4,
    c.POINTER(c.c_bool),
    c.POINTER(c.c_double),
)
_TYPES = {"Float64": c.c_double, "Int32": c.c_int32, "Int64": c.c_int64, "Boolean": c.c_bool}


@dataclass(frozen=True)
class Update:
    """The arguments of an intermediate update."""

    time: float
    may_set: bool
    may_get: bool
    finished: bool
    can_return_early: bool


@dataclass(frozen=True)
class Step:
    """What fmi3DoStep returns."""

    status: int
    event: bool
    terminate: bool
    early: bool
    time: float


@dataclass(frozen=True)
class Discrete:
    """What fmi3UpdateDiscreteStates returns."""

    status: int
    again: bool
    terminate: bool
    nominals_changed: bool
    states_changed: bool
    next_time: float | None


class Instance3:
    """One instance; `messages` collects (status, category, text) of what it logs.

    `on_update` is called in intermediate updates; what it returns is the time to return early at, or None.
    """

    def __init__(
        self,
        library: c.CDLL,
        kind: int = CO_SIMULATION,
        *,
        logging: bool = True,
        token: str = TOKEN,
        name: str = "test",
        event_mode: bool = False,
        early_return: bool = False,
        intermediate: Sequence[int] = (),
        on_update: Callable[[Update], float | None] | None = None,
    ) -> None:
        self.library = library
        self.messages: list[tuple[int, str, str]] = []
        self._log_function = _Log(self._log)
        self._on_update = on_update
        self._update_function = _Update(self._update) if on_update else c.cast(None, _Update)
        common = (name.encode(), token.encode(), None, c.c_bool(False), c.c_bool(logging))
        if kind == CO_SIMULATION:
            create = library.fmi3InstantiateCoSimulation
            arguments: tuple[object, ...] = (
                *common,
                c.c_bool(event_mode),
                c.c_bool(early_return),
                (c.c_uint32 * len(intermediate))(*intermediate) if intermediate else None,
                c.c_size_t(len(intermediate)),
                None,
                self._log_function,
                self._update_function,
            )
        else:
            create = library.fmi3InstantiateModelExchange
            arguments = (*common, None, self._log_function)
        create.restype = c.c_void_p
        self.handle: int | None = create(*arguments)

    def _log(self, _environment: object, status: int, category: bytes, message: bytes) -> None:
        self.messages.append((status, category.decode(), message.decode()))

    def _update(self, _: object, time: float, *arguments: object) -> None:
        *flags, early, early_time = arguments
        assert self._on_update is not None
        wanted = self._on_update(Update(time, *map(bool, flags)))
        if wanted is not None:
            early[0], early_time[0] = True, wanted  # type: ignore[index]

    @property
    def text(self) -> str:
        """Everything logged so far, as a reader sees it."""
        return "\n".join(message for _, _, message in self.messages)

    def call(self, function: str, *arguments: object) -> int:
        """Calls an fmi3 function on the instance; floats are passed as doubles, bools as C's."""
        kinds = {float: c.c_double, bool: c.c_bool}
        converted = [kinds[type(x)](x) if type(x) in kinds else x for x in arguments]
        return int(self.library[function](c.c_void_p(self.handle), *converted))

    def expect(self, function: str, *arguments: object) -> None:
        """Calls a function that must return fmi3OK."""
        status = self.call(function, *arguments)
        assert status == OK, f"{function}: {status}\n{self.text}"

    def free(self) -> None:
        """Ends the instance."""
        free = self.library.fmi3FreeInstance
        free.restype = None
        free(c.c_void_p(self.handle))
        self.handle = None

    def enter_initialization(
        self, tolerance: float = 1e-8, start: float = 0.0, stop: float | None = None
    ) -> int:
        """fmi3EnterInitializationMode."""
        return self.call("fmi3EnterInitializationMode", True, tolerance, start, stop is not None, stop or 0.0)

    def initialize(self, tolerance: float = 1e-8, start: float = 0.0, stop: float | None = None) -> None:
        """From the instantiated state to Step Mode or Event Mode."""
        assert self.enter_initialization(tolerance, start, stop) == OK, self.text
        self.expect("fmi3ExitInitializationMode")

    def step(self, point: float, size: float) -> Step:
        """fmi3DoStep."""
        event, terminate, early = (c.c_bool(True) for _ in range(3))  # what the FMU leaves out shows
        time = c.c_double(math.nan)
        outputs = (c.byref(event), c.byref(terminate), c.byref(early), c.byref(time))
        status = self.call("fmi3DoStep", float(point), float(size), True, *outputs)
        return Step(status, event.value, terminate.value, early.value, time.value)

    def advance(self, point: float, size: float) -> None:
        """A step that must return fmi3OK."""
        assert self.step(point, size).status == OK, self.text

    def update(self) -> Discrete:
        """fmi3UpdateDiscreteStates."""
        flags, time = [c.c_bool(True) for _ in range(5)], c.c_double(math.nan)
        status = self.call("fmi3UpdateDiscreteStates", *map(c.byref, flags), c.byref(time))
        values = [flag.value for flag in flags]
        return Discrete(status, *values[:4], time.value if values[4] else None)

    def run(self, end: float, steps: int, references: Sequence[int], start: float = 0.0) -> list[list[float]]:
        """Equal communication steps to `end`; values of Float64 variables at every point and the start."""
        size = (end - start) / steps
        values = [self.get(*references)]
        for i in range(steps):
            done = self.step(start + i * size, size)
            assert (done.status, done.event, done.early) == (OK, False, False), self.text
            values.append(self.get(*references))
        return values

    def get(self, *references: int) -> list[float]:
        """Values of Float64 variables."""
        status, values = self.read("Float64", *references)
        assert status == OK, self.text
        return [float(value) for value in values]

    def read(self, kind: str, *references: int) -> tuple[int, list[float]]:
        """Status and values of fmi3Get."""
        n = len(references)
        values = (_TYPES[kind] * n)()
        array = (c.c_uint32 * n)(*references)
        status = self.call(f"fmi3Get{kind}", array, c.c_size_t(n), values, c.c_size_t(n))
        return status, list(values)

    def set(self, values: dict[int, float], kind: str = "Float64") -> int:
        """fmi3Set by value reference."""
        n = len(values)
        array = (c.c_uint32 * n)(*values)
        number = float if kind == "Float64" else int
        stored = (_TYPES[kind] * n)(*map(number, values.values()))
        return self.call(f"fmi3Set{kind}", array, c.c_size_t(n), stored, c.c_size_t(n))

    def save(self) -> c.c_void_p:
        """fmi3GetFMUState."""
        state = c.c_void_p()
        self.expect("fmi3GetFMUState", c.byref(state))
        return state

    def restore(self, state: c.c_void_p) -> None:
        """fmi3SetFMUState."""
        self.expect("fmi3SetFMUState", state)

    def serialize(self, state: c.c_void_p) -> bytes:
        """A saved state as bytes."""
        size = c.c_size_t()
        self.expect("fmi3SerializedFMUStateSize", state, c.byref(size))
        buffer = c.create_string_buffer(size.value)
        self.expect("fmi3SerializeFMUState", state, buffer, size)
        return buffer.raw

    def deserialize(self, data: bytes) -> tuple[int, c.c_void_p]:
        """Status and state of fmi3DeserializeFMUState."""
        state = c.c_void_p()
        status = self.call("fmi3DeserializeFMUState", data, c.c_size_t(len(data)), c.byref(state))
        return status, state

    def discard(self, state: c.c_void_p) -> None:
        """fmi3FreeFMUState."""
        self.expect("fmi3FreeFMUState", c.byref(state))
        assert not state.value
