"""Runs directly through FMPy, for tests that need more control than the package offers."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Slave
from numpy.typing import NDArray

from pyjoystick.model import JoystickParameters
from pyjoystick.runs import fmu_of_joystick

Columns = dict[str, NDArray[np.float64]]
_EVENT = re.compile(r"State event at time ([-+.\deE]+): (.*) changes its sign")
_KINKS = {
    "returnSpring.x_0": "x_0",
    "returnSpring.F_0": "x_1",
    "balanceSpring.x_0": "x_2",
    "balanceSpring.F_0": "x_3",
}


@dataclass(frozen=True)
class StateEvent:
    """A state event of the FMU, named as the reference names it."""

    time: float
    kind: str


def _kind(relation: str) -> str:
    """``forward.returnSpring.x_0 - forward.returnSpring.x`` is ``forward x_0``."""
    match = re.search(
        r"(forward|backward)\.(returnSpring\.x_0|returnSpring\.F_0|balanceSpring\.x_0|balanceSpring\.F_0)",
        relation,
    )
    return f"{match.group(1)} {_KINKS[match.group(2)]}" if match else "theta = 0"


class Slave:
    """One co-simulation instance, with variables by name and the log kept."""

    def __init__(self, fmu: FMU2Slave | FMU3Slave, references: Mapping[str, int], log: list[bytes]) -> None:
        self.fmu = fmu
        self.references = references
        self.log = log
        is_fmi2 = isinstance(fmu, FMU2Slave)
        self.get = fmu.getReal if is_fmi2 else fmu.getFloat64
        self.set = fmu.setReal if is_fmi2 else fmu.setFloat64

    def start(self, parameters: Mapping[str, float], tolerance: float) -> None:
        """From instantiated, or reset, to step mode."""
        self.set([self.references[name] for name in parameters], list(parameters.values()))
        if isinstance(self.fmu, FMU2Slave):
            self.fmu.setupExperiment(tolerance=tolerance, startTime=0.0)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(tolerance=tolerance, startTime=0.0)
        self.fmu.exitInitializationMode()

    def run(self, times: NDArray[np.float64], names: Sequence[str]) -> Columns:
        """Steps from one instant to the next; a row for each instant."""
        references = [self.references[name] for name in names]
        instants = times.tolist()
        rows = [self.get(references)]
        for now, then in pairwise(instants):
            self.fmu.doStep(currentCommunicationPoint=now, communicationStepSize=then - now)
            rows.append(self.get(references))
        return dict(zip(names, np.array(rows).T, strict=True))

    def events(self) -> list[StateEvent]:
        """The state events that the FMU has logged."""
        matches = (_EVENT.search(message.decode()) for message in self.log)
        return [StateEvent(float(match.group(1)), _kind(match.group(2))) for match in matches if match]


@contextmanager
def slave(path: Path, *, logging: bool = False) -> Iterator[Slave]:
    """An instance of an FMU; it is freed, and its files are removed, at the end."""
    description = fmpy.read_model_description(path)
    folder = fmpy.extract(path)
    log: list[bytes] = []
    is_fmi2 = description.fmiVersion == "2.0"
    fmu = (FMU2Slave if is_fmi2 else FMU3Slave)(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="test",
    )
    try:
        if is_fmi2:
            callbacks = fmi2CallbackFunctions()
            callbacks.logger = fmi2CallbackLoggerTYPE(lambda *message: log.append(message[-1]))
            fmu.instantiate(callbacks=callbacks, loggingOn=logging)
        else:
            fmu.instantiate(logMessage=lambda *message: log.append(message[-1]), loggingOn=logging)
        yield Slave(fmu, {v.name: v.valueReference for v in description.modelVariables}, log)
        fmu.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def model_exchange(
    fmu: Path, parameters: Mapping[str, float], *outputs: str, interval: float = 1e-3
) -> tuple[NDArray[np.float64], dict[str, NDArray[Any]]]:
    """FMPy's CVode at a tolerance of 1e-10 over 1.5 s: the times, and the outputs at each.

    Events come twice, before and after; the outputs are those before. The angle does not jump.
    """
    result = fmpy.simulate_fmu(
        str(fmu),
        fmi_type="ModelExchange",
        solver="CVode",
        stop_time=1.5,
        output_interval=interval,
        relative_tolerance=1e-10,
        start_values=dict(parameters),
        output=list(outputs),
    )
    times, first = np.unique(result["time"], return_index=True)
    assert times[-1] == pytest.approx(1.5)
    return times, {name: result[name][first] for name in outputs}


def fmu_path(folder: Path, parameters: JoystickParameters) -> Path:
    """The FMU with the damping law and the friction of a joystick."""
    return folder / f"{fmu_of_joystick(parameters)}.fmu"


def fmu_parameters(parameters: JoystickParameters, theta_start: float) -> dict[str, float]:
    """What has to be set in an FMU for a joystick that is released at an angle (rad)."""
    values = parameters.to_names() | {"theta_start": theta_start}
    return {name: value for name, value in values.items() if name != "damping.beta"}
