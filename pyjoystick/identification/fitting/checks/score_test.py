"""Score test: which missing parameter would explain the residuals."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import stats

from pyjoystick.identification.fitting.checks.suspect import Suspect
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.support import FloatArray

#: A column that the variables imitate up to this part of it cannot be distinguished from them.
DISTINCT: Final = 1e-2
#: Suspects whose evidence is this close to the best are also listed, up to this many.
_ALIKE: Final = 6.0
_NAMED: Final = 2


@dataclass(frozen=True, slots=True)
class Finding:
    """What a suspect explains.

    Attributes:
        name: name of the suspect
        size: its size, as part of a sentence; may be empty
        explained: part of the sum of squares that it would remove, to first order
        evidence: decrease of Schwarz's criterion (BIC)
        chance: probability that noise alone explains as much, for this suspect and its alternatives
        usual: whether the suspect is tested at a level of its own
    """

    name: str
    size: str
    explained: float
    evidence: float
    chance: float
    usual: bool = False

    def __str__(self) -> str:
        return f"{self.name} ({self.size})" if self.size else self.name


def score_test(
    problem: Problem, residuals: FloatArray, jacobian: FloatArray, found: Iterable[Suspect]
) -> list[Finding]:
    """Test the suspects that can be distinguished from the fitted variables.

    Args:
        problem: provides the weights and correlations that make columns comparable with residuals
        residuals: weighted data minus prediction, and those of prior knowledge, shape (terms,)
        jacobian: of the weighted predictions and of prior knowledge, shape (terms, variables)
        found: the suspects
    """
    basis = column_space(jacobian)
    left = residuals - basis @ (basis.T @ residuals)
    total = float(left @ left)
    freedom = max(problem.terms - basis.shape[1], 2)
    best: dict[str, Finding] = {}
    for suspect in found:
        one = _tested(problem, suspect, left, basis, total, freedom)
        if one is not None and (suspect.name not in best or one.evidence > best[suspect.name].evidence):
            best[suspect.name] = one
    return list(best.values())


def column_space(jacobian: FloatArray) -> FloatArray:
    """Orthonormal columns that span those of the Jacobian."""
    lengths = np.linalg.norm(jacobian, axis=0)
    columns = jacobian[:, lengths > 0.0] / lengths[lengths > 0.0]
    basis, values, _ = np.linalg.svd(columns, full_matrices=False)
    return np.asarray(basis[:, values > 1e-8 * max(values, default=0.0)])


def _tested(
    problem: Problem, suspect: Suspect, left: FloatArray, basis: FloatArray, total: float, freedom: int
) -> Finding | None:
    """Test one suspect: None if the variables imitate it; explains nothing if its size makes no sense."""
    counted = [problem.noise.counted(own, k) for k, own in enumerate(suspect.columns)]
    columns = _side_by_side(counted) if suspect.own else np.concatenate(counted)
    # Prior knowledge does not depend on the suspect.
    columns = np.pad(columns, ((0, len(left) - len(columns)), (0, 0)))
    lengths = np.linalg.norm(columns, axis=0)
    if not np.all(np.isfinite(lengths)) or not lengths.any():
        return None
    columns, kept = columns[:, lengths > 0.0] / lengths[lengths > 0.0], lengths > 0.0
    rest = columns - basis @ (basis.T @ columns)
    rest -= basis @ (basis.T @ rest)
    left_basis, values, right = np.linalg.svd(rest, full_matrices=False)
    distinct = values > DISTINCT
    rank = int(np.count_nonzero(distinct))
    if rank == 0:
        return None
    parts = left_basis[:, distinct].T @ left
    explained = float(parts @ parts)
    sizes = np.zeros(len(lengths))
    sizes[kept] = (right[distinct].T @ (parts / values[distinct])) / lengths[kept]
    if suspect.one_sided and sizes[0] <= 0.0:
        return Finding(suspect.name, "", 0.0, -math.inf, 1.0)
    ratio = (explained / rank) / max((total - explained) / max(freedom - rank, 1), 1e-300)
    chance = float(stats.f.sf(ratio, rank, max(freedom - rank, 1))) * suspect.alternatives
    size = suspect.says(sizes) if rank == columns.shape[1] or suspect.own else ""
    part = min(explained / total, 1.0 - 1e-12) if total > 0.0 else 0.0
    evidence = -(freedom + basis.shape[1]) * math.log1p(-part) - rank * math.log(problem.size)
    return Finding(suspect.name, size, part, evidence, min(chance, 1.0), suspect.usual)


def _side_by_side(blocks: Sequence[FloatArray]) -> FloatArray:
    """Block-diagonal arrangement: separate columns for each block."""
    rows, wide = sum(len(one) for one in blocks), blocks[0].shape[1]
    found = np.zeros((rows, wide * len(blocks)))
    row = 0
    for k, one in enumerate(blocks):
        found[row : row + len(one), wide * k : wide * (k + 1)] = one
        row += len(one)
    return found


def significant(findings: Sequence[Finding], level: float) -> list[Finding]:
    """Findings significant at this rate of false alarms per fit.

    The rate is for all suspects together, and once more for each usual one, which would hide among them. Half
    of all noise has the sign that a usual suspect cannot have.
    """
    tried = sum(one.explained > 0.0 and not one.usual for one in findings)
    return [one for one in findings if one.chance * (0.5 if one.usual else tried) < level]


def explanation(findings: Sequence[Finding]) -> str:
    """Sentence about the findings that explain the residuals best; the best one is first."""
    best, *others = findings
    part = f"{100.0 * best.explained:.0f} %" if best.explained >= 0.005 else "less than 1 %"
    text = f"{best} would explain them best, {part} of their sum of squares"
    alike = [str(one) for one in others if one.evidence >= best.evidence - _ALIKE][:_NAMED]
    if alike:
        text += f"; the records hardly tell it from {' or '.join(alike)}"
    return text
