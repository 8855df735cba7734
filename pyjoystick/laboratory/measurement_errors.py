"""The error budget of the way from markers to angle, velocity and acceleration: a stage at a time.

A release is simulated by the reference, so that everything is known, and goes through the stages one by one
and through all of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from pyjoystick.laboratory.measurements.angle import measure_angle
from pyjoystick.laboratory.measurements.chain import Chain
from pyjoystick.laboratory.measurements.finite_differences import derivative
from pyjoystick.laboratory.measurements.resampling import resample
from pyjoystick.laboratory.synthetic_laboratory.motion_capture import BASE, TOP, synthetic_markers
from pyjoystick.model import JoystickParameters, simulate
from pyjoystick.support import FloatArray, TextTable, angle, positive

#: Held, moving and then at rest (s).
_HELD, _END = 0.25, 3.0


@dataclass(frozen=True, slots=True)
class StageError:
    """Root mean square errors that a stage makes, over the time from the release to 1.5 s after it.

    Attributes:
        stage: what it is
        theta: of the angle (rad)
        omega: of the angular velocity (rad/s)
        alpha: of the angular acceleration (rad/s2)
        period: error of the mean of the first three periods, in parts of it
    """

    stage: str
    theta: float
    omega: float
    alpha: float
    period: float


def mean_period(time: FloatArray, theta: FloatArray) -> float:
    """The mean of the first three periods of a released joystick (s), from the passages of zero.

    Args:
        time: instants (s), shape (n,)
        theta: angle there (rad), shape (n,), which passes zero seven times or more
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
    """Errors of the stages alone, and of all together.

    Args:
        parameters: the joystick
        chain: the chain
        release_angle: angle of hold and release (rad)
        random: where the markers' noise comes from
        camera_rate: frames a second (Hz), of which the chain's rate is a multiple
        noise: standard deviation of the coordinates' noise (m)
        radius: from the pivot to the top marker (m), where it was measured, as of `measure_angle`

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
        """The angle from the markers: as it is, and with the zero of the model in place of the rest."""
        markers = synthetic_markers(instants, angles, random=random, noise=scatter)
        found = measure_angle(markers, top=TOP, base=BASE, forward="x", radius=radius).theta
        # Zero is the rest position, which may lie anywhere in the clearance.
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
