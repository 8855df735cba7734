"""Continuation of periodic solutions over a parameter, by pseudo-arclength.

Keller's method: predict along the tangent of the branch, then correct in the plane perpendicular to the
tangent. It passes folds, where the parameter turns back. All lengths are in units of the scales of the states
and of the parameter.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from scipy.optimize import brentq

from pyjoystick.forced_motion.periodic.maps import SmoothMap
from pyjoystick.forced_motion.periodic.solutions import NoSolutionError, PeriodicSolution, correct
from pyjoystick.support import FloatArray

#: Reasons for the end of a branch.
End = Literal["edge of the range", "back at its start", "too many points", "no convergence"]
#: Test functions of the system by name; a sign change marks the event of that name.
Tests = Callable[[PeriodicSolution], Mapping[str, float]]

_GROWTH: Final = 1.4
#: A step is shortened if the tangent turns by more, or the solution is farther from the predicted line (in
#: steps), because it may be on another branch.
_LARGEST_TURN: Final = 0.95
_FARTHEST_ASIDE: Final = 0.3
#: Accuracy of special points along the branch.
_PLACE: Final = 1e-9
#: Distance from a singular point at which the equations are solved instead.
_BESIDE: Final = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class SpecialPoint:
    """A point on a branch where its stability, its direction or the path of its motion changes.

    Attributes:
        kind: ``fold``, ``period doubling``, ``Neimark-Sacker``, ``branch point``, or the name of a test of
            the system
        solution: the solution there
    """

    kind: str
    solution: PeriodicSolution


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """A sequence of solutions along a branch.

    Attributes:
        solutions: in the order in which they were found
        special: special points, in the same order
        end: reason for its end
        reason: why the iteration did not converge at the end; otherwise empty
    """

    solutions: tuple[PeriodicSolution, ...]
    special: tuple[SpecialPoint, ...]
    end: End
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Steps:
    """Step lengths along a branch, in scales.

    Attributes:
        first: first step
        least: minimum; the branch ends where a shorter step would be needed
        most: maximum
        points: largest number of points of a branch
    """

    first: float = 0.02
    least: float = 1e-6
    most: float = 0.1
    points: int = 500


@dataclass(frozen=True, slots=True, eq=False)
class _Node:
    """A solution with data for the next step: its scaled position and the branch's unit tangent there."""

    solution: PeriodicSolution
    place: FloatArray
    tangent: FloatArray
    tests: Mapping[str, float]


class Continuation:
    """Computes branches within a range of the parameter."""

    def __init__(
        self,
        smooth_map: SmoothMap,
        scales: FloatArray,
        limits: tuple[float, float],
        *,
        steps: Steps | None = None,
        tests: Tests | None = None,
    ) -> None:
        """Set what all branches share.

        Args:
            smooth_map: the map over one period
            scales: sizes of the states and, last, of the parameter, shape (n + 1,)
            limits: lowest and highest value of the parameter
            steps: step lengths
            tests: test functions of the system
        """
        self._map = smooth_map
        self._scales = scales
        self._limits = limits
        self._steps = steps or Steps()
        self._tests = tests or (lambda _: {})

    def branch(self, start: PeriodicSolution, direction: FloatArray) -> Branch:
        """Follow the branch from a solution.

        Args:
            start: a solution
            direction: initial direction, in scales, shape (n + 1,); must not be perpendicular to the branch

        Raises:
            NoSolutionError: there is no solution at the first step
        """
        nodes: list[_Node] = []
        special: list[SpecialPoint] = []
        end: End = "too many points"
        reason = ""
        try:
            for node in self._nodes(start, direction):
                if nodes:
                    special += self._special_points(nodes[-1], node)
                nodes.append(node)
                if self._leaves(node):
                    end = "edge of the range"
                    break
                if self._is_back(nodes):
                    end = "back at its start"
                    break
        except NoSolutionError as error:
            if not nodes:
                raise
            end, reason = "no convergence", str(error)
        return Branch(tuple(node.solution for node in nodes), tuple(special), end, reason)

    def beside(self, point: PeriodicSolution, direction: FloatArray) -> PeriodicSolution:
        """Find a solution on the branch that leaves another at a point, as a start for `branch`.

        Args:
            point: the point, such as a period doubling, with a map over twice the period
            direction: direction of the new branch there, in scales, shape (n + 1,)

        Raises:
            NoSolutionError: none is found at the first step
        """
        unit = direction / np.linalg.norm(direction)
        place = np.append(point.state, point.parameter) / self._scales
        return correct(self._map, place + self._steps.first * unit, unit, self._scales)[0]

    def _nodes(self, start: PeriodicSolution, direction: FloatArray) -> Iterator[_Node]:
        place = np.append(start.state, start.parameter) / self._scales
        unit = direction / np.linalg.norm(direction)
        node, _ = self._next(_Node(start, place, unit, {}), 0.0)
        yield node
        step = self._steps.first
        for _ in range(self._steps.points - 1):
            node, step = self._stepped(node, step)
            yield node
            step = min(self._steps.most, _GROWTH * step)

    def _stepped(self, node: _Node, step: float) -> tuple[_Node, float]:
        """The next node and the length of the step, which is as long as convergence and curvature allow.

        Sign changes of tests are passed with short steps: near a grazing, folds may be close together.
        """
        while True:
            try:
                length = self._to_edge(node, step)
                found, cosine = self._next(node, length)
                aside = np.linalg.norm(found.place - node.place - length * node.tangent)
                is_near = cosine > _LARGEST_TURN and aside < _FARTHEST_ASIDE * length
                if is_near and (step <= self._steps.first or not _differ(node, found)):
                    return found, step
                refusal = NoSolutionError(node.solution.parameter, "the branch turns too sharply")
            except NoSolutionError as error:
                refusal = error
            step *= 0.5
            if step < self._steps.least:
                raise refusal

    def _leaves(self, node: _Node) -> bool:
        """Whether the node is at an edge of the range and the branch leads out."""
        low, high = self._limits
        value, rate = node.solution.parameter, node.tangent[-1]
        return bool((value <= low and rate < 0.0) or (value >= high and rate > 0.0))

    def _to_edge(self, node: _Node, step: float) -> float:
        """A step that does not lead far beyond the range."""
        rate = node.tangent[-1] * self._scales[-1]
        edge = self._limits[1 if rate > 0.0 else 0]
        left = (edge - node.solution.parameter) / rate if rate else np.inf
        return min(step, left * 1.001 + 1e-9) if left > 0.0 else step

    def _next(self, node: _Node, step: float) -> tuple[_Node, float]:
        """The node one step farther, and the cosine of the angle between the tangents."""
        solution, matrix = correct(self._map, node.place + step * node.tangent, node.tangent, self._scales)
        onward: FloatArray = np.zeros(len(node.place))
        onward[-1] = 1.0
        try:
            # n equations of the solution, and one for the plane perpendicular to the previous tangent.
            along = np.linalg.solve(matrix, onward)
        except np.linalg.LinAlgError:
            raise NoSolutionError(solution.parameter, "the branch has no tangent") from None
        tangent: FloatArray = np.asarray(along / np.linalg.norm(along), dtype=np.float64)
        place = np.append(solution.state, solution.parameter) / self._scales
        tests: dict[str, float] = {**_tests(solution, matrix, tangent), **self._tests(solution)}
        return _Node(solution, place, tangent, tests), float(tangent @ node.tangent)

    def _is_back(self, nodes: list[_Node]) -> bool:
        """Whether the last step passes the first node again, in the same direction."""
        if len(nodes) < 4:
            return False
        first, before, last = nodes[0], nodes[-2], nodes[-1]
        step = last.place - before.place
        along = (first.place - before.place) @ step / (step @ step)
        aside = np.linalg.norm(first.place - before.place - along * step)
        same_way = first.tangent @ last.tangent > 0.0
        return bool(0.0 < along <= 1.0 and same_way and aside < 0.1 * np.linalg.norm(step))

    def _special_points(self, before: _Node, after: _Node) -> list[SpecialPoint]:
        """Points of sign changes between two nodes, located on the branch, in order along the branch."""
        length = float(before.tangent @ (after.place - before.place))
        found = []
        for name, value in before.tests.items():
            other = after.tests.get(name)
            if other is None or value == 0.0 or value * other > 0.0:
                continue
            node, place = self._located(before, length, name)
            if name != "Neimark-Sacker" or abs(node.solution.multipliers[0].imag) > 0.0:
                found.append((place, SpecialPoint(name, node.solution)))
        return [point for _, point in sorted(found, key=lambda pair: pair[0])]

    def _located(self, before: _Node, length: float, name: str) -> tuple[_Node, float]:
        def test(step: float) -> float:
            if not step:
                return before.tests[name]
            try:
                return self._next(before, step)[0].tests[name]
            except NoSolutionError:
                return 0.0  # the equations are singular where two branches cross

        place = float(brentq(test, 0.0, length, xtol=_PLACE))
        try:
            return self._next(before, place)[0], place
        except NoSolutionError:
            return self._next(before, place + _BESIDE)[0], place


def _differ(before: _Node, after: _Node) -> bool:
    """Whether a test changes sign; `before` may be a start, which has no tests."""
    return any(value * after.tests.get(name, value) < 0.0 for name, value in before.tests.items())


def _tests(solution: PeriodicSolution, matrix: FloatArray, tangent: FloatArray) -> dict[str, float]:
    """Test functions that change sign at special points (Kuznetsov, Elements of Applied Bifurcation Theory).

    The equations bordered by the tangent are singular where two branches cross, but not at a fold; the
    equations bordered by the previous tangent, which gave the solution, are singular at the same points.
    """
    multipliers = solution.multipliers
    products = [a * b for i, a in enumerate(multipliers) for b in multipliers[:i]]
    return {
        "fold": float(tangent[-1]),
        "period doubling": float(np.prod(multipliers + 1.0).real),
        "Neimark-Sacker": float(np.prod(np.array(products) - 1.0).real),
        "branch point": float(np.linalg.det(matrix)),
    }
