"""One run of an experiment through either interface, each on a fresh instance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import pandas as pd

from pyjoystick.fmu import Fmu, Interface, run_model_exchange
from pyjoystick.runs.fmu_comparison.experiments import Experiment
from pyjoystick.support import DEFAULT_TOLERANCE

#: Tolerance of CVode in Model Exchange.
CVODE_TOLERANCE: Final = 1e-10


@dataclass(frozen=True, slots=True)
class Tolerances:
    """What integrators are asked to keep.

    Attributes:
        co_simulation: those inside the FMUs
        model_exchange: CVode
    """

    co_simulation: float = DEFAULT_TOLERANCE
    model_exchange: float = CVODE_TOLERANCE


def run(
    fmu: Path, interface: Interface, experiment: Experiment, outputs: Sequence[str], tolerances: Tolerances
) -> pd.DataFrame:
    """Put an FMU through an experiment; in Co-Simulation the instants are the communication points.

    Raises:
        UnknownNameError, ParameterError, SeriesError: the FMU does not take the experiment
        FmuFileError, UnsupportedFmuError: the FMU cannot be loaded, or lacks the interface
        SimulationError: the FMU refuses its settings, fails or ends the run by itself
    """
    if interface == "ModelExchange":
        return run_model_exchange(
            fmu,
            experiment.time,
            parameters=experiment.parameters,
            inputs=experiment.inputs,
            outputs=outputs,
            tolerance=tolerances.model_exchange,
        )
    with Fmu(fmu) as opened:
        return opened.run(
            experiment.time,
            parameters=experiment.parameters,
            inputs=experiment.inputs,
            outputs=outputs,
            tolerance=tolerances.co_simulation,
        )
