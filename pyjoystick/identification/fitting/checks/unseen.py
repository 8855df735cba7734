"""What a fit that passes may still hide: effects too small for the score test, and the bias they cause."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, NamedTuple

import numpy as np
from scipy import stats

from pyjoystick.identification.fitting.checks.score_test import DISTINCT, column_space
from pyjoystick.identification.fitting.checks.suspect import Suspect
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.support import FloatArray

#: Power: the test detects the reported size in this part of all sets of records.
_POWER: Final = 0.9
#: Shifts below this many standard errors are covered by the interval.
_NOTED: Final = 3.0


class Unseen(NamedTuple):
    """A suspect at the size that the test detects nine times in ten; smaller ones shift less but pass more.

    Attributes:
        suspect: its name
        size: its size as text
        parameter: shared parameter that it shifts most, in standard errors
        part: relative shift of the value
        errors: shift in standard errors
    """

    suspect: str
    size: str
    parameter: str
    part: float
    errors: float


def unseen(
    problem: Problem,
    x: FloatArray,
    jacobian: FloatArray,
    found: Iterable[Suspect],
    level: float,
    usual: float,
) -> list[Unseen]:
    """Suspects (of one size in all records) that can go unseen and bias a parameter beyond its interval.

    To first order in the size: a column that the variables imitate except for a residue of length r (in
    standard deviations of the noise) is detected at z/r, where z is the sum of the normal quantiles of level
    and power. The imitated part shifts the variables as in any linear fit.

    Args:
        problem: provides the weights that make columns comparable with the noise
        x: the minimum
        jacobian: of the weighted predictions and of prior knowledge, shape (terms, variables)
        found: the suspects
        level: false-alarm probability of the test for one suspect
        usual: the same for a usual suspect, of either sign
    """
    basis = column_space(jacobian)
    lengths = np.linalg.norm(jacobian, axis=0)
    solve = np.linalg.pinv(jacobian / np.where(lengths > 0.0, lengths, 1.0))
    errors = np.linalg.norm(solve, axis=1)  # of the variables, times the column lengths
    shared = [j for j, one in enumerate(problem.variables.free) if one.record is None and lengths[j] > 0.0]
    quantiles = stats.norm.isf(0.5 * np.array([level, usual])) + stats.norm.ppf(_POWER)
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
        size = float(quantiles[int(suspect.usual)]) / rest
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
