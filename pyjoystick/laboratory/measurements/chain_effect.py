"""What the chain makes of a motion that is known: lower peaks of the velocity, and energy that seems to rise.

The velocity of a joystick has a kink wherever it passes the middle, at its peaks: the filter rounds them, so
that the kinetic energy there is too small, while in between it is nearly right. The energy then rises from
each passage of the middle to the next turning point, as in Fig. 12 of the paper.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from pyjoystick.laboratory.measurements.chain import Chain, Motion
from pyjoystick.model import JoystickParameters, Trajectory, energy, simulate
from pyjoystick.support import FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class ChainEffect:
    """The chain on a simulated free oscillation that a camera without noise has seen.

    Arrays over the peaks of the velocity have the shape (k,).

    Attributes:
        time: instants of the true peaks (s)
        peak: true peaks of the angular velocity (rad/s), with their signs
        measured: what the chain makes of them (rad/s): its largest in the half period about each
        theta_error: rms difference of the angle after the release (rad)
        energy_start: energy at the release (J)
        energy_rise: how far the energy from the chain's angle and velocity rises above its least before (J)
        true_rise: the same of the true motion (J), zero but for rounding
        run: the true motion from the release on
        motion: what the chain gives, from the first frame on
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
        """Part of each peak that is lost, shape (k,)."""
        return 1.0 - self.measured / self.peak


def chain_effect(
    parameters: JoystickParameters,
    chain: Chain,
    *,
    release_angle: float,
    camera_rate: float = 60.0,
    duration: float = 1.75,
    release_time: float = 0.25,
) -> ChainEffect:
    """Simulate a release by the reference, sample it as a camera does, and compare the chain's result.

    Args:
        parameters: the joystick
        chain: the chain
        release_angle: angle of hold and release (rad)
        camera_rate: frames a second (Hz)
        duration: length of the record (s)
        release_time: how long the joystick is held first (s)

    Raises:
        ParameterError, SimulationError: as `simulate` does
        SeriesError: the record is too short for the chain
    """
    frames = np.arange(math.floor(duration * camera_rate) + 1) / camera_rate
    even = np.arange(math.floor(duration * chain.rate) + 1) / chain.rate
    instants = np.unique(np.concatenate(([release_time], frames, even)))
    moving = instants >= release_time
    run = simulate(parameters, time=instants[moving], theta_start=release_angle)
    theta, omega = np.full(len(instants), release_angle), np.zeros(len(instants))
    theta[moving], omega[moving] = run.theta, run.omega
    motion = chain.run(frames, theta[np.searchsorted(instants, frames)])
    true = np.searchsorted(instants, even)[: len(motion.time)]
    after = motion.time >= release_time
    peaks = _peaks(run.omega)
    middles = (run.time[peaks][1:] + run.time[peaks][:-1]) / 2.0
    end = run.time[peaks[-1]] + (run.time[peaks[-1]] - middles[-1])
    borders = np.searchsorted(motion.time[after], np.append(middles, end))
    parts = np.split(motion.omega[after], borders)[:-1]
    signs = np.sign(run.omega[peaks])
    measured = [sign * np.max(sign * part) for sign, part in zip(signs, parts, strict=True)]
    # Near the release the chain has not seen the motion whole: the first peak is where the judging begins.
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
    """Indices of the largest magnitude between two changes of sign; the last swing, cut off, does not count.

    Nor do swings below 5 % of the largest.
    """
    turns = np.flatnonzero(np.diff(np.sign(omega)) != 0.0) + 1
    edges = np.concatenate(([0], turns))
    found = [a + int(np.argmax(np.abs(omega[a:b]))) for a, b in pairwise(edges) if b > a]
    return np.array([i for i in found if abs(omega[i]) > 0.05 * np.max(np.abs(omega))], dtype=np.intp)


def _rise(values: FloatArray) -> float:
    return float(np.max(values - np.minimum.accumulate(values)))
