"""What a model may lack: physics and instruments, each as the change of the residuals that it would make.

Every suspect is one or more columns, the derivatives of what the records show with respect to a number that
is zero in the model. A moment that the model lacks acts through the input `T` of the FMU, along the motion
that was fitted: to first order that is its derivative.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from scipy.signal import butter, sosfiltfilt

from pyjoystick.fmu import REALS
from pyjoystick.identification.fitting.checks.fitted_motion import FittedMotion
from pyjoystick.identification.fitting.problem.instrument import ANGLE_SCALE, DELAY, TIME_BASE, ZERO_OFFSET
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.prediction import TrajectoryPredictor
from pyjoystick.identification.fitting.problem.settings import PIVOT_FRICTION, PLUNGER_FRICTION, Free
from pyjoystick.support import FloatArray

#: Parameters are moved by this part, velocities by this (rad/s).
_PART: Final = 1e-4
_VELOCITY: Final = 1e-2
#: -3 dB frequencies of low-pass filters (Hz), and their order, once forward and once backward.
_CUTOFFS: Final = (20.0, 13.0, 8.0, 5.0)
_ORDER: Final = 4
#: Stops and limits are looked for at these parts of the largest angle on either side.
_LEVELS: Final = (0.9, 0.75, 0.6)
_SPRINGS: Final = tuple(
    f"{side}.returnSpring.{name}" for side in ("forward", "backward") for name in ("F_0", "k_s")
)


@dataclass(frozen=True, slots=True)
class Suspect:
    """Something that the model may lack.

    Attributes:
        name: what it is
        columns: by record
        says: the sentence part that gives its size, from the estimates of its columns; empty where there is
            none to give
        one_sided: whether only a positive size makes sense
        own: whether each record has a size of its own
        free: the parameters of a fit that tries it in earnest; none where no FMU has them
        alternatives: how many others of its kind are tried
    """

    name: str
    columns: tuple[FloatArray, ...]
    says: Callable[[FloatArray], str] = lambda sizes: ""
    one_sided: bool = False
    own: bool = False
    free: tuple[Free, ...] = ()
    alternatives: int = 1


def suspects(problem: Problem, x: FloatArray) -> Iterator[Suspect]:
    """Everything that can be tried with the FMU of a problem, at a point."""
    predictors = [one for one in problem.predictors if isinstance(one, TrajectoryPredictor)]
    instruments = [problem.variables.instrument(x, k) for k in range(len(predictors))]
    motions = [
        FittedMotion(one, problem.variables.row(x, k), instruments[k]) for k, one in enumerate(predictors)
    ]
    yield from _instruments(problem, x, motions)
    known = predictors[0].known
    if "T" in known and known["T"].causality == "input" and motions[0].has("theta", "omega"):
        yield from _friction(motions)
        yield from _damping(motions)
        yield from _stops(motions)
        if not predictors[0].inputs:
            yield _moving_at_release(motions)
        if "T" in predictors[0].inputs:
            yield from _torque(motions)
    yield from _parameters(problem, motions)


def _each(
    motions: Sequence[FittedMotion], column: Callable[[FittedMotion], FloatArray]
) -> tuple[FloatArray, ...]:
    return tuple(column(one)[:, np.newaxis] for one in motions)


def _instruments(problem: Problem, x: FloatArray, motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """What the record shows otherwise than it is."""
    slopes = problem.instrument_slopes(x)
    unit = _Unit(problem.predictors[0].labels[0])

    def columns(name: str) -> tuple[FloatArray, ...]:
        return tuple(one[name][:, np.newaxis] for one in slopes)

    yield Suspect("a zero offset", columns(ZERO_OFFSET), lambda s: f"up to {unit(_largest(s))}", own=True)
    yield Suspect(
        "an error of the angle's scale",
        columns(ANGLE_SCALE),
        lambda s: f"{100.0 * s[0]:+.2g} %",
        free=(Free(ANGLE_SCALE),),
    )
    if all(TIME_BASE in one for one in slopes):
        yield Suspect(
            "an error of the time base",
            columns(TIME_BASE),
            lambda s: f"{100.0 * s[0]:+.2g} %",
            free=(Free(TIME_BASE),),
        )
    if motions[0].predictor.inputs and all(DELAY in one for one in slopes):
        yield Suspect("a delay between the channels", columns(DELAY), lambda s: f"{1e3 * s[0]:.3g} ms")
    yield from _filters(motions)
    for limit in _limits([one.first() for one in motions]):
        yield _clipping(motions, limit, unit)


def _limits(values: Sequence[FloatArray]) -> list[float]:
    """Angles on either side within the motions."""
    joined = np.concatenate(values)
    ends = (max(float(np.max(joined)), 0.0), min(float(np.min(joined)), 0.0))
    return [
        level * end for end, sign in zip(ends, (1, -1), strict=True) if sign * end > 0 for level in _LEVELS
    ]


def _clipping(motions: Sequence[FittedMotion], limit: float, unit: _Unit) -> Suspect:
    return Suspect(
        "clipping",
        _each(motions, lambda one: one.only_first(-_beyond(one.first(), limit))),
        lambda s: f"at about {unit(limit)}",
        one_sided=True,
        alternatives=2 * len(_LEVELS),
    )


def _friction(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    yield Suspect(
        "dry friction at the pivot",
        _each(motions, lambda one: one.with_moment(-np.sign(one.series("omega")))),
        lambda s: f"T_c about {s[0]:.2g} N m",
        one_sided=True,
        free=(PIVOT_FRICTION,),
    )
    if motions[0].has("M_s", "f_x"):
        yield Suspect(
            "dry friction at the plungers",
            _each(motions, lambda one: one.with_moment(-np.sign(one.series("omega")) * _lever(one))),
            lambda s: f"F_c about {s[0]:.2g} N",
            one_sided=True,
            free=(PLUNGER_FRICTION,),
        )


def _lever(motion: FittedMotion) -> FloatArray:
    """dx/dtheta (m) of the plunger in contact: the contact moment by its force; 0 without contact."""
    moment, force = motion.series("M_s"), motion.series("f_x")
    return np.abs(np.divide(moment, force, out=np.zeros_like(moment), where=force > 0.0))


def _damping(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """A coefficient that depends on the angle, on its side or on the speed, each to first order."""

    def columns(one: FittedMotion) -> FloatArray:
        theta, omega = one.series("theta"), one.series("omega")
        shapes = (omega * np.abs(theta), omega * np.sign(theta), omega * np.abs(omega))
        return np.column_stack([one.with_moment(-shape) for shape in shapes])

    yield Suspect(
        "a damping coefficient that depends on the angle, its side or the speed otherwise",
        tuple(map(columns, motions)),
    )


def _stops(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """An elastic stop within the motion, on one side."""
    for limit in _limits([one.series("theta") for one in motions]):
        yield _stop(motions, limit)


def _stop(motions: Sequence[FittedMotion], limit: float) -> Suspect:
    return Suspect(
        "a stop",
        _each(motions, lambda one: one.with_moment(-_beyond(one.series("theta"), limit))),
        lambda s: f"at about {math.degrees(limit):.2g} deg",
        one_sided=True,
        alternatives=2 * len(_LEVELS),
    )


def _torque(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """Errors of the torque that was measured."""
    yield Suspect(
        "an error of the torque's scale",
        _each(motions, lambda one: one.with_moment(one.predictor.input_at("T", one.instrument, one.time))),
        lambda s: f"{100.0 * s[0]:+.2g} %",
    )
    yield Suspect(
        "a zero offset of the torque",
        _each(motions, lambda one: one.with_moment(np.ones_like(one.time))),
        lambda s: f"up to {_largest(s):.2g} N m",
        own=True,
    )


def _parameters(problem: Problem, motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """Parameters of the joystick that the settings leave at what they are."""
    predictor = motions[0].predictor

    def free(name: str) -> bool:
        known = predictor.known.get(name)
        is_number = known is not None and known.type in REALS and known.settable_at_start
        return is_number and name not in problem.variables.varied

    def columns(names: Sequence[str]) -> tuple[FloatArray, ...]:
        return tuple(
            np.column_stack(
                [one.with_parameter(name, _PART * (predictor.value(name) or 1.0)) for name in names]
            )
            for one in motions
        )

    if predictor.inputs and free("omega_start"):
        yield Suspect(
            "motion at the first sample",
            _each(motions, lambda one: one.with_parameter("omega_start", _VELOCITY)),
            lambda s: f"up to {abs(_largest(s)):.2g} rad/s",
            own=True,
        )
    if free("J"):
        inertia = predictor.value("J")
        yield Suspect(
            "another moment of inertia",
            columns(["J"]),
            lambda s: f"J {100.0 * s[0] / inertia:+.2g} %",
        )
    springs = [name for name in _SPRINGS if free(name)]
    if springs:
        yield Suspect("other preloads or stiffnesses of the return springs", columns(springs))


def _filters(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """A low-pass filter without delay, as recorded angles are smoothed."""
    interval = max(float(np.median(np.diff(one.late))) for one in motions)
    duration = min(float(np.ptp(one.late)) for one in motions)
    for cutoff in _CUTOFFS:
        # Shorter records show nothing of it.
        if 1.0 / duration < cutoff < 0.5 / interval:
            yield Suspect(
                "a low-pass filter",
                _each(motions, partial(_filtered, cutoff=cutoff)),
                partial(_near, cutoff),
                one_sided=True,
                alternatives=len(_CUTOFFS),
            )


def _near(cutoff: float, sizes: FloatArray) -> str:
    return f"-3 dB near {cutoff:g} Hz"


def _filtered(motion: FittedMotion, cutoff: float) -> FloatArray:
    """Change of the first output by a filter, shape (n,)."""
    grid = np.arange(motion.late[0], motion.late[-1] + motion.step, motion.step)
    first = np.interp(grid, motion.time, motion.first())
    change = sosfiltfilt(butter(_ORDER, cutoff, fs=1.0 / motion.step, output="sos"), first) - first
    shown = np.interp(motion.late, grid, change)
    return np.concatenate((shown, *[np.zeros_like(shown)] * (len(motion.predictor.outputs) - 1)))


def _moving_at_release(motions: Sequence[FittedMotion]) -> Suspect:
    """A hold at another angle than that at which the motion would have begun at rest.

    A velocity at the release is, to first order, an earlier release at a larger angle, to which the free
    parameters adapt: what is left is the angle of the hold.
    """
    start = motions[0]
    omega = start.series("omega")
    slope = abs(float(omega[1] / start.time[1]))

    def column(one: FittedMotion) -> FloatArray:
        held = np.where(one.late <= 0.0, -np.sign(one.first()[0]), 0.0)
        return np.concatenate((held, *[np.zeros_like(held)] * (len(one.predictor.outputs) - 1)))

    return Suspect(
        "motion at the instant of release",
        _each(motions, column),
        lambda sizes: f"about {math.sqrt(2.0 * slope * sizes[0]):.2g} rad/s",
        one_sided=True,
    )


def _beyond(values: FloatArray, limit: float) -> FloatArray:
    """By how much values are beyond a limit, on its side of zero, else 0."""
    return np.asarray(np.sign(limit) * np.maximum(np.sign(limit) * values - abs(limit), 0.0))


def _largest(sizes: FloatArray) -> float:
    return float(sizes[np.argmax(np.abs(sizes))])


@dataclass(frozen=True, slots=True)
class _Unit:
    """Numbers of an output as text: angles in degrees."""

    output: str

    def __call__(self, value: float) -> str:
        return f"{math.degrees(value):.2g} deg" if self.output == "theta" else f"{value:.2g}"
