"""Runs a model's FMU through FMPy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import simulate_fmu
from fmpy.fmi2 import FMU2Slave

from .case import Array, Case

TOLERANCE = 1e-8


@dataclass(frozen=True)
class Fmu:
    """An unpacked FMU."""

    folder: Path
    description: Any

    def run(self, case: Case, fmi_type: str, output_interval: float, **options: Any) -> Any:
        """FMPy's result: a structured array with the time and the variables of the case's oracle."""
        probe = np.array([0.0, case.stop_time])
        return simulate_fmu(
            self.folder,
            model_description=self.description,
            fmi_type=fmi_type,
            stop_time=case.stop_time,
            output_interval=output_interval,
            relative_tolerance=TOLERANCE,
            start_values=dict(case.parameters),
            output=list(case.expected(probe)),
            **options,
        )

    def run_with_inputs(self, case: Case, steps: int) -> dict[str, Array]:
        """Co-simulation with Real inputs that are linear in time, by their values and derivatives."""
        inputs = [self._variables[name].valueReference for name in case.inputs]
        outputs = list(case.expected(np.array([0.0, case.stop_time])))
        times = np.linspace(0.0, case.stop_time, steps + 1)
        signals = np.array([signal(times) for signal in case.inputs.values()])
        slave = FMU2Slave(
            guid=self.description.guid,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            unzipDirectory=str(self.folder),
        )
        slave.instantiate()
        slave.setupExperiment(tolerance=TOLERANCE, startTime=0.0, stopTime=case.stop_time)
        slave.enterInitializationMode()
        slave.setReal(inputs, signals[:, 0])
        slave.exitInitializationMode()
        rows = [self._read(slave, outputs)]
        for k in range(steps):
            step = times[k + 1] - times[k]
            slave.setReal(inputs, signals[:, k])
            slave.setRealInputDerivatives(
                inputs, [1] * len(inputs), (signals[:, k + 1] - signals[:, k]) / step
            )
            slave.doStep(currentCommunicationPoint=times[k], communicationStepSize=step)
            rows.append(self._read(slave, outputs))
        slave.terminate()
        slave.freeInstance()
        return {"time": times, **dict(zip(outputs, np.array(rows).T, strict=True))}

    @property
    def _variables(self) -> dict[str, Any]:
        return {variable.name: variable for variable in self.description.modelVariables}

    def _read(self, slave: FMU2Slave, names: list[str]) -> list[float]:
        getters = {"Real": slave.getReal, "Integer": slave.getInteger, "Boolean": slave.getBoolean}
        found = [self._variables[name] for name in names]
        return [float(getters[variable.type]([variable.valueReference])[0]) for variable in found]


FmuOf = Callable[[Case], Fmu]


def event_times(result: Any) -> Array:
    """Times that FMPy recorded twice, before and after an event."""
    times = result["time"]
    return np.unique(times[1:][np.diff(times) == 0.0])
