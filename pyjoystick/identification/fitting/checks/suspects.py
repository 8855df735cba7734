"""What a model may lack, in physics and instruments, each as the change of the residuals that it would cause.

A suspect has one or more columns: the derivatives of the record with respect to a number that is zero in the
model. A missing moment is applied to the input `T` of the FMU along the fitted motion, which gives the
derivative to first order.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Final

import numpy as np

from pyjoystick.fmu import REALS
from pyjoystick.identification.fitting.checks.fitted_motion import FittedMotion
from pyjoystick.identification.fitting.checks.instrument_suspects import instruments
from pyjoystick.identification.fitting.checks.suspect import (
    LEVELS,
    Suspect,
    beyond,
    each,
    largest,
    limits,
    near,
)
from pyjoystick.identification.fitting.problem.joystick_settings import (
    PIVOT_FRICTION,
    PLUNGER_FRICTION,
    SPRING_FORCES,
)
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.trajectory_prediction import TrajectoryPredictor
from pyjoystick.support import FloatArray

#: Relative change of parameters, and change of velocities (rad/s).
_PART: Final = 1e-4
_VELOCITY: Final = 1e-2
_SPRINGS: Final = tuple(
    f"{side}.returnSpring.{name}" for side in ("forward", "backward") for name in ("F_0", "k_s")
)


def suspects(problem: Problem, x: FloatArray) -> Iterator[Suspect]:
    """All suspects that can be tried with the FMU of a problem, at a point."""
    predictors = [one for one in problem.predictors if isinstance(one, TrajectoryPredictor)]
    variables = problem.variables
    motions = [
        FittedMotion(one, variables.row(x, k), variables.instrument(x, k)) for k, one in enumerate(predictors)
    ]
    yield from instruments(problem, x, motions)
    known = predictors[0].motion.known
    if "T" in known and known["T"].causality == "input" and motions[0].has("theta", "omega"):
        yield from _friction(motions)
        yield from _damping(motions)
        yield from _stops(motions)
        if motions[0].has("M_s") and not set(problem.variables.varied) & set(SPRING_FORCES):
            yield _force_scale(motions)
        if not predictors[0].inputs:
            yield _moving_at_release(motions)
        if "T" in predictors[0].inputs:
            yield from _torque(motions)
    yield from _parameters(problem, motions)
    if len(motions) > 1:
        yield from _differing(problem, x)


def _friction(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    yield Suspect(
        "dry friction at the pivot",
        each(motions, lambda one: one.with_moment(-np.sign(one.series("omega")))),
        lambda s: f"T_c about {s[0]:.2g} N m",
        one_sided=True,
        usual=True,
        free=(PIVOT_FRICTION,),
    )
    if motions[0].has("M_s", "f_x"):
        yield Suspect(
            "dry friction at the plungers",
            each(motions, lambda one: one.with_moment(-np.sign(one.series("omega")) * _lever(one))),
            lambda s: f"F_c about {s[0]:.2g} N",
            one_sided=True,
            usual=True,
            free=(PLUNGER_FRICTION,),
        )


def _lever(motion: FittedMotion) -> FloatArray:
    """dx/dtheta (m) of the plunger in contact, which is contact moment over force; 0 without contact."""
    moment, force = motion.series("M_s"), motion.series("f_x")
    return np.abs(np.divide(moment, force, out=np.zeros_like(moment), where=force > 0.0))


def _damping(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """A damping coefficient that depends on the angle, its side or the speed, each to first order."""

    def columns(one: FittedMotion) -> FloatArray:
        theta, omega = one.series("theta"), one.series("omega")
        shapes = (omega * np.abs(theta), omega * np.sign(theta), omega * np.abs(omega))
        return np.column_stack([one.with_moment(-shape) for shape in shapes])

    yield Suspect(
        "a damping coefficient that depends on the angle, its side or the speed otherwise",
        tuple(map(columns, motions)),
    )


def _stops(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """An elastic stop within the range of motion, on one side."""
    for limit in limits([one.series("theta") for one in motions]):
        yield _stop(motions, limit)


def _stop(motions: Sequence[FittedMotion], limit: float) -> Suspect:
    return Suspect(
        "a stop",
        each(motions, lambda one: one.with_moment(-beyond(one.series("theta"), limit))),
        lambda s: f"at about {math.degrees(limit):.2g} deg",
        one_sided=True,
        alternatives=2 * len(LEVELS),
    )


def _force_scale(motions: Sequence[FittedMotion]) -> Suspect:
    """An error of the load cell that measured the springs."""
    return Suspect(
        "another scale of all forces of the springs",
        each(motions, lambda one: one.with_moment(-one.series("M_s"))),
        lambda s: f"{100.0 * s[0]:+.2g} %",
    )


def _torque(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """Errors of the measured torque."""
    yield Suspect(
        "an error of the torque's scale",
        each(
            motions, lambda one: one.with_moment(one.predictor.motion.input_at("T", one.instrument, one.time))
        ),
        lambda s: f"{100.0 * s[0]:+.2g} %",
    )
    yield Suspect(
        "a zero offset of the torque",
        each(motions, lambda one: one.with_moment(np.ones_like(one.time))),
        lambda s: f"up to {largest(s):.2g} N m",
        own=True,
    )


def _parameters(problem: Problem, motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """Joystick parameters that the fit does not vary."""
    predictor = motions[0].predictor

    def free(name: str) -> bool:
        known = predictor.motion.known.get(name)
        is_number = known is not None and known.type in REALS and known.settable_at_start
        return is_number and name not in problem.variables.varied

    def columns(names: Sequence[str]) -> tuple[FloatArray, ...]:
        return tuple(
            np.column_stack(
                [one.with_parameter(name, _PART * (predictor.motion.value(name) or 1.0)) for name in names]
            )
            for one in motions
        )

    if predictor.inputs and free("omega_start"):
        yield Suspect(
            "motion at the first sample",
            each(motions, lambda one: one.with_parameter("omega_start", _VELOCITY)),
            lambda s: f"up to {abs(largest(s)):.2g} rad/s",
            own=True,
        )
    if free("J"):
        inertia = predictor.motion.value("J")
        yield Suspect(
            "another moment of inertia",
            columns(["J"]),
            lambda s: f"J {100.0 * s[0] / inertia:+.2g} %",
            free=(near("J", inertia),),
        )
    if free("m") and "M_g" in predictor.motion.known:
        mass = predictor.motion.value("m")
        yield Suspect(
            "another mass",
            columns(["m"]),
            lambda s: f"m {100.0 * s[0] / mass:+.2g} %",
            free=(near("m", mass),),
        )
    springs = [name for name in _SPRINGS if free(name)]
    if springs:
        values = [predictor.motion.value(name) for name in springs]
        yield Suspect(
            "other preloads or stiffnesses of the return springs",
            columns(springs),
            lambda s: ", ".join(map(_change, springs, s.tolist(), values)),
            free=tuple(map(near, springs, values)),
        )


def _change(name: str, size: float, value: float) -> str:
    """Change of a spring's parameter in percent, or in N for a preload of nothing."""
    return f"{name} {100.0 * size / value:+.2g} %" if value else f"{name} {size:+.2g} N"


def _differing(problem: Problem, x: FloatArray) -> Iterator[Suspect]:
    """Shared parameters with a value for each record: the records may be of different joysticks."""
    slopes = problem.jacobians(x)
    names = [one.record.name for one in problem.predictors]
    for place, free in enumerate(problem.variables.free):
        if free.record is None:
            yield Suspect(
                f"records that differ in {free.name}",
                tuple(one[:, [place]] for one in slopes),
                partial(_spread, names, float(x[place])),
                own=True,
            )


def _spread(names: Sequence[str], value: float, sizes: FloatArray) -> str:
    """Records with the lowest and the highest value."""
    low, high = int(np.argmin(sizes)), int(np.argmax(sizes))
    return f"{value + sizes[low]:.4g} in {names[low]}, {value + sizes[high]:.4g} in {names[high]}"


def _moving_at_release(motions: Sequence[FittedMotion]) -> Suspect:
    """A hold at another angle than the one from which the motion seems to start at rest.

    A velocity at the release is, to first order, an earlier release from a larger angle. The free parameters
    adapt to that, which leaves only the angle of the hold.
    """
    start = motions[0]
    omega = start.series("omega")
    slope = abs(float(omega[1] / start.time[1]))

    def column(one: FittedMotion) -> FloatArray:
        held = np.where(one.late <= 0.0, -np.sign(one.first()[0]), 0.0)
        return np.concatenate((held, *[np.zeros_like(held)] * (len(one.predictor.outputs) - 1)))

    return Suspect(
        "motion at the instant of release",
        each(motions, column),
        lambda sizes: f"about {math.sqrt(2.0 * slope * sizes[0]):.2g} rad/s, of either sign",
        one_sided=True,
        usual=True,
    )
