"""Errors of angle, velocity and acceleration from markers, for a known motion.

The reference simulates a release. `error_budget` sends it through the stages one at a time and through all of
them. `chain_effect` shows the effect of the chain alone: the velocity of a joystick has a kink at its peaks,
in the middle position. The filter rounds them, so that the kinetic energy is too small there and nearly right
in between. The energy therefore seems to rise from each passage of the middle to the next turning point, as
in Fig. 12 of the paper.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from pyjoystick.laboratory.measurements.angle import measure_angle
from pyjoystick.laboratory.measurements.chain import Chain, Motion, derivative
from pyjoystick.laboratory.measurements.resampling import resample
from pyjoystick.laboratory.synthetic_laboratory.cameras import BASE, TOP, synthetic_markers
from pyjoystick.model import JoystickParameters, Trajectory, energy, simulate
from pyjoystick.support import FloatArray, TextTable, angle, positive

#: Duration of the hold, and end of the record (s).
_HELD, _END = 0.25, 3.0
#: Length of the record in which the peaks of the velocity are compared (s).
_RECORDED = 1.75


@dataclass(frozen=True, slots=True)
class StageError:
    """Root mean square errors of one stage, from the release to 1.5 s after it.

    Attributes:
        stage: name of the stage
        theta: error of the angle (rad)
        omega: error of the angular velocity (rad/s)
        alpha: error of the angular acceleration (rad/s2)
        period: relative error of the mean of the first three periods
    """

    stage: str
    theta: float
    omega: float
    alpha: float
    period: float


def mean_period(time: FloatArray, theta: FloatArray) -> float:
    """Mean of the first three periods of a released joystick (s), from zero crossings.

    Args:
        time: times (s), shape (n,)
        theta: angle (rad), shape (n,), with at least seven zero crossings
    """
    before = np.flatnonzero(np.diff(np.signbit(theta)))[:7]
    step = theta[before + 1] - theta[before]
    passages = time[before] - theta[before] / step * (time[before + 1] - time[before])
    return float(passages[6] - passages[0]) / 3.0


def error_budget(
    parameters: JoystickParameters,
    chain: Chain,
    *,
    release_angle: float,
    random: np.random.Generator,
    camera_rate: float = 60.0,
    noise: float = 3e-4,
    radius: float | None = None,
) -> list[StageError]:
    """Errors of each stage alone, and of all together.

    Args:
        parameters: the joystick
        chain: the chain
        release_angle: angle of hold and release (rad)
        random: random generator for the markers' noise
        camera_rate: frame rate (Hz); the chain's rate must be a multiple of it
        noise: standard deviation of the coordinates' noise (m)
        radius: measured distance from the pivot to the top marker (m), as in `measure_angle`

    Raises:
        ParameterError, SimulationError: as `simulate` does
        RecordError: the angle cannot be found from the markers
    """
    start = angle("release_angle", release_angle)
    every = round(chain.rate / positive("camera_rate", camera_rate, "Hz"))
    time = np.arange(math.floor(_END * chain.rate) + 1) / chain.rate
    after = time >= _HELD
    run = simulate(parameters, time=time[after], theta_start=start)
    true = np.zeros((3, len(time)))
    true[0] = start
    true[:, after] = run.theta, run.omega, run.alpha
    judged = after & (time <= _HELD + 1.5)
    return list(_stages(time, true, judged, every, chain, noise, radius, random))


def _stages(
    time: FloatArray,
    true: FloatArray,
    judged: np.ndarray,
    every: int,
    chain: Chain,
    noise: float,
    radius: float | None,
    random: np.random.Generator,
) -> Iterator[StageError]:
    def compared(stage: str, series: Sequence[FloatArray]) -> StageError:
        angle_error, velocity_error, acceleration_error = (
            float(np.sqrt(np.mean((one - exact)[judged] ** 2)))
            for one, exact in zip(series, true, strict=True)
        )
        period = mean_period(time, series[0]) / mean_period(time, theta) - 1.0
        return StageError(stage, angle_error, velocity_error, acceleration_error, abs(period))

    def differentiated(theta: FloatArray) -> Sequence[FloatArray]:
        rules = ((1, chain.velocity_points), (2, chain.acceleration_points))
        return theta, *(derivative(theta, 1.0 / chain.rate, order=k, points=n) for k, n in rules)

    def seen(instants: FloatArray, angles: FloatArray, scatter: float) -> tuple[FloatArray, FloatArray]:
        """The angle from the markers: as measured, and with the model's zero instead of the rest position."""
        markers = synthetic_markers(instants, angles, random=random, noise=scatter)
        found = measure_angle(markers, top=TOP, base=BASE, forward="x", radius=radius).theta
        # Zero is the rest position, which may be anywhere in the clearance.
        return found, found + float(np.mean((angles - found)[-10:]))

    frames, theta = time[::every], true[0]
    measured, moved = seen(frames, theta[::every], noise)

    def splined(values: FloatArray) -> FloatArray:
        return resample(frames, values, chain.rate, longest_gap=chain.longest_gap).values

    yield compared("differentiation", differentiated(theta))
    yield compared("filter", differentiated(chain.low_pass.filter(theta, chain.rate)))
    yield compared("camera's rate and spline", differentiated(splined(theta[::every])))
    yield compared("projection on the plane", differentiated(seen(time, theta, 0.0)[1]))
    yield compared("noise of the markers, pivot, spline", differentiated(splined(moved)))
    motion = chain.run(frames, moved)
    yield compared("all", (motion.theta, motion.omega, motion.alpha))
    unmoved = chain.run(frames, measured)
    yield compared("all, zero at rest", (unmoved.theta, unmoved.omega, unmoved.alpha))


def error_budget_report(budget: Sequence[StageError]) -> str:
    """The budget as a table in Markdown."""
    rows = [
        [
            one.stage,
            f"{math.degrees(one.theta):.4f}",
            f"{one.omega:.4f}",
            f"{one.alpha:.2f}",
            f"{100.0 * one.period:.3f}",
        ]
        for one in budget
    ]
    header = ["error, rms", "angle (deg)", "velocity (rad/s)", "acceleration (rad/s2)", "period (%)"]
    return TextTable(header, rows).markdown()


@dataclass(frozen=True, slots=True, eq=False)
class ChainEffect:
    """Effect of the chain on a simulated free oscillation, recorded by a camera without noise.

    Arrays over the peaks of the velocity have the shape (k,).

    Attributes:
        time: times of the true peaks (s)
        peak: true peaks of the angular velocity (rad/s), signed
        measured: the same peaks after the chain (rad/s): the largest value in the half period about each
        theta_error: rms difference of the angle after the release (rad)
        energy_start: energy at the release (J)
        energy_rise: largest rise of the energy, from the chain's angle and velocity, above its minimum so far
            (J)
        true_rise: the same for the true motion (J), zero up to rounding
        run: the true motion from the release
        motion: output of the chain, from the first frame
    """

    time: FloatArray
    peak: FloatArray
    measured: FloatArray
    theta_error: float
    energy_start: float
    energy_rise: float
    true_rise: float
    run: Trajectory
    motion: Motion

    @property
    def shortfall(self) -> FloatArray:
        """Relative loss of each peak, shape (k,)."""
        return 1.0 - self.measured / self.peak


def chain_effect(
    parameters: JoystickParameters,
    chain: Chain,
    *,
    release_angle: float,
    camera_rate: float = 60.0,
) -> ChainEffect:
    """Simulate a release with the reference, sample it as a camera does, and compare the chain's result.

    Args:
        parameters: the joystick
        chain: the chain
        release_angle: angle of hold and release (rad)
        camera_rate: frame rate (Hz)

    Raises:
        ParameterError, SimulationError: as `simulate` does
        SeriesError: the record is too short for the chain
    """
    frames = np.arange(math.floor(_RECORDED * camera_rate) + 1) / camera_rate
    even = np.arange(math.floor(_RECORDED * chain.rate) + 1) / chain.rate
    instants = np.unique(np.concatenate(([_HELD], frames, even)))
    moving = instants >= _HELD
    run = simulate(parameters, time=instants[moving], theta_start=release_angle)
    theta, omega = np.full(len(instants), release_angle), np.zeros(len(instants))
    theta[moving], omega[moving] = run.theta, run.omega
    motion = chain.run(frames, theta[np.searchsorted(instants, frames)])
    true = np.searchsorted(instants, even)[: len(motion.time)]
    after = motion.time >= _HELD
    peaks = _peaks(run.omega)
    middles = (run.time[peaks][1:] + run.time[peaks][:-1]) / 2.0
    end = run.time[peaks[-1]] + (run.time[peaks[-1]] - middles[-1])
    borders = np.searchsorted(motion.time[after], np.append(middles, end))
    parts = np.split(motion.omega[after], borders)[:-1]
    signs = np.sign(run.omega[peaks])
    measured = [sign * np.max(sign * part) for sign, part in zip(signs, parts, strict=True)]
    # Start at the first peak, because near the release the chain has not seen the whole motion.
    judged = motion.time >= run.time[peaks[0]]
    found = energy(parameters, motion.theta[judged], motion.omega[judged])
    return ChainEffect(
        time=run.time[peaks],
        peak=run.omega[peaks],
        measured=np.array(measured),
        theta_error=float(np.sqrt(np.mean((motion.theta - theta[true])[after] ** 2))),
        energy_start=float(run.E[0]),
        energy_rise=_rise(found),
        true_rise=_rise(run.E),
        run=run,
        motion=motion,
    )


def _peaks(omega: FloatArray) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    """Indices of the largest magnitude between sign changes, without the last swing, which is cut off.

    Swings below 5 % of the largest do not count.
    """
    turns = np.flatnonzero(np.diff(np.sign(omega)) != 0.0) + 1
    edges = np.concatenate(([0], turns))
    found = [a + int(np.argmax(np.abs(omega[a:b]))) for a, b in pairwise(edges) if b > a]
    return np.array([i for i in found if abs(omega[i]) > 0.05 * np.max(np.abs(omega))], dtype=np.intp)


def _rise(values: FloatArray) -> float:
    return float(np.max(values - np.minimum.accumulate(values)))
