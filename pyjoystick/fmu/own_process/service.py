"""Requests that a child process executes."""

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
    """The requests; each method raises what the same call in the parent's process would."""

    def __init__(self, place_file: str) -> None:
        """Share the progress of the run with the parent through a file, see `stepping.program`."""
        with Path(place_file).open("r+b") as file:
            self._place = np.frombuffer(mmap.mmap(file.fileno(), 0), np.intp, PLACE_SIZE)
        self._pool: InstancePool
        self._plan: Plan
        self._instance: Instance
        self._live: LiveInstance

    def open(self, description: FmuDescription, folder: Path) -> None:
        """Load the FMU from the folder where it is unpacked."""
        self._pool = InstancePool(description, folder, self._place)

    def plan(self, settings: Mapping[str, Any], load_compiler: bool) -> None:
        """Prepare the runs of a plan, and load the compiler outside the time limit of a run."""
        self._plan = Plan(None, self._pool, **settings)
        self._plan.loop_of((), load_compiler=load_compiler)

    def carry_out(self, rows: Any, cells: int, settings: Mapping[str, Any]) -> Outcome:
        """Execute runs of the plan, see `Plan.carry_out`."""
        return self._plan.carry_out(rows, cells, **settings)

    def linearize(self, *arguments: Any) -> Linearization:
        """Call `linearization.linearize` with these arguments after its first."""
        with self._pool.lent() as instance:
            return linearize(instance, *arguments)

    def wait(self) -> None:
        """Do nothing but answer."""

    def model_exchange(self, path: Path, settings: Mapping[str, Any]) -> Any:
        """Call `model_exchange.run_model_exchange`."""
        return run_model_exchange(path, **settings, own_process=False)

    def start(self, *settings: Any) -> None:
        """Start a simulation for `live`."""
        self._live = LiveInstance(self._pool, *settings)

    def live(self, name: str, *arguments: Any) -> Any:
        """Call a method of the live instance."""
        return getattr(self._live, name)(*arguments)

    def instantiate(self) -> None:
        """Make an instance for `call`."""
        self._instance = self._pool.take()

    def call(self, name: str, time: float, arguments: tuple[Any, ...]) -> Any:
        """Call a method of the instance, at `time` (s)."""
        with self._instance.reporting(time):
            return getattr(self._instance, name)(*arguments)
