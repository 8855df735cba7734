"""Sampling of the runs: one row of parameter values per run."""

from __future__ import annotations

import hashlib
import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal, get_args

import numpy as np
import pandas as pd
from scipy.stats import qmc

from pyjoystick.runs.sweeps.variations import MOST_RUNS, Levels, Variation
from pyjoystick.support import FloatArray, ParameterError

Method = Literal["grid", "random", "latin-hypercube", "sobol", "saltelli"]
METHODS: Final = get_args(Method)
#: Methods whose `count` must be a power of two, for the balance of Sobol sequences.
POWERS_OF_TWO: Final = ("sobol", "saltelli")


@dataclass(frozen=True, slots=True)
class Sampling:
    """How to choose the runs.

    Attributes:
        method: ``grid``: every combination of the levels. ``random``, ``latin-hypercube``, ``sobol``: `count`
            runs from the distributions. ``saltelli``: the design for sensitivity indices (Saltelli et al.,
            Comput. Phys. Commun. 181 (2010) 259-270), `count` * (parameters + 2) runs.
        count: number of samples; not used by ``grid``
        seed: seed of the samples; the same seed gives the same runs
    """

    method: Method
    count: int = 0
    seed: int = 0

    def runs(self, varied: Mapping[str, Variation]) -> int:
        """Number of runs."""
        if self.method == "grid":
            return math.prod(len(one.values) for one in varied.values() if isinstance(one, Levels))
        return self.count * (len(varied) + 2) if self.method == "saltelli" else self.count

    def check(self, varied: Mapping[str, Variation]) -> None:
        """Raise ParameterError if the method does not suit the parameters, or there are too many runs."""
        method, count = self.method, self.count
        if method == "grid":
            for name, variation in varied.items():
                if not isinstance(variation, Levels):
                    raise ParameterError(
                        name, "a distribution", "levels (values, or from/to/count) on a grid"
                    )
        elif count < 1:
            raise ParameterError("count", count, "1 or more")
        if method in POWERS_OF_TWO and count & (count - 1):
            near = 2 ** round(math.log2(count))
            raise ParameterError("count", count, f"a power of two for method {method}", f"such as {near}")
        if method == "saltelli" and (len(varied) < 2 or count < 2):
            raise ParameterError("method", method, "used with 2 parameters and a count of 2, or more")
        if self.runs(varied) > MOST_RUNS:
            raise ParameterError("runs", self.runs(varied), f"{MOST_RUNS} at most")


def design(varied: Mapping[str, Variation], sampling: Sampling) -> pd.DataFrame:
    """Parameters of every run, shape [runs, varied], indexed by ``run`` = 0, 1, ...

    In a grid, the last parameter changes fastest. A ``saltelli`` design consists of the matrix A, then B,
    then, for each parameter, A with the column of that parameter from B; `sampling.count` rows each.

    Args:
        varied: how each parameter varies, one or more; `Levels` for a grid
        sampling: the method

    Raises:
        ParameterError: the design does not suit the parameters, or has more than `MOST_RUNS` runs
    """
    sampling.check(varied)
    if sampling.method == "grid":
        levels = [one.values for one in varied.values() if isinstance(one, Levels)]
        columns = {
            name: pd.Series(column).to_numpy()
            for name, column in zip(varied, zip(*itertools.product(*levels), strict=True), strict=True)
        }
    else:
        probabilities = _probabilities(len(varied), sampling)
        columns = {
            name: variation.quantile(probability)
            for (name, variation), probability in zip(varied.items(), probabilities.T, strict=True)
        }
    return pd.DataFrame(columns).rename_axis("run")


def digest(table: pd.DataFrame) -> str:
    """SHA-256 of the values of a design, in hexadecimal."""
    total = hashlib.sha256()
    for name in table:
        column = np.ascontiguousarray(table[name].to_numpy())
        total.update(f"{name}:{column.dtype.str}:{column.size};".encode())
        total.update(repr(column.tolist()).encode() if column.dtype == object else column.tobytes())
    return total.hexdigest()


def _probabilities(parameters: int, sampling: Sampling) -> FloatArray:
    """Samples of the unit cube, shape [runs, parameters]."""
    count, seed = sampling.count, sampling.seed
    match sampling.method:
        case "latin-hypercube":
            return qmc.LatinHypercube(parameters, rng=seed).random(count)
        case "sobol":
            return qmc.Sobol(parameters, rng=seed, bits=64).random(count)
        case "saltelli":
            pair = qmc.Sobol(2 * parameters, rng=seed, bits=64).random(count)
            a, b = pair[:, :parameters], pair[:, parameters:]
            mixed = [a.copy() for _ in range(parameters)]
            for i, one in enumerate(mixed):
                one[:, i] = b[:, i]
            return np.concatenate([a, b, *mixed])
        case _:
            return np.random.default_rng(seed).random((count, parameters))
