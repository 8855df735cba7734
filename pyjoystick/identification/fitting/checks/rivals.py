"""Suspects as free parameters: the fit repeated with a parameter that the model may lack."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu import Fmu, FmuNotFoundError, find_fmu
from pyjoystick.identification.errors import FitError
from pyjoystick.identification.fitting.checks.score_test import Finding
from pyjoystick.identification.fitting.checks.suspect import Suspect
from pyjoystick.identification.fitting.problem.difference_steps import choose_steps
from pyjoystick.identification.fitting.problem.instrument import ZERO_OFFSET
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.settings import FitSettings, Free
from pyjoystick.identification.fitting.problem.trajectory_prediction import TrajectoryPredictor
from pyjoystick.identification.fitting.solution.search import staged_search
from pyjoystick.runs import FMU_WITH_FRICTION
from pyjoystick.support import FloatArray, ParameterError

_FRICTION: Final = "friction."
_EVALUATIONS: Final = 40
_ANGLE: Final = "theta"
#: A rival whose parameters are not within this factor of the fit's is none: no instrument error or small
#: missing effect moves them that far, and far away a run may take a thousand times as long.
_NEAR: Final = 10.0
#: A parameter that ends so close to a bound, relative to it, is at the bound.
_AT_BOUND: Final = 1e-3
#: Parameters that change sign with the angle.
_TURNED: Final = ("theta_start", "omega_start", ZERO_OFFSET)


class Make(Protocol):
    """Makes the problem of other settings on the same records."""

    def __call__(self, settings: FitSettings, fmu: Fmu | None, /, *, mirrored: bool = False) -> Problem:
        """Make the problem, with the given FMU instead of that of the fit if there is one.

        If mirrored, the sign of the angle is reversed in the records.
        """
        ...


def tried(
    findings: Sequence[Finding],
    suspects: Mapping[str, Suspect],
    problem: Problem,
    settings: FitSettings,
    x: FloatArray,
    make: Make,
) -> list[Finding]:
    """Refine findings by actual fits where possible, most likely first.

    The score test is linear: it underestimates large effects and may order them wrongly.

    Args:
        findings: significant findings of the score test
        suspects: suspects by name
        problem: problem of the fit, weighted by its noise
        settings: settings of the fit
        x: minimum of the fit
        make: makes the problem of other settings on the same records
    """
    with ExitStack() as stack:
        with_friction = _with_friction(settings, stack)
        found = [
            _refitted(one, suspects[one.name], problem, settings, x, with_friction, make) for one in findings
        ]
    other_sign = _mirrored(problem, settings, x, make)
    if other_sign is not None:
        found.append(other_sign)
    return sorted(found, key=lambda one: -one.evidence)


def _with_friction(settings: FitSettings, stack: ExitStack) -> Fmu | None:
    name = FMU_WITH_FRICTION.get(settings.fmu)
    if name is None:
        return None
    try:
        return stack.enter_context(Fmu(find_fmu(name)))
    except FmuNotFoundError:
        return None


def _refitted(
    finding: Finding,
    suspect: Suspect,
    problem: Problem,
    settings: FitSettings,
    x: FloatArray,
    with_friction: Fmu | None,
    make: Make,
) -> Finding:
    """Refine the finding by a fit, or return it unchanged if the fit is impossible or explains no more.

    What it explains at a bound of the suspect counts even if that is less: more is not credible.
    """
    needs_friction = any(
        one.name.startswith(_FRICTION) and not _has(problem, one.name) for one in suspect.free
    )
    if not suspect.free or (needs_friction and with_friction is None):
        return finding
    try:
        wider = replace(
            settings,
            free=(*_near(settings.free, problem, x), *suspect.free),
            fixed={name: value for name, value in settings.fixed.items() if name not in _names(suspect)},
        )
        rival = make(wider, with_friction if needs_friction else None)
    except (FitError, ParameterError):
        return finding
    start = np.concatenate((x, rival.variables.start[len(x) :]))
    best, part = _better(rival, start, problem, settings, x)
    sizes = best[len(x) :] - [_value(problem, one.name) for one in suspect.free]
    if part <= 0.0 or (part <= finding.explained and not _at_bound(rival, best)[len(x) :].any()):
        return finding
    evidence = problem.size * -math.log1p(-part) - len(sizes) * math.log(problem.size)
    return replace(finding, size=suspect.says(sizes), explained=part, evidence=evidence)


def _has(problem: Problem, name: str) -> bool:
    """Whether the fit's own FMU has the parameter."""
    return any(
        isinstance(one, TrajectoryPredictor) and name in one.motion.known for one in problem.predictors
    )


def _value(problem: Problem, name: str) -> float:
    """Value of what the fit does not vary: zero for the instrument, and for what its FMU does not have."""
    motion = next(one.motion for one in problem.predictors if isinstance(one, TrajectoryPredictor))
    return motion.value(name) if name in motion.known else 0.0


def _mirrored(problem: Problem, settings: FitSettings, x: FloatArray, make: Make) -> Finding | None:
    """Try the records with the sign of the angle reversed; None unless this explains anything.

    No derivative leads there, because a scale of -1 is far from 1.
    """
    if settings.outputs[0] != _ANGLE:
        return None
    try:
        near = replace(settings, free=_near(settings.free, problem, x))
        rival = make(_turned(near), None, mirrored=True)
    except (FitError, ParameterError):
        return None
    start = [-v if one.name in _TURNED else v for one, v in zip(rival.variables.free, x, strict=True)]
    part = _better(rival, np.array(start), problem, settings, x)[1]
    evidence = problem.size * -math.log1p(-part)
    return Finding("the other sign of the angle", "", part, evidence, 0.0) if part > 0.0 else None


def _near(free: Sequence[Free], problem: Problem, x: FloatArray) -> tuple[Free, ...]:
    """Free parameters with bounds near the fit for those of the FMU that all records share.

    A parameter below or at zero keeps its bounds, as does the lower one of a parameter that may vanish.
    """
    values = {
        one.name: (one, float(value))
        for one, value in zip(problem.variables.free, x, strict=True)
        if one.record is None and not one.of_instrument and value > 0.0 and one.minimum >= 0.0
    }
    found = []
    for one in free:
        if one.name in values:
            variable, value = values[one.name]
            low = max(variable.minimum, value / _NEAR) if variable.minimum > 0.0 else variable.minimum
            high = min(variable.maximum, value * _NEAR)
            # A measured start stays, which is not only where the search begins.
            start = value if one.uncertainty is None else one.start
            one = replace(one, start=start, minimum=low, maximum=high)
        found.append(one)
    return tuple(found)


def _turned(settings: FitSettings) -> FitSettings:
    """Settings with starts, bounds and fixed values for the reversed angle."""
    fixed = {name: -float(value) if name in _TURNED else value for name, value in settings.fixed.items()}
    return replace(settings, free=tuple(map(_turned_variable, settings.free)), fixed=fixed)


def _turned_variable(one: Free) -> Free:
    if one.name not in _TURNED:
        return one
    start, minimum, maximum = (None if v is None else -v for v in (one.start, one.maximum, one.minimum))
    return replace(one, start=start, minimum=minimum, maximum=maximum)


def _better(
    rival: Problem, start: FloatArray, problem: Problem, settings: FitSettings, x: FloatArray
) -> tuple[FloatArray, float]:
    """Minimum of the rival fit, and the part of the original sum of squares that it removes."""
    steps = choose_steps(rival.model, start, central=False).steps
    rival = replace(rival, noise=problem.noise, steps=steps)
    best = staged_search(rival, start, evaluations=_EVALUATIONS, stages=settings.search.stages)
    return best.x, 1.0 - best.cost / float(np.sum(problem.residuals(x) ** 2))


def _at_bound(rival: Problem, best: FloatArray) -> NDArray[np.bool_]:
    """Which parameters the search stopped at a bound."""
    bounds = np.array((rival.variables.lower, rival.variables.upper))
    return np.asarray(np.isclose(best, bounds, rtol=_AT_BOUND, atol=0.0).any(axis=0))


def _names(suspect: Suspect) -> Iterator[str]:
    return (one.name for one in suspect.free)
