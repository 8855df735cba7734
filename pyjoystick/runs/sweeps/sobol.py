"""Sobol indices: contributions of parameters to the variance of results."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Literal

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import bootstrap, sobol_indices

from pyjoystick.runs.errors import SensitivityError
from pyjoystick.support import FloatArray, UnknownVariableError

#: Number of bootstrap resamples, and the seed that makes the intervals reproducible.
_RESAMPLES: Final = 999
_SEED: Final = 20040701
#: The squares of larger results overflow.
_LARGEST: Final = 1e150
_Matrix = Literal["f_A", "f_B", "f_AB"]
_NOT_RESULTS: Final = ("failed", "message")


def sensitivity(
    table: pd.DataFrame, results: Sequence[str] | None = None, *, confidence: float = 0.95
) -> pd.DataFrame:
    """First-order and total Sobol indices of the results of a ``saltelli`` sweep, with confidence intervals.

    The first-order index is the part of the variance that a parameter explains alone, the total index the
    part to which it contributes. The estimators are those of Saltelli et al. (Comput. Phys. Commun. 181
    (2010) 259-270), as implemented in SciPy; the intervals are bootstrap percentiles with a fixed seed.
    Indices below 0 or above 1 by less than their interval are due to chance.

    Args:
        table: from `read_sweep`
        results: names of result columns; by default all that have an index
        confidence: confidence level of the intervals, between 0 and 1

    Returns:
        a table with the columns ``result``, ``parameter``, ``first``, ``first_low``, ``first_high``,
        ``total``, ``total_low``, ``total_high``; ``attrs["left_out"]`` explains by name why a result has none

    Raises:
        SensitivityError: the design is another; a run failed, is missing or there twice; or a requested
            result has no indices because it is missing in some run, too large, or constant
        UnknownVariableError: there is no result of that name
    """
    parameters, found = _columns(table)
    table = table.sort_index()
    samples = _samples(table, len(parameters))
    for name in results or ():
        if name not in found:
            raise UnknownVariableError(name, found)
    frames, left_out = [], {}
    for name in results or found:
        values = table[name].to_numpy(dtype=np.float64)
        reason = _why_not(values)
        if reason:
            left_out[name] = reason
            continue
        indices = _indices(values.reshape(len(parameters) + 2, samples), confidence)
        frames.append(indices.assign(result=name, parameter=parameters))
    if not frames or (results and left_out):
        raise SensitivityError("; ".join(f"{name} {reason}" for name, reason in left_out.items()))
    whole = pd.concat(frames, ignore_index=True)
    whole = whole[["result", "parameter", *(one for one in whole if one not in ("result", "parameter"))]]
    whole.attrs["left_out"] = left_out
    return whole


def _columns(table: pd.DataFrame) -> tuple[list[str], list[str]]:
    """Names of the varied parameters and of the results."""
    settings = table.attrs["sweep"]["settings"]
    parameters = list(settings["vary"])
    return parameters, [str(name) for name in table if name not in (*parameters, *_NOT_RESULTS)]


def _samples(table: pd.DataFrame, parameters: int) -> int:
    method = table.attrs["sweep"]["settings"]["sampling"]["method"]
    if method != "saltelli":
        raise SensitivityError(f"Sobol indices need a sweep with method saltelli, this one has {method}")
    failed = int(table["failed"].sum())
    if failed:
        raise SensitivityError(
            f"{failed} of {len(table)} runs failed; indices without them would be of another distribution. "
            "Choose narrower ranges of the parameters"
        )
    if table.index.tolist() != list(range(table.attrs["sweep"]["runs"])):
        raise SensitivityError("Sobol indices need all runs of the sweep, each once, by their numbers from 0")
    return len(table) // (parameters + 2)


def _why_not(values: FloatArray) -> str:
    missing = int(np.isnan(values).sum())
    if missing:
        return f"is missing in {missing} of {values.size} runs"
    largest = float(np.abs(values).max())
    if largest > _LARGEST:
        return f"is too large for a variance: up to {largest:.3g}"
    return "is the same in all runs" if np.ptp(values) == 0.0 else ""


def _indices(values: FloatArray, confidence: float) -> pd.DataFrame:
    """Indices of one result; `values` has the rows A, B and one per parameter, shape (parameters + 2, n)."""

    def estimate(chosen: NDArray[np.intp]) -> FloatArray:
        """Indices, shape (2, parameters): first order and total."""
        drawn = values[:, chosen]
        func: dict[_Matrix, FloatArray] = {"f_A": drawn[:1], "f_B": drawn[1:2], "f_AB": drawn[2:, np.newaxis]}
        found = sobol_indices(func=func, n=chosen.size)
        return np.stack([found.first_order, found.total_order])

    everything = np.arange(values.shape[1])
    first, total = estimate(everything)
    spread = bootstrap(
        (everything,),
        estimate,
        vectorized=False,
        n_resamples=_RESAMPLES,
        confidence_level=confidence,
        method="percentile",
        rng=_SEED,
    ).confidence_interval
    low, high = np.asarray(spread.low), np.asarray(spread.high)
    return pd.DataFrame(
        {
            "first": first,
            "first_low": low[0],
            "first_high": high[0],
            "total": total,
            "total_low": low[1],
            "total_high": high[1],
        }
    )
