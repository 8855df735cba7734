"""Suspects in the instrument: ways in which a record may distort the motion."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Final

import numpy as np
from scipy.signal import butter, sosfiltfilt

from pyjoystick.identification.fitting.checks.fitted_motion import FittedMotion
from pyjoystick.identification.fitting.checks.suspect import (
    LEVELS,
    Suspect,
    Unit,
    beyond,
    each,
    largest,
    limits,
)
from pyjoystick.identification.fitting.problem.instrument import ANGLE_SCALE, DELAY, TIME_BASE, ZERO_OFFSET
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.settings import Free
from pyjoystick.support import FloatArray

#: Cutoff (-3 dB) frequencies of low-pass filters (Hz), and their order; applied forward and backward.
_CUTOFFS: Final = (20.0, 13.0, 8.0, 5.0)
_ORDER: Final = 4
#: Backlash of a loose sensor, relative to the largest angle.
_PLAYS: Final = (0.003, 0.01, 0.03)


def instruments(problem: Problem, x: FloatArray, motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """Possible distortions by the instrument."""
    slopes = problem.model.instrument_slopes(x)
    unit = Unit(problem.predictors[0].labels[0])

    def columns(name: str) -> tuple[FloatArray, ...]:
        return tuple(one[name][:, np.newaxis] for one in slopes)

    fitted = {one.name for one in problem.variables.free}
    if ZERO_OFFSET not in fitted:
        yield Suspect("a zero offset", columns(ZERO_OFFSET), lambda s: f"up to {unit(largest(s))}", own=True)
    if ANGLE_SCALE not in fitted:
        yield Suspect(
            "an error of the angle's scale",
            columns(ANGLE_SCALE),
            lambda s: f"{100.0 * s[0]:+.2g} %",
            free=(Free(ANGLE_SCALE),),
        )
    if TIME_BASE not in fitted and all(TIME_BASE in one for one in slopes):
        yield Suspect(
            "an error of the time base",
            columns(TIME_BASE),
            lambda s: f"{100.0 * s[0]:+.2g} %",
            free=(Free(TIME_BASE),),
        )
    elif TIME_BASE not in fitted and motions[0].predictor.inputs:
        yield Suspect(
            "an error of the time base",
            each(motions, lambda one: one.with_time_base()),
            lambda s: f"{100.0 * s[0]:+.2g} %",
        )
    if DELAY not in fitted and motions[0].predictor.inputs and all(DELAY in one for one in slopes):
        yield Suspect("a delay between the channels", columns(DELAY), lambda s: f"{1e3 * s[0]:.3g} ms")
    yield from _filters(motions)
    largest_motion = max(float(np.max(np.abs(one.first()))) for one in motions)
    for part in _PLAYS:
        yield _backlash(motions, part * largest_motion, unit)
    for limit in limits([one.first() for one in motions]):
        yield _clipping(motions, limit, unit)


def _backlash(motions: Sequence[FittedMotion], play: float, unit: Unit) -> Suspect:
    """A sensor loosely attached to the handle: it moves only after the handle has crossed the backlash."""
    return Suspect(
        "backlash of the sensor",
        each(motions, lambda one: one.only_first((_dragged(one.first(), play) - one.first()) / play)),
        lambda s: f"about {unit(s[0])} of play",
        one_sided=True,
        alternatives=len(_PLAYS),
    )


def _dragged(values: FloatArray, play: float) -> FloatArray:
    """What a sensor with this backlash shows of a motion; it starts in the middle of the backlash."""
    shown, last = np.empty_like(values), float(values[0])
    for k, value in enumerate(values.tolist()):
        last = min(max(last, value - 0.5 * play), value + 0.5 * play)
        shown[k] = last
    return shown


def _clipping(motions: Sequence[FittedMotion], limit: float, unit: Unit) -> Suspect:
    return Suspect(
        "clipping",
        each(motions, lambda one: one.only_first(-beyond(one.first(), limit))),
        lambda s: f"at about {unit(limit)}",
        one_sided=True,
        alternatives=2 * len(LEVELS),
    )


def _filters(motions: Sequence[FittedMotion]) -> Iterator[Suspect]:
    """A zero-phase low-pass filter, as used to smooth recorded angles."""
    interval = max(float(np.median(np.diff(one.late))) for one in motions)
    duration = min(float(np.ptp(one.late)) for one in motions)
    for cutoff in _CUTOFFS:
        # Records shorter than this do not show the filter.
        if 1.0 / duration < cutoff < 0.5 / interval:
            yield Suspect(
                "a low-pass filter",
                each(motions, partial(_filtered, cutoff=cutoff)),
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
