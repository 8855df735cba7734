"""What a fit that passes may still hide: sizes that its score test would miss, and what they move."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, NamedTuple

import numpy as np
from scipy import stats

from pyjoystick.identification.fitting.checks.score_test import DISTINCT, column_space
from pyjoystick.identification.fitting.checks.suspect import Suspect
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.support import FloatArray

#: The test sees a size in this part of all sets of records.
_POWER: Final = 0.9
#: Shifts of fewer standard errors than this are in the interval as it is.
_NOTED: Final = 3.0


class Unseen(NamedTuple):
    """A suspect at the size that the test sees nine times in ten; a smaller one moves less, and passes more.

    Attributes:
        suspect: its name
        size: in words
        parameter: which of the values that all records share it moves most, in standard errors
        part: by what part of the value
        errors: by how many standard errors
    """

    suspect: str
    size: str
    parameter: str
    part: float
    errors: float


def unseen(
    problem: Problem, x: FloatArray, jacobian: FloatArray, found: Iterable[Suspect], level: float
) -> list[Unseen]:
    """The suspects of one size in all records, where what the test misses is more than the intervals say.

    To first order in the size: a column that the variables imitate but for a rest of length r (in standard
    deviations of the noise) is seen at z/r, where z is the normal quantile of the test and its power; the
    variables move by the rest of the column, as in any linear fit.

    Args:
        problem: its weights make the columns comparable with the noise
        x: the minimum
        jacobian: of the predictions as they count, and of what is known, shape (terms, variables)
        found: the suspects
        level: chance of the test for one suspect to be called out by noise
    """
    basis = column_space(jacobian)
    lengths = np.linalg.norm(jacobian, axis=0)
    solve = np.linalg.pinv(jacobian / np.where(lengths > 0.0, lengths, 1.0))
    errors = np.linalg.norm(solve, axis=1)  # of the variables times their lengths
    shared = [j for j, one in enumerate(problem.variables.free) if one.record is None and lengths[j] > 0.0]
    quantile = float(stats.norm.isf(0.5 * level) + stats.norm.ppf(_POWER))
    missed = []
    for suspect in found if shared else ():
        if suspect.own or suspect.alternatives > 1 or suspect.columns[0].shape[1] > 1:
            continue
        counted = np.concatenate([problem.noise.counted(own, k) for k, own in enumerate(suspect.columns)])[
            :, 0
        ]
        column = np.pad(counted, (0, len(jacobian) - len(counted)))
        rest = float(np.linalg.norm(column - basis @ (basis.T @ column)))
        if rest <= DISTINCT * float(np.linalg.norm(column)):
            continue
        size = quantile / rest
        moved = size * (solve @ column)
        worst = max(shared, key=lambda j: abs(moved[j]) / errors[j])
        if abs(moved[worst]) > _NOTED * errors[worst] and x[worst]:
            missed.append(
                Unseen(
                    suspect.name,
                    suspect.says(np.array([size])),
                    problem.variables.free[worst].name,
                    abs(moved[worst] / lengths[worst] / x[worst]),
                    abs(moved[worst]) / errors[worst],
                )
            )
    return sorted(missed, key=lambda one: -one.errors)
