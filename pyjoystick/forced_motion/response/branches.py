"""Search for all periodic motions of a shaken joystick over a range of a parameter."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from pyjoystick.forced_motion.periodic.continuation import Branch, Continuation, SpecialPoint, Steps
from pyjoystick.forced_motion.periodic.solutions import NoSolutionError, PeriodicSolution, solve
from pyjoystick.forced_motion.response.shaken import ShakenJoystick
from pyjoystick.support import FloatArray, ParameterError, finite, whole_number

#: Starts of the search: numbers of amplitudes, from the clearance to beyond the stops, and of phases.
_LEVELS: Final = np.radians(np.geomspace(0.1, 30.0, 7))
_PHASES: Final = 4
#: Number of periods after which motions are close to their attractors.
_SETTLING: Final = 60
#: Solutions closer than this, in scales, are the same.
_SAME: Final = 1e-5


@dataclass(frozen=True, eq=False)
class ResponseBranch:
    """A branch across the range.

    Attributes:
        periods: period of the motions, in periods of the torque
        solutions: in order along the branch
        special: folds, period doublings and grazings, in order for each of the branch's two directions
        ends: reasons for its end at its first and at its last solution
        reasons: details for ends without convergence; otherwise empty
    """

    periods: int
    solutions: tuple[PeriodicSolution, ...]
    special: tuple[SpecialPoint, ...]
    ends: tuple[str, str]
    reasons: tuple[str, str] = ("", "")


class Response:
    """Search for branches; `branches` holds the results.

    Attributes:
        shaken: the joystick
        limits: range of its free parameter
        branches: found so far
        notes: branches that are known to start somewhere but were not found
    """

    def __init__(
        self,
        shaken: ShakenJoystick,
        limits: tuple[float, float],
        *,
        most_periods: int = 1,
        steps: Steps | None = None,
        on_progress: Callable[[str], None] = lambda _: None,
    ) -> None:
        """Set up the search.

        Args:
            shaken: the joystick, sampled once per period
            limits: lowest and highest value of the free parameter
            most_periods: longest period, in periods of the torque, up to which period doublings are followed
            steps: step lengths along the branches
            on_progress: called with a description of the current stage

        Raises:
            ParameterError: the limits do not increase, or are not allowed
        """
        low, high = (finite("limits", limit) for limit in limits)
        if low >= high:
            raise ParameterError("limits", limits, "two numbers, the first below the second")
        for limit in (low, high):
            shaken.period(limit)  # raises if the value is not allowed
        self.shaken = shaken
        self.limits = (low, high)
        self.branches: list[ResponseBranch] = []
        self.notes: list[str] = []
        self._most_periods = whole_number("most_periods", most_periods, 1)
        self._steps = steps or Steps(most=0.4, points=200)
        self._tell = on_progress

    def search(self, values: tuple[float, ...] = ()) -> None:
        """Find the branches through the solutions at some values of the free parameter.

        Newton's method starts at 28 states from the clearance to beyond the stops, and at the states that
        these reach after 60 periods. Solutions that no such search finds remain unknown.

        Args:
            values: where to search; by default the joystick's own value, or mid-range if that is outside

        Raises:
            ParameterError: a value is not within the limits
        """
        low, high = self.limits
        own = self.shaken.value
        for value in values or (own if low <= own <= high else 0.5 * (low + high),):
            if not low <= value <= high:
                raise ParameterError("values", value, f"from {low} to {high}")
            self._tell(f"searching at {value:.4g}")
            for solution in distinct_solutions(self.shaken, value):
                if not self.is_known(self.shaken, solution):
                    self.follow(self.shaken, solution)

    def start_at(self, state: FloatArray, value: float) -> PeriodicSolution:
        """Find the solution near a state, for `follow`; raises NoSolutionError if there is none."""
        return solve(self.shaken.smooth(), state, value, self.shaken.scales[:2])

    def follow(self, shaken: ShakenJoystick, start: PeriodicSolution) -> None:
        """Add the branch through a solution, and those that leave it at period doublings.

        Args:
            shaken: the joystick, sampled at the period of the solution
            start: the solution
        """
        self._tell(f"branch {len(self.branches) + 1} from {start.parameter:.4g}")
        continuation = self._continuation(shaken)
        ways = [continuation.branch(start, np.array([0.0, 0.0, way])) for way in (1.0, -1.0)]
        branch = _joined(shaken.periods, *ways)
        self.branches.append(branch)
        if 2 * shaken.periods <= self._most_periods:
            for point in branch.special:
                if point.kind == "period doubling":
                    self._double(shaken.with_periods(2 * shaken.periods), point.solution)

    def _double(self, shaken: ShakenJoystick, doubling: PeriodicSolution) -> None:
        values, vectors = np.linalg.eig(doubling.map.monodromy)
        scales = shaken.scales
        direction = np.append(vectors[:, np.argmin(np.abs(values + 1.0))].real / scales[:2], 0.0)
        try:
            start = self._continuation(shaken).beside(doubling, direction)
        except NoSolutionError as error:
            where = f"beside the period doubling at {doubling.parameter:.6g}"
            self.notes.append(f"motions of {shaken.periods} periods {where}: {error}")
            return
        if not self.is_known(shaken, start):
            self.follow(shaken, start)

    def _continuation(self, shaken: ShakenJoystick) -> Continuation:
        def grazings(solution: PeriodicSolution) -> dict[str, float]:
            high, low = shaken.orbit(solution.state, solution.parameter).extremes
            kinks = shaken.kinks(solution.parameter).items()
            return {f"grazing {name}": (high if kink > 0.0 else low) - kink for name, kink in kinks}

        return Continuation(shaken.smooth(), shaken.scales, self.limits, steps=self._steps, tests=grazings)

    def is_known(self, shaken: ShakenJoystick, solution: PeriodicSolution) -> bool:
        """Whether one of the branches passes through the solution, in any of its periods."""
        states = list(_returns(shaken, solution))
        for branch in self.branches:
            if branch.periods != shaken.periods:
                continue
            for found in _at(shaken, branch, solution.parameter):
                if any(_is_same(found.state, state, shaken.scales[:2]) for state in states):
                    return True
        return False


def distinct_solutions(shaken: ShakenJoystick, value: float) -> list[PeriodicSolution]:
    """Distinct periodic motions at one value of the free parameter."""
    scales, smooth = shaken.scales[:2], shaken.smooth()
    rate = 2.0 * math.pi * shaken.periods / shaken.period(value)
    phases = 2.0 * math.pi * (np.arange(_PHASES) + 0.25) / _PHASES
    starts = np.array(
        [(level * math.cos(one), rate * level * math.sin(one)) for level in _LEVELS for one in phases]
    )
    settled = starts
    for _ in range(_SETTLING):
        settled = shaken.images(settled, value)
    found: list[PeriodicSolution] = []
    for start in np.concatenate((settled[np.all(np.isfinite(settled), axis=1)], starts)):
        if any(np.max(np.abs(start - one.state) / scales) < _SAME for one in found):
            continue
        try:
            solution = solve(smooth, start, value, scales)
        except NoSolutionError:
            continue
        if not any(_is_same(solution.state, one.state, scales) for one in found):
            found.append(solution)
    return found


def _joined(periods: int, forward: Branch, backward: Branch) -> ResponseBranch:
    """Both directions from one solution as one branch; a closed one needs only the first."""
    if forward.end == "back at its start":
        return ResponseBranch(periods, forward.solutions, forward.special, (forward.end, forward.end))
    solutions = (*reversed(backward.solutions[1:]), *forward.solutions)
    special = (*reversed(backward.special), *forward.special)
    ends, reasons = (backward.end, forward.end), (backward.reason, forward.reason)
    return ResponseBranch(periods, solutions, special, ends, reasons)


def _returns(shaken: ShakenJoystick, solution: PeriodicSolution) -> Iterator[FloatArray]:
    """States of a motion at the start of each of its periods."""
    once = shaken.with_periods(1)
    state = solution.state
    for _ in range(shaken.periods):
        yield state
        state = once.images(state[None, :], solution.parameter)[0]


def _at(shaken: ShakenJoystick, branch: ResponseBranch, value: float) -> Iterator[PeriodicSolution]:
    """Solutions of a branch at a value of the parameter."""
    for before, after in pairwise(branch.solutions):
        low, high = sorted((before.parameter, after.parameter))
        if not low <= value <= high or low == high:
            continue
        part = (value - before.parameter) / (after.parameter - before.parameter)
        start = before.state + part * (after.state - before.state)
        try:
            yield solve(shaken.smooth(), start, value, shaken.scales[:2])
        except NoSolutionError:
            continue


def _is_same(first: FloatArray, second: FloatArray, scales: FloatArray) -> bool:
    return bool(np.max(np.abs(first - second) / scales) < _SAME)
