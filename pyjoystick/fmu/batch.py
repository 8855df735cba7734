"""The result of many runs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pyjoystick._types import FloatArray


@dataclass(frozen=True, slots=True)
class BatchResult:
    """Many runs of one plan, one row a run in the order of the table that was given.

    Attributes:
        parameters: what was varied, one column a name; its index is that of the table that was given
        values: samples, shape (runs, samples, variables), NaN in runs that failed or were not done; None
            where the runs were reduced
        reduced: what the reductions kept, one column each, indexed as `parameters`, NaN as in `values`; its
            ``attrs["units"]`` has the unit of each column. None where there are no reductions.
        messages: empty for a sound run, else why and when it failed and what the FMU said
        failed: shape (runs,), True for runs that were begun and could not be carried to their end
        done: shape (runs,), True for runs that came to an end, failed ones included
        interrupted: the batch was stopped before every run was done
    """

    parameters: pd.DataFrame
    values: FloatArray | None
    reduced: pd.DataFrame | None
    messages: list[str]
    failed: NDArray[np.bool_]
    done: NDArray[np.bool_]
    interrupted: bool
