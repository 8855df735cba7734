"""Pool of processes that have loaded an FMU."""

from __future__ import annotations

import math
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Final

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.errors import FmuCrashError, FmuFileError, FmuRunError, FmuTimeLimitError
from pyjoystick.fmu.library import InstancePool, require_runnable, unpacked
from pyjoystick.fmu.own_process.process import OwnProcess, ProcessEndedError
from pyjoystick.fmu.pool import Pool
from pyjoystick.support import positive, temporary_folder

#: Default time limit of a run in a separate process (s).
TIME_LIMIT: Final = 300.0
#: Minimum time allowed for loading, however short the limit of runs (s).
_LOADING: Final = 60.0


class ProcessPool(Pool[OwnProcess]):
    """Processes that run one FMU.

    Attributes:
        time_limit: time limit of a run (s)
    """

    #: A forked process must not use the parent's processes.
    survives_fork = False

    def __init__(self, description: FmuDescription, time_limit: float | None) -> None:
        """Start the first process, to verify that the FMU can be loaded.

        Raises:
            UnsupportedFmuError: this machine cannot run the FMU
            FmuFileError: it is broken, cannot be instantiated, or crashes at once
        """
        require_runnable(description, "CoSimulation")
        self.time_limit = TIME_LIMIT if time_limit is None else checked_limit(time_limit)
        self._stack = ExitStack()
        self._folder = self._stack.enter_context(unpacked(description))
        super().__init__(description)

    def ask(self, process: OwnProcess, time: float, request: str, *arguments: Any) -> Any:
        """Call `OwnProcess.ask` with the time limit, for a run at `time` (s); also raises FmuRunError."""
        try:
            return process.ask(request, *arguments, time_limit=self.time_limit)
        except ProcessEndedError as ended:
            raise run_error(ended, time, self.description.path) from None

    def linearize(self, *arguments: Any) -> Any:
        """As `linearization.linearize` after its first argument."""
        with self.lent() as process:
            try:
                return process.ask("linearize", *arguments, time_limit=self.time_limit)
            except ProcessEndedError as error:
                raise FmuFileError(self.description.path, f"cannot be linearized: {error}") from None

    def _make(self) -> OwnProcess:
        process = OwnProcess(self._folder)
        limit = max(_LOADING, self.time_limit)
        try:
            process.ask("open", self.description, self._folder, time_limit=limit)
        except ProcessEndedError as error:
            raise FmuFileError(self.description.path, f"cannot be loaded: {error}") from None
        except BaseException:
            process.close()
            raise
        return process

    def is_reusable(self, one: OwnProcess) -> bool:
        """See `Pool`."""
        return one.is_alive and not self.description.one_instance

    def _free(self, one: OwnProcess) -> None:
        one.close()

    def _put_away(self) -> None:
        self._stack.close()


def checked_limit(time_limit: float) -> float:
    """Check the time limit of a run (s), which may be infinite; raises ParameterError."""
    return time_limit if time_limit == math.inf else positive("time_limit", time_limit, "s")


def new_pool(
    description: FmuDescription, own_process: bool | None, time_limit: float | None
) -> InstancePool | ProcessPool:
    """Make the pool for the FMU; arguments as in `Fmu`."""
    if is_apart(description, own_process):
        return ProcessPool(description, time_limit)
    return InstancePool(description, time_limit=None if time_limit is None else checked_limit(time_limit))


def is_apart(description: FmuDescription, own_process: bool | None) -> bool:
    """Whether an FMU runs in a separate process; `own_process` as in `Fmu`."""
    return not description.is_ours if own_process is None else own_process


def run_apart(description: FmuDescription, time_limit: float | None, settings: dict[str, Any]) -> Any:
    """Run `model_exchange.run_model_exchange` in a separate process, with these settings."""
    require_runnable(description, "ModelExchange")
    limit = TIME_LIMIT if time_limit is None else checked_limit(time_limit)
    with temporary_folder() as folder:
        process = OwnProcess(folder)
        try:
            process.ask("wait")  # exclude its start from the time limit
            return process.ask("model_exchange", description.path, settings, time_limit=limit)
        except ProcessEndedError as ended:
            raise run_error(ended, float(settings["time"][0]), description.path) from None
        finally:
            process.close()


def run_error(ended: ProcessEndedError, time: float, path: Path) -> FmuRunError:
    """Make the error for a run whose process ended at `time` (s)."""
    kind = FmuTimeLimitError if ended.is_late else FmuCrashError
    return kind(time, str(ended), path)
