"""One instance of a WebAssembly module, with limits on memory, fuel and time."""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import Any, Final, TypeVar

from pyjoystick.fmu.limits import allowed
from pyjoystick.fmu.sandbox.module import FUNCTIONS, new_engine
from pyjoystick.support import PyJoystickError

T = TypeVar("T")

#: Memory limit of a module (bytes).
LARGEST_MEMORY: Final = 2**28
#: Approximate limit of WebAssembly instructions per run, the same on every machine; takes some minutes.
MOST_FUEL: Final = 10**12
#: Limits of function tables: elements, and number of tables.
_MOST_ELEMENTS: Final = 10_000
#: Interval for checking the time limit and stop requests (s).
_INTERVAL: Final = 0.05
_LONGEST_TEXT: Final = 4096


class MachineError(PyJoystickError):
    """The module broke a rule or a limit; the machine is no longer usable."""


class FuelError(MachineError):
    """It exceeded its limit of instructions."""


class MachineMemoryError(MachineError):
    """It exceeded its memory limit."""


class LateError(MachineError):
    """It exceeded its time limit."""


class StoppedError(MachineError):
    """The result is no longer wanted."""


class Machine:
    """An instance of a module, working in its own thread under the supervision of its user.

    Attributes:
        is_alive: whether it can be used
    """

    def __init__(self, code: bytes, time_limit: float) -> None:
        """Instantiate the module.

        Args:
            code: from `module.compiled`
            time_limit: time limit of the instantiation (s)

        Raises:
            MachineError: the module fails to start
        """
        self.is_alive = True
        self._engine = new_engine()
        self._exports: Any = None
        self._address = self._room = 0
        self._thread = ThreadPoolExecutor(1, "sandbox")
        self.run(lambda: self._instantiate(code), time_limit)

    def close(self) -> None:
        """Shut it down; may be called more than once."""
        self.is_alive = False
        self._thread.shutdown(wait=False)

    def run(self, work: Callable[[], T], time_limit: float, is_stopped: Callable[[], bool] = bool) -> T:
        """Execute `work`, which calls the methods below, with fresh fuel.

        Ctrl-C and `is_stopped` end it promptly, whatever the module does.

        Raises:
            MachineError: the module broke a rule or a limit
            Exception: any exception that `work` raises
        """
        begin = clock.monotonic()
        future = self._thread.submit(self._guarded, work)
        reason: MachineError | None = None
        try:
            while True:
                try:
                    return future.result(_INTERVAL)
                except TimeoutError:
                    if clock.monotonic() - begin > time_limit:
                        reason = LateError(f"the run took longer than the time limit of {time_limit:g} s")
                    elif is_stopped():
                        reason = StoppedError("it was stopped")
                    if reason is not None:
                        break
        except MachineError:
            self.close()
            raise
        except BaseException:
            if not future.done():  # Ctrl-C; otherwise the exception is from `work`
                self._interrupt(future)
            raise
        self._interrupt(future)
        raise reason

    def _interrupt(self, future: Future[T]) -> None:
        """Stop the work and discard the machine."""
        self.close()
        while not future.done():
            self._engine.increment_epoch()  # again, in case the store was made after the first time
            wait([future], _INTERVAL)

    def _guarded(self, work: Callable[[], T]) -> T:
        import wasmtime

        try:
            if self._exports is not None:
                self._store.set_fuel(int(allowed(MOST_FUEL)))
            return work()
        except wasmtime.Trap as trap:
            if trap.trap_code == wasmtime.TrapCode.OUT_OF_FUEL:
                raise FuelError(f"it took more than {allowed(MOST_FUEL):.3g} instructions") from None
            raise MachineError(f"it trapped: {_why(trap)}") from None
        except wasmtime.WasmtimeError as error:
            raise MachineError(_why(error)) from None

    def _instantiate(self, code: bytes) -> None:
        import wasmtime

        store = self._store = wasmtime.Store(self._engine)
        store.set_limits(int(allowed(LARGEST_MEMORY)), _MOST_ELEMENTS, instances=1, tables=1, memories=1)
        store.set_epoch_deadline(1)
        store.set_fuel(int(allowed(MOST_FUEL)))
        module = wasmtime.Module.deserialize(self._engine, code)
        exports = wasmtime.Instance(store, module, []).exports(store)
        self._memory: Any = exports["memory"]
        self._exports = {name: exports[name] for name in FUNCTIONS}
        if isinstance(initialize := exports.get("_initialize"), wasmtime.Func):
            initialize(store)

    def call(self, name: str, *arguments: float) -> Any:
        """Call a function of `module.FUNCTIONS`; returns a number or None."""
        return self._exports[name](self._store, *arguments)

    def place(self, content: bytes) -> int:
        """Address of a copy of the content, valid until the next call."""
        if len(content) > self._room:
            if self._address:
                self.call("free", self._address)
            self._room, self._address = 0, _unsigned(self.call("malloc", len(content)))
            if not self._address:
                raise MachineMemoryError(
                    f"it has no memory for {len(content)} bytes (at most {_most_memory()})"
                )
            self._room = len(content)
        self._require_inside(self._address, len(content))
        self._memory.write(self._store, content, self._address)
        return self._address

    def read(self, address: int, size: int) -> bytearray:
        """Read this many bytes."""
        self._require_inside(address, size)
        content: bytearray = self._memory.read(self._store, address, address + size)
        return content

    def text(self, name: str) -> str:
        """Text at the address returned by a function."""
        address = _unsigned(self.call(name))
        room = self._memory.data_len(self._store) - address
        content = bytes(self.read(address, max(1, min(room, _LONGEST_TEXT))))
        return content.partition(b"\0")[0].decode("utf-8", errors="replace")

    def _require_inside(self, address: int, size: int) -> None:
        if not 0 <= address <= self._memory.data_len(self._store) - size:
            raise MachineError(f"it gave an address outside its memory: {address} for {size} bytes")


def _unsigned(address: int) -> int:
    return address & 0xFFFF_FFFF


def _most_memory() -> str:
    return f"{allowed(LARGEST_MEMORY) / 2**20:g} MiB"


def _why(error: Exception) -> str:
    """Last line of an error message that starts with a position in the module."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    return lines[-1].removeprefix("wasm trap: ") if lines else type(error).__name__
