"""The noise of a measured torque, estimated from the torque's samples and from the residuals."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Final

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from pyjoystick.identification.fitting.checks.fitted_motion import FittedMotion
from pyjoystick.identification.fitting.checks.trust import Check
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.noise_color import restricted_likelihood
from pyjoystick.identification.fitting.problem.predictor import Predictor
from pyjoystick.identification.fitting.problem.torque_noise import TorqueNoise, Whitener, white_level
from pyjoystick.identification.fitting.problem.trajectory_prediction import TrajectoryPredictor
from pyjoystick.support import FloatArray

TORQUE: Final = "T"
#: Most waves of the torque whose effect is computed, with a run for each. All faster waves are left out after
#: so many in a row with next to no effect.
_MOST_WAVES: Final = 250
_IN_A_ROW: Final = 8
#: Effects below the first (sum of squares, in variances of the angle's noise) are left out beside ten times
#: larger ones, and those below the second in any case.
_SMALL: Final = 1e-2
_NOTHING: Final = 1e-4
#: The residuals contradict the level of the noise if twice the logarithm of the likelihood falls by more,
#: which is chance in one of a thousand fits.
_CONTRADICTION: Final = 10.83
#: Draws of the noise, and the largest shift by what is not linear in it, in standard errors (rms).
_DRAWS: Final = 8
_MOST_SHIFT: Final = 0.7
#: Range of the torque's part of the noise that is searched (logarithm).
_RANGE: Final = (-7.0, 7.0)


def with_torque_noise(problem: Problem, x: FloatArray, *, sigma_known: bool) -> Problem:
    """Return the problem with the part of the torque's noise that the residuals at x show.

    A noisy torque drives the FMU along another motion than the joystick's. The residuals then contain the
    response to the noise, which lasts for many samples.
    """
    if not all(_is_driven(one) for one in problem.predictors):
        return problem
    noise = problem.noise
    if not noise.torques:
        noise = replace(noise, torques=tuple(_largest_noise(problem, x, k) for k in range(len(problem.data))))
    if any(one.effects.size for one in noise.torques):
        part = _part(replace(problem, noise=noise), x, sigma_known=sigma_known)
        noise = replace(noise, torque_part=part)
    return replace(problem, noise=noise)


def check_torque_noise(problem: Problem, x: FloatArray, errors: FloatArray) -> Check | None:
    """Check whether the motion responds linearly to the torque's noise; None if there is none.

    Noise of either sign is added to the torque. What both have in common is not in the standard errors.
    """
    noise = problem.noise
    if noise.torque_part == 0.0:
        return None
    level = max(noise.torque_level(k) for k in range(len(problem.data)))
    random = np.random.default_rng(0)
    jacobian = problem.jacobian(x)
    lengths = np.maximum(np.linalg.norm(jacobian, axis=0), np.finfo(float).tiny)
    solve = np.linalg.pinv(jacobian / lengths)
    motions = [_motion(problem, x, k) for k in range(len(problem.data))]
    shifts = []
    for _ in range(_DRAWS):
        common = [
            noise.counted(one.curvature(_drawn(random, one, noise.torque_level(k))), k)
            for k, one in enumerate(motions)
        ]
        rows = np.concatenate((*common, np.zeros(len(problem.prior))))
        shifts.append(solve @ np.nan_to_num(rows) / lengths / errors)
    free = problem.variables.free
    sizes = np.sqrt(np.mean(np.square(shifts), axis=0))
    worst = max(range(len(x)), key=lambda j: sizes[j] if free[j].record is None else 0.0)
    text = f"the torque has noise of {level:.2g} N m"
    if sizes[worst] <= _MOST_SHIFT:
        return Check("torque", True, f"{text}, which the standard errors contain")
    message = (
        f"{text}, too much: the motion does not respond to it linearly, which shifts {free[worst].label} by "
        f"about {sizes[worst]:.1f} standard errors; measure the torque with less noise, or with more samples "
        "per second (a filter leaves the slow part of the noise, which does the harm)"
    )
    return Check("torque", False, message)


def _drawn(random: np.random.Generator, motion: FittedMotion, level: float) -> FloatArray:
    """White noise of the torque's samples along the motion."""
    record = motion.predictor.record
    return _along(motion, level * random.standard_normal(len(record.time)))


def _along(motion: FittedMotion, samples: FloatArray) -> FloatArray:
    """Values at the samples of the torque, as values along the motion, linear in between."""
    times = motion.time + motion.instrument.release_time
    return np.asarray(np.interp(times, motion.predictor.record.time, samples))


def _motion(problem: Problem, x: FloatArray, record: int) -> FittedMotion:
    predictor = problem.predictors[record]
    assert isinstance(predictor, TrajectoryPredictor)
    return FittedMotion(predictor, problem.variables.row(x, record), problem.variables.instrument(x, record))


def _is_driven(predictor: Predictor) -> bool:
    return isinstance(predictor, TrajectoryPredictor) and TORQUE in predictor.inputs


def _largest_noise(problem: Problem, x: FloatArray, record: int) -> TorqueNoise:
    """All that is white in the measured torque, with its effects.

    The noise is a sum of cosine waves with independent amplitudes. The response falls with the square of the
    frequency, so that slow waves suffice.
    """
    predictor = problem.predictors[record]
    assert isinstance(predictor, TrajectoryPredictor)
    torque = predictor.record.series(TORQUE)
    level = white_level(torque)
    left = problem.data[record] - problem.predictions(x)[record]
    angle = _levels(left, predictor.labels)
    effects: list[FloatArray] = []
    sizes: list[float] = []
    if level > 0.0:
        motion = _motion(problem, x, record)
        samples = np.arange(len(torque)) + 0.5
        for number in range(min(_MOST_WAVES, len(torque))):
            wave = np.cos(math.pi * number * samples / len(torque))
            wave *= level / float(np.linalg.norm(wave))
            effects.append(motion.with_moment(_along(motion, wave)))
            sizes.append(float(np.sum((effects[-1] / angle) ** 2)))
            if _is_over(sizes):
                break
    if max(sizes, default=0.0) < _NOTHING:
        effects = []
    return TorqueNoise(level, np.column_stack([np.zeros((len(left), 0)), *effects]))


def _is_over(sizes: list[float]) -> bool:
    """Whether faster waves have next to no effect."""
    last = max(sizes[-_IN_A_ROW:])
    return len(sizes) >= _IN_A_ROW and last < (_SMALL if max(sizes) > 10.0 * last else _NOTHING)


def _levels(left: FloatArray, labels: tuple[str, ...]) -> FloatArray:
    """Noise of the outputs from the differences of residuals, which slow effects leave alone, shape (n,)."""
    found = np.empty_like(left)
    for label in dict.fromkeys(labels):
        own = np.array(labels) == label
        found[own] = max(white_level(left[own]), np.finfo(float).tiny)
    return found


def _part(problem: Problem, x: FloatArray, *, sigma_known: bool) -> float:
    """Part of the torque's largest noise, 0 to 1, by restricted maximum likelihood.

    The torque may contain white noise that moves the joystick, which only the residuals tell from that of the
    instrument.
    """
    noise = problem.noise
    predicted, slopes = problem.predictions(x), problem.jacobians(x)
    records = range(len(problem.data))
    left = [noise.weighted(problem.data[k] - predicted[k], k) for k in records]
    rows = [noise.weighted(slopes[k], k) for k in records]
    effects = [noise.weighted(one.effects, k) for k, one in enumerate(noise.torques)]
    filters = [Whitener(one) for one in effects]

    def likelihood(logarithm: float) -> tuple[float, float]:
        whiteners = [one.times(math.exp(logarithm)) for one in filters]
        return restricted_likelihood(
            [one.whitened(values) for one, values in zip(whiteners, left, strict=True)],
            [one.whitened(values) for one, values in zip(whiteners, rows, strict=True)],
            float(problem.size),
            sum(one.logarithm for one in whiteners),
            sigma_known=sigma_known,
        )

    def part(logarithm: float) -> float:
        return math.exp(logarithm) * likelihood(logarithm)[1]

    best = minimize_scalar(lambda one: likelihood(one)[0], bounds=_RANGE, method="bounded")
    if part(_RANGE[0]) > 1.0 or part(_RANGE[1]) < 1.0:
        return min(1.0, part(float(best.x)))
    # The differences tell the level better than the residuals do, unless these contradict.
    whole_part = brentq(lambda one: math.log(part(one)), *_RANGE)
    contradicts = likelihood(whole_part)[0] - best.fun > _CONTRADICTION
    return min(1.0, part(float(best.x))) if contradicts else 1.0
