"""Oracles of Constraints.mo: harmonic oscillators whose inertia includes the attached parts."""

from __future__ import annotations

from functools import partial

import numpy as np
from scipy.optimize import brentq

from ..case import Array, Case, Values


def _geared(t: Array, ratio: float = 2.0) -> Values:
    omega = np.sqrt(8.0 / (1.0 + 0.25 * ratio**2))
    slow, speed = 0.1 * np.cos(omega * t), -0.1 * omega * np.sin(omega * t)
    return {
        "slow.phi": slow,
        "slow.w": speed,
        "fast.phi": ratio * slow,
        "fast.w": ratio * speed,
        "spring.phi_rel": -slow,
        "gear.a.tau": 0.25 * ratio * omega**2 * slow,
    }


def _carried(t: Array, k: float = 50.0, amplitude: float = 0.2) -> Values:
    m_1, m_2, omega = 2.0, 0.5, 3.0
    own = np.sqrt(k / (m_1 + m_2))
    forced = m_2 * amplitude * omega**2 / (k - (m_1 + m_2) * omega**2)
    x = 0.1 * np.cos(own * t) - forced * omega / own * np.sin(own * t) + forced * np.sin(omega * t)
    a = (m_2 * amplitude * omega**2 * np.sin(omega * t) - k * x) / (m_1 + m_2)
    return {"x_1": x, "x_2": x + amplitude * np.sin(omega * t), "F": -k * x - m_1 * a}


_BOUNCE = brentq(lambda t: 0.2 - 0.5 * (t + np.sin(t)), 0.1, 0.5, xtol=1e-15)


def _bounced(t: Array) -> Values:
    """The sum of the momenta is kept but at the bounce: v falls short of -1/2 by half the sine's speed."""
    before = -0.5 * (1 + np.cos(t))
    jump = 1 + np.cos(_BOUNCE)
    after = t >= _BOUNCE
    v = before + np.where(after, jump, 0.0)
    a = 0.2 - 0.5 * (t + np.sin(t)) + np.where(after, jump * (t - _BOUNCE), 0.0)
    return {"a": a, "v": v, "b": a + np.sin(t), "w": v + np.cos(t), "F": -0.5 * np.sin(t)}


def _stopped(t: Array) -> Values:
    """The speed between the bodies decays; the second one keeps its own speed when the first is stopped."""
    speed = 0.5 * (2.2 + 0.2 * np.exp(-1.0))
    after = t >= 0.5
    total = np.where(after, speed, 2.2)
    v_rel = np.where(after, speed * np.exp(1.0 - 2 * t), 0.2 * np.exp(-2 * t))
    return {"v_1": 0.5 * (total - v_rel), "v_2": 0.5 * (total + v_rel), "v_rel": v_rel}


CASES = (
    Case("Constraints.Geared", 3.0, _geared),
    Case("Constraints.Geared", 3.0, partial(_geared, ratio=-3.0), parameters={"ratio": -3.0}, label="turned"),
    Case("Constraints.Selected", 3.0, _geared),
    Case("Constraints.Carried", 2.0, _carried),
    Case(
        "Constraints.Carried",
        2.0,
        partial(_carried, k=80.0, amplitude=-0.1),
        parameters={"k": 80.0, "amplitude": -0.1},
        label="stiff",
    ),
    Case("Constraints.Bounced", 1.0, _bounced, events=lambda _: np.array([_BOUNCE])),
    Case("Constraints.Stopped", 1.5, _stopped, events=lambda _: np.array([0.5])),
)
