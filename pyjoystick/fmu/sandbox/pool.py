"""Pool of machines that run the module of one FMU."""

from __future__ import annotations

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.errors import FmuFileError
from pyjoystick.fmu.own_process.pool import TIME_LIMIT, checked_limit
from pyjoystick.fmu.pool import Pool
from pyjoystick.fmu.sandbox.machine import Machine, MachineError
from pyjoystick.fmu.sandbox.module import compiled, require_sandbox


class SandboxPool(Pool[Machine]):
    """Machines with the module of an FMU.

    Attributes:
        time_limit: time limit of a run (s)
    """

    #: A forked process does not have the threads of its parent's machines.
    survives_fork = False

    def __init__(self, description: FmuDescription, time_limit: float | None) -> None:
        """Compile the module and make the first machine, to verify that it can be run.

        Raises:
            UnsupportedFmuError, MissingPackageError: as `require_sandbox`
            FmuFileError: the module is broken, too large, requires imports or fails at once
        """
        require_sandbox(description)
        self.time_limit = TIME_LIMIT if time_limit is None else checked_limit(time_limit)
        self._code = compiled(description)
        super().__init__(description)

    def _make(self) -> Machine:
        try:
            return Machine(self._code, self.time_limit)
        except MachineError as error:
            reason = f"its WebAssembly module cannot be started: {error}"
            raise FmuFileError(self.description.path, reason) from None

    def is_reusable(self, one: Machine) -> bool:
        """See `Pool`."""
        return one.is_alive

    def _free(self, one: Machine) -> None:
        one.close()

    def _put_away(self) -> None:
        pass
