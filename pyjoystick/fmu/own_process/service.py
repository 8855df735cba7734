"""What a process does that runs an FMU for another one."""

from __future__ import annotations

import mmap
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pyjoystick.fmu.description import FmuDescription
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.library import InstancePool
from pyjoystick.fmu.linearization import Linearization, linearize
from pyjoystick.fmu.live import LiveInstance
from pyjoystick.fmu.model_exchange import run_model_exchange
from pyjoystick.fmu.own_process.runner import Outcome
from pyjoystick.fmu.plan import Plan
from pyjoystick.fmu.stepping.program import PLACE_SIZE


class Service:
    """The requests; each method is one, and raises what the same call in the parent's process would."""

    def __init__(self, place_file: str) -> None:
        """Share the place of the run with the parent, see `stepping.program`, through a file."""
        with Path(place_file).open("r+b") as file:
            self._place = np.frombuffer(mmap.mmap(file.fileno(), 0), np.intp, PLACE_SIZE)
        self._pool: InstancePool
        self._plan: Plan
        self._instance: Instance
        self._live: LiveInstance

    def open(self, description: FmuDescription, folder: Path) -> None:
        """Load the FMU that is unpacked in the folder."""
        self._pool = InstancePool(description, folder, self._place)

    def plan(self, settings: Mapping[str, Any], load_compiler: bool) -> None:
        """Prepare the runs of a plan, and load the compiler, whose time is not that of a run."""
        self._plan = Plan(None, self._pool, **settings)
        self._plan.loop_of((), load_compiler=load_compiler)

    def carry_out(self, rows: Any, cells: int, settings: Mapping[str, Any]) -> Outcome:
        """Runs of the plan, as `Plan.carry_out`."""
        return self._plan.carry_out(rows, cells, **settings)

    def linearize(self, *arguments: Any) -> Linearization:
        """As `linearization.linearize` after its first argument."""
        with self._pool.lent() as instance:
            return linearize(instance, *arguments)

    def wait(self) -> None:
        """Answer."""

    def model_exchange(self, path: Path, settings: Mapping[str, Any]) -> Any:
        """As `model_exchange.run_model_exchange`."""
        return run_model_exchange(path, **settings, own_process=False)

    def start(self, *settings: Any) -> None:
        """Begin a simulation for `live`."""
        self._live = LiveInstance(self._pool, *settings)

    def live(self, name: str, *arguments: Any) -> Any:
        """A method of the live instance."""
        return getattr(self._live, name)(*arguments)

    def instantiate(self) -> None:
        """Take an instance for `call`."""
        self._instance = self._pool.take()

    def call(self, name: str, time: float, arguments: tuple[Any, ...]) -> Any:
        """A method of the instance, at `time` (s)."""
        with self._instance.reporting(time):
            return getattr(self._instance, name)(*arguments)
