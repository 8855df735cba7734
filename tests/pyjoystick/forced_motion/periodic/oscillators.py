"""Forced oscillators made of two linear pieces: their flow, and their periodic solutions in closed form.

    x'' + 2 zeta x' + k x + p = A cos(omega t + phase),   k, p = left where x < d, right where x > d

With two stiffnesses and no preload this is the oscillator of Shaw and Holmes (J. Sound Vib. 90 (1983)
129-155); with one stiffness and opposite p it is the preload nonlinearity of Duan and Singh (2007), a spring
that its preload holds in the middle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from pyjoystick.support import FloatArray


@dataclass(frozen=True)
class Piece:
    """One side: stiffness and constant force, and the damping of both."""

    k: float
    p: float
    zeta: float

    def transition(self, t: float) -> FloatArray:
        """The free motion over a time t, as a matrix; k > zeta^2."""
        w = math.sqrt(self.k - self.zeta**2)
        matrix = np.array([[0.0, 1.0], [-self.k, -2.0 * self.zeta]]) + self.zeta * np.eye(2)
        return math.exp(-self.zeta * t) * (math.cos(w * t) * np.eye(2) + math.sin(w * t) / w * matrix)

    def forced(self, omega: float, phase: float) -> FloatArray:
        """What a force cos(phase) makes of x and x', whatever the start, without the constant part."""
        response = np.exp(1j * phase) / (self.k - omega**2 + 2j * self.zeta * omega)
        return np.array([response.real, (1j * omega * response).real])

    def after(self, t: float, state: FloatArray, omega: float, phase: float, amplitude: float) -> FloatArray:
        """The state a time t after `state`, at which the force is A cos(phase)."""
        rest = np.array([-self.p / self.k, 0.0])
        start = state - rest - amplitude * self.forced(omega, phase)
        end = rest + amplitude * self.forced(omega, phase + omega * t)
        found: FloatArray = self.transition(t) @ start + end
        return found


@dataclass(frozen=True)
class Oscillator:
    """Two pieces that meet at x = d; periods are counted from a phase of the force.

    Where the preload jumps, the map has a kink if the motion passes d at that phase.
    """

    left: Piece
    right: Piece
    d: float
    phase: float = 0.0

    def image(self, state: FloatArray, amplitude: float, omega: float, samples: int = 40) -> FloatArray:
        """The state one period of the force later; passages of d are located to rounding."""
        now, time, period = state.copy(), 0.0, 2.0 * math.pi / omega
        while True:
            side = math.copysign(1.0, now[0] - self.d or now[1])
            piece = self.right if side > 0.0 else self.left

            def aside(
                t: float,
                piece: Piece = piece,
                now: FloatArray = now,
                phase: float = self.phase + omega * time,
                side: float = side,
            ) -> float:
                return side * float(piece.after(t, now, omega, phase, amplitude)[0] - self.d)

            step = (period - time) / samples
            ends = (step * i for i in range(1, samples + 1))
            crossing = next((end for end in ends if aside(end) < 0.0), None)
            if crossing is None:
                return piece.after(period - time, now, omega, self.phase + omega * time, amplitude)
            first = max(crossing - step, 1e-6 * step)
            span = float(brentq(aside, first, crossing, xtol=1e-15, rtol=1e-15))
            now = piece.after(span, now, omega, self.phase + omega * time, amplitude)
            now[0] = self.d
            time += span


@dataclass(frozen=True)
class Orbit:
    """A periodic motion that passes d twice a period, in closed form.

    Attributes:
        amplitude: A
        state: where it is at the phase of the oscillator
        multipliers: larger magnitude first
    """

    amplitude: float
    state: FloatArray
    multipliers: np.ndarray


def orbit_of_dwell(system: Oscillator, omega: float, dwell: float) -> Orbit:
    """The orbit of Shaw and Holmes that stays on the right for a time `dwell` of each period.

    On each side the motion is linear in the speed of entry v and in the force P cos + Q sin, counted from the
    entry on. To leave at d, to enter at d, and to enter with v again are three linear equations for v, P
    and Q; A^2 = P^2 + Q^2. The branch is thereby a function of the dwell.
    """
    right, left = system.right, system.left
    rest = 2.0 * math.pi / omega - dwell

    def ends(unknown: FloatArray) -> tuple[FloatArray, FloatArray]:
        v, cosine, sine = unknown
        amplitude, phase = math.hypot(cosine, sine), math.atan2(-sine, cosine)
        out = right.after(dwell, np.array([system.d, v]), omega, phase, amplitude)
        back = left.after(rest, out, omega, phase + omega * dwell, amplitude)
        return out, back

    def left_over(unknown: FloatArray) -> FloatArray:
        out, back = ends(unknown)
        return np.array([out[0] - system.d, back[0] - system.d, back[1] - unknown[0]])

    constant = left_over(np.zeros(3))
    matrix = np.column_stack([left_over(unit) - constant for unit in np.eye(3)])
    v, cosine, sine = np.linalg.solve(matrix, -constant)
    amplitude, phase = math.hypot(cosine, sine), math.atan2(-sine, cosine)
    # `phase` is that of the entry: so long after it the periods are counted.
    wait = ((system.phase - phase) % (2.0 * math.pi)) / omega
    entry = np.array([system.d, v])
    if wait < dwell:
        state = right.after(wait, entry, omega, phase, amplitude)
    else:
        out = ends(np.array([v, cosine, sine]))[0]
        state = left.after(wait - dwell, out, omega, phase + omega * dwell, amplitude)
    # The force is continuous at d: the monodromy is the product of both free motions.
    return Orbit(amplitude, state, _ordered(left.transition(rest) @ right.transition(dwell)))


def symmetric_orbit(system: Oscillator, amplitude: float, omega: float, branch: int) -> Orbit:
    """The symmetric orbit of a preload +-p on a spring, `branch` +1 or -1; they meet where X = |S|.

    For half a period x = -p/k + X sin(omega t + psi) + exp(-zeta t) (a cos w t + b sin w t), from x = 0 to
    x = 0 and from v to -v. The harmonic part changes its sign over that time: two linear equations for a and
    b remain, and X sin(psi) = S = p/k - a, X cos(psi) = +-sqrt(X^2 - S^2).
    """
    a, b, s, largest = _preload_constants(system, omega)
    piece = system.right
    x = amplitude * largest
    cosine = branch * math.sqrt(x**2 - s**2)
    w = math.sqrt(piece.k - piece.zeta**2)
    v = omega * cosine - piece.zeta * a + w * b
    psi = math.atan2(s, cosine)
    # X sin(omega t + psi) is the response to A cos(omega t + phase).
    lag = np.angle(1.0 / (piece.k - omega**2 + 2j * piece.zeta * omega))
    phase = psi - 0.5 * math.pi - lag
    wait, half = ((system.phase - phase) % (2.0 * math.pi)) / omega, math.pi / omega
    entry = np.array([0.0, v])
    if wait < half:
        state = piece.after(wait, entry, omega, phase, amplitude)
    else:
        state = system.left.after(wait - half, -entry, omega, phase + math.pi, amplitude)
    # The preload jumps by -2 p as the motion leaves: the slope of its speed over the instant of passage.
    jump = np.array([[1.0, 0.0], [2.0 * piece.p / -v, 1.0]])
    flip = jump @ piece.transition(half)
    return Orbit(amplitude, state, _ordered(flip @ flip))


def preload_fold(system: Oscillator, omega: float) -> float:
    """The amplitude A where both symmetric orbits of `symmetric_orbit` meet: X = |S|."""
    _, _, s, largest = _preload_constants(system, omega)
    return abs(s) / largest


def _preload_constants(system: Oscillator, omega: float) -> tuple[float, float, float, float]:
    """a, b, S and the response X to a force of amplitude 1."""
    piece = system.right
    w, half = math.sqrt(piece.k - piece.zeta**2), math.pi / omega
    decay = math.exp(-piece.zeta * half)
    c, s = decay * math.cos(w * half), decay * math.sin(w * half)
    zeta, offset = piece.zeta, piece.p / piece.k
    matrix = np.array(
        [[1.0 + c, s], [-zeta - zeta * c - w * s, w - zeta * s + w * c]],
    )
    a, b = np.linalg.solve(matrix, np.array([2.0 * offset, 0.0]))
    largest = 1.0 / abs(piece.k - omega**2 + 2j * zeta * omega)
    return a, b, offset - a, largest


def _ordered(monodromy: FloatArray) -> np.ndarray:
    values = np.linalg.eigvals(monodromy).astype(complex)
    return values[np.argsort(-np.abs(values), kind="stable")]
