"""The best choice among experiments: by the determinant of the information, or for one parameter."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pyjoystick.identification.design.experiment import Information
from pyjoystick.identification.errors import FitError
from pyjoystick.support import FloatArray, ParameterError, whole_number

#: Beside the information, in parts of its mean: so that a choice can begin, and no more.
_RIDGE: Final = 1e-12
#: A choice is exchanged for one that is better by this much, relative.
_GAIN: Final = 1e-9
#: A parameter whose standard error, relative to its value, is beyond this is not determined.
_UNKNOWN: Final = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class Design:
    """A choice of experiments, and how well it determines the parameters.

    Attributes:
        informations: what could be chosen
        counts: how often each is made, shape (experiments,)
        prior: what is known of the parameters beforehand, as information, shape (parameters, parameters)
        names: the parameters
        values: theirs, in the units of the FMU
    """

    informations: tuple[Information, ...]
    counts: NDArray[np.intp]
    prior: FloatArray

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters that all records share."""
        return self.informations[0].names

    @property
    def values(self) -> FloatArray:
        """Their values, in the units of the FMU, shape (parameters,)."""
        return self.informations[0].values

    @property
    def covariance(self) -> FloatArray:
        """Of the parameters after these experiments, shape (parameters, parameters)."""
        whole = self.prior + sum(
            count * one.matrix for count, one in zip(self.counts, self.informations, strict=True)
        )
        return _inverse(whole, self.values)

    @property
    def errors(self) -> FloatArray:
        """Standard errors, in the units of the FMU, shape (parameters,)."""
        return np.sqrt(np.diag(self.covariance))

    def with_counts(self, counts: Sequence[int] | NDArray[np.intp]) -> Design:
        """Another choice among the same experiments."""
        return Design(self.informations, np.asarray(counts, dtype=np.intp), self.prior)


def best_design(
    informations: Sequence[Information],
    count: int,
    *,
    determine: str | None = None,
    uncertainties: Mapping[str, float] | None = None,
) -> Design:
    """The best `count` experiments, each as often as it pays: Fedorov's exchange, from each of them on.

    Args:
        informations: of each experiment, see `PlannedFit.information`
        count: number of records
        determine: the parameter whose standard error is to be smallest; where None, the volume of the
            ellipsoid of all of them (D-optimal)
        uncertainties: standard uncertainties of parameters that are known beforehand, in the units of the FMU

    Raises:
        ParameterError: there is nothing to choose from, or no parameter of that name
        FitError: not even the best choice determines every parameter
    """
    whole_number("count", count, 1)
    if not informations:
        raise ParameterError("experiments", "none", "one or more")
    names, values = informations[0].names, informations[0].values
    if determine is not None and determine not in names:
        raise ParameterError("determine", determine, f"one of {', '.join(names)}")
    known = uncertainties or {}
    prior = np.diag([known[name] ** -2.0 if known.get(name, 0.0) > 0.0 else 0.0 for name in names])
    scale = _scale(values)
    matrices = [one.matrix * scale * scale[:, np.newaxis] for one in informations]
    ridge = _RIDGE * max(float(np.mean([np.trace(one) for one in matrices])), 1e-300)
    start = prior * scale * scale[:, np.newaxis] + ridge * np.eye(len(names))
    place = None if determine is None else names.index(determine)
    chosen = _exchanged(matrices, start, count, lambda whole: _loss(whole, place))
    counts = np.bincount(chosen, minlength=len(matrices))
    design = Design(tuple(informations), counts, prior)
    _require_determined(design, determine)
    return design


def _exchanged(
    matrices: Sequence[FloatArray], start: FloatArray, count: int, loss: Callable[[FloatArray], float]
) -> list[int]:
    """Indices of the experiments whose information has the least loss."""
    choices = [_from(first, matrices, start, count, loss) for first in range(len(matrices))]
    return min(choices, key=lambda chosen: loss(start + sum(matrices[k] for k in chosen)))


def _from(
    first: int,
    matrices: Sequence[FloatArray],
    start: FloatArray,
    count: int,
    loss: Callable[[FloatArray], float],
) -> list[int]:
    """A greedy choice that begins with one experiment, improved by exchanging one at a time."""
    chosen = [first]
    whole = start + matrices[first]
    for _ in range(count - 1):
        best = min(range(len(matrices)), key=lambda k: loss(whole + matrices[k]))
        chosen.append(best)
        whole = whole + matrices[best]
    improved = True
    while improved:
        improved = False
        for i, old in enumerate(chosen):
            without = start + sum((matrices[k] for j, k in enumerate(chosen) if j != i), np.zeros_like(start))
            before = loss(without + matrices[old])
            best = min(range(len(matrices)), key=lambda k: loss(without + matrices[k]))
            if loss(without + matrices[best]) < before - _GAIN * abs(before):
                chosen[i], improved = best, True
    return sorted(chosen)


def _loss(whole: FloatArray, place: int | None) -> float:
    """What is to be least: minus the logarithm of the determinant, or of the information on one parameter."""
    if place is None:
        return -float(np.linalg.slogdet(whole)[1])
    return float(np.log(np.linalg.inv(whole)[place, place]))


def _require_determined(design: Design, determine: str | None) -> None:
    relative = design.errors / _scale(design.values)
    wanted = design.names if determine is None else (determine,)
    unknown = [name for name in wanted if not relative[design.names.index(name)] < _UNKNOWN]
    if unknown:
        raise FitError(
            "experiments",
            f"not even the best of them determine {', '.join(unknown)}: offer others, fix what is known, or "
            "state its uncertainty",
        )


def _scale(values: FloatArray) -> FloatArray:
    return np.where(values != 0.0, np.abs(values), 1.0)


def _inverse(matrix: FloatArray, values: FloatArray) -> FloatArray:
    """The inverse in the units of the values; variances are infinite where nothing is known."""
    scale = _scale(values)
    sizes, axes = np.linalg.eigh(matrix * scale * scale[:, np.newaxis])
    largest = float(np.max(sizes))
    if largest <= 0.0:
        return np.diag(np.full(len(values), np.inf))
    inverse = (axes / np.maximum(sizes, largest * 1e-15)) @ axes.T
    return np.asarray(inverse * scale * scale[:, np.newaxis])
