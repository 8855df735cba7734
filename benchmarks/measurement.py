"""Time all contenders in turns, A B C A B C ..., so that a busy machine slows all of them equally."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from benchmarks.contender import Contender


@dataclass(frozen=True, slots=True)
class Row:
    """A measured contender.

    Attributes:
        name: its name in the table
        tolerance: tolerance of its integrator
        milliseconds: time of a run (ms), median over the rounds
        ratio: that time divided by the yardstick's in the same round, median over the rounds
        ratio_spread: first and third quartile of that ratio
        ratio_to_second: the same relative to the second contender
        ratio_to_third: the same relative to the third contender
        error: largest error of theta (rad)
        evaluations: of the equation of motion; None if unknown
    """

    name: str
    tolerance: float
    milliseconds: float
    ratio: float
    ratio_spread: tuple[float, float]
    ratio_to_second: float
    ratio_to_third: float
    error: float
    evaluations: int | None


def measure(contenders: Sequence[Contender], rounds: int, on_round: Callable[[], None]) -> list[Row]:
    """Return the rows in the order of `contenders`, of which the first is the yardstick.

    Args:
        contenders: three or more
        rounds: 2 or more; each contender is timed once per round
        on_round: called after every round
    """
    times: list[list[float]] = []
    for _ in range(rounds):
        times.append([contender.seconds() for contender in contenders])
        on_round()
    rows = []
    for i, contender in enumerate(contenders):
        ratios = [of_round[i] / of_round[0] for of_round in times]
        quartiles = statistics.quantiles(ratios, n=4, method="inclusive")
        rows.append(
            Row(
                name=contender.name,
                tolerance=contender.tolerance,
                milliseconds=1e3 * statistics.median(of_round[i] for of_round in times),
                ratio=statistics.median(ratios),
                ratio_spread=(quartiles[0], quartiles[2]),
                ratio_to_second=statistics.median(of_round[i] / of_round[1] for of_round in times),
                ratio_to_third=statistics.median(of_round[i] / of_round[2] for of_round in times),
                error=contender.error(),
                evaluations=contender.evaluations,
            )
        )
    return rows
