"""How far a coupled run is from the same system as one model, over communication steps and schemes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu
from pyjoystick.runs.coupling.master import run_coupled
from pyjoystick.runs.coupling.schemes import SCHEMES
from pyjoystick.runs.coupling.system import CoupledSystem
from pyjoystick.support import FloatArray

#: Of the FMUs in such runs, so that their own errors do not count.
_TOLERANCE = 1e-10


def coupling_errors(
    system: CoupledSystem,
    variable: str,
    *,
    monolithic: Fmu,
    steps: Sequence[float] = (2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4),
) -> pd.DataFrame:
    """The largest coupling error of a variable at the communication points, by each of the `SCHEMES`.

    Args:
        system: as FMUs
        variable: what is compared, ``component.variable``
        monolithic: the FMU of the same system as one model, in which the variable has the same name
        steps: communication steps (s)

    Returns:
        a row for each scheme and step with ``scheme``, ``step`` (s), ``error`` (unit of the variable) and
        ``fmu_steps``, how often FMUs were stepped in all

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
    """The order of each scheme: slope of the error over the two shortest steps, logarithmically."""
    found = {}
    for scheme, rows in errors.groupby("scheme", sort=False):
        short: FloatArray = rows.nsmallest(2, "step")[["step", "error"]].to_numpy()
        (step, error), (longer, larger) = short
        found[str(scheme)] = float(np.log(larger / error) / np.log(longer / step))
    return found
