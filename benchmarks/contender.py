"""One method of computing the free oscillation, and the tolerance at which it is as accurate as another."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from benchmarks.task import RELEASES, Law, error
from pyjoystick.support import FloatArray


@dataclass(frozen=True, slots=True)
class Contender:
    """A row of the table.

    Attributes:
        name: its name in the table
        law: damping law
        tolerance: tolerance of its integrator
        theta: maps the release (rad) to angles (rad) at equal intervals over the run, shape (n + 1,)
        seconds: time of one run from `RELEASE` (s), the median of a small batch; raises BenchmarkError if the
            result differs from `theta`
        evaluations: evaluations of the equation of motion in that run; None if unknown
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
    """Return the contender with the loosest tolerance start, start/ratio, ... that meets `target`.

    Below 1e-13 tolerances are at rounding level; the last one is then used, and the printed error shows that
    it misses the target.

    Args:
        contender: maps a tolerance to the contender
        target: allowed error of theta (rad)
        start: first tolerance to try
        ratio: above 1
    """
    tolerance = start
    while True:
        candidate = contender(tolerance)
        if candidate.error() <= target or tolerance / ratio < 1e-13:
            return candidate
        tolerance /= ratio
