"""Coupling errors relative to the same system as one model, over communication steps and schemes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu
from pyjoystick.runs.coupling.master import run_coupled
from pyjoystick.runs.coupling.schemes import SCHEMES
from pyjoystick.runs.coupling.system import CoupledSystem
from pyjoystick.support import FloatArray

#: Tolerance of the FMUs in such runs, tight so that their own errors do not matter.
_TOLERANCE = 1e-10


def coupling_errors(
    system: CoupledSystem,
    variable: str,
    *,
    monolithic: Fmu,
    steps: Sequence[float] = (2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4),
) -> pd.DataFrame:
    """Largest coupling error of a variable at the communication points, for each of the `SCHEMES`.

    Args:
        system: the system of FMUs
        variable: variable to compare, ``component.variable``
        monolithic: FMU of the same system as one model, in which the variable has the same name
        steps: communication steps (s)

    Returns:
        a row for each scheme and step with ``scheme``, ``step`` (s), ``error`` (unit of the variable) and
        ``fmu_steps``, the total number of FMU steps

    Raises:
        as `run_coupled` and `Fmu.run`
    """
    rows = []
    for scheme in SCHEMES:
        for step in steps:
            run = run_coupled(system, step=step, scheme=scheme, outputs=[variable], tolerance=_TOLERANCE)
            exact = monolithic.run(np.asarray(run.index), outputs=[variable], tolerance=_TOLERANCE)
            error = float(np.abs(run[variable] - exact[variable]).max())
            rows.append((scheme, step, error, run.attrs["steps"]))
    return pd.DataFrame(rows, columns=["scheme", "step", "error", "fmu_steps"])


def orders(errors: pd.DataFrame) -> dict[str, float]:
    """Order of each scheme: log-log slope of the error over the two shortest steps."""
    found = {}
    for scheme, rows in errors.groupby("scheme", sort=False):
        short: FloatArray = rows.nsmallest(2, "step")[["step", "error"]].to_numpy()
        (step, error), (longer, larger) = short
        found[str(scheme)] = float(np.log(larger / error) / np.log(longer / step))
    return found
