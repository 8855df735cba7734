"""One way to compute the free oscillation, and the tolerance at which it is as accurate as another."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from benchmarks.task import RELEASES, Law, error
from pyjoystick.support import FloatArray


@dataclass(frozen=True, slots=True)
class Contender:
    """A row of the table.

    Attributes:
        name: what it is
        law: damping law
        tolerance: what its integrator is asked to keep
        theta: from the release (rad) to the angle (rad) at equal intervals over the run, shape (n + 1,)
        seconds: time of one run from `RELEASE` (s), the median of a small batch; raises BenchmarkError where
            the result is not that of `theta`
        evaluations: number of evaluations of the equation of motion in that run, None where not known
    """

    name: str
    law: Law
    tolerance: float
    theta: Callable[[float], FloatArray]
    seconds: Callable[[], float]
    evaluations: int | None

    def error(self) -> float:
        """Largest error of theta (rad) over all samples of all `RELEASES`."""
        return max(error(self.law, release, self.theta(release)) for release in RELEASES)


def as_accurate(
    contender: Callable[[float], Contender], target: float, start: float, ratio: float
) -> Contender:
    """The contender at the loosest of the tolerances start, start/ratio, ... that meets the error `target`.

    Below 1e-13 the tolerance is at the rounding of the numbers; the last one is then taken, and its error,
    which is printed, shows that it falls short.

    Args:
        contender: from a tolerance to the contender
        target: error of theta (rad) that it may have
        start: first tolerance to try
        ratio: above 1
    """
    tolerance = start
    while True:
        candidate = contender(tolerance)
        if candidate.error() <= target or tolerance / ratio < 1e-13:
            return candidate
        tolerance /= ratio
