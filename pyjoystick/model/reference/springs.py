"""Force and stored energy of restrained preloaded springs, eqs. (6)-(8), and of what is built from them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pyjoystick.model.parameters.springs import ActuatorAssembly, RestrainedSpring, SegmentTable
from pyjoystick.support import FloatArray


def spring_force(spring: RestrainedSpring, x: ArrayLike) -> FloatArray:
    """Eqs. (6)-(8): force (N) of one restrained spring at contact travel x (m, any shape), same shape."""
    compression = np.asarray(x, dtype=np.float64) - spring.x_0
    restrained = (spring.k_h + spring.k_s) * compression
    released = spring.F_0 + spring.k_s * compression
    force = np.where(spring.k_h * compression <= spring.F_0, restrained, released)
    return np.where(compression <= 0.0, 0.0, force)


def spring_energy(spring: RestrainedSpring, x: ArrayLike) -> FloatArray:
    """Energy (J) stored in one restrained spring at travel x (m), same shape: the integral of its force."""
    compression = np.asarray(x, dtype=np.float64) - spring.x_0
    restrained = 0.5 * (spring.k_h + spring.k_s) * compression**2
    # The restraint gives back F_0^2/(2*k_h) while it goes slack.
    released = (spring.F_0 + 0.5 * spring.k_s * compression) * compression - 0.5 * spring.F_0**2 / spring.k_h
    energy = np.where(spring.k_h * compression <= spring.F_0, restrained, released)
    return np.where(compression <= 0.0, 0.0, energy)


def assembly_force(assembly: ActuatorAssembly, x: ArrayLike) -> FloatArray:
    """Force (N) of return and balance spring side by side (Fig. 7) at contact travel x (m), same shape."""
    return spring_force(assembly.return_spring, x) + spring_force(assembly.balance_spring, x)


def assembly_energy(assembly: ActuatorAssembly, x: ArrayLike) -> FloatArray:
    """Energy (J) stored in an assembly at travel x (m), same shape: the integral of its force."""
    return spring_energy(assembly.return_spring, x) + spring_energy(assembly.balance_spring, x)


def table_force(table: SegmentTable, x: ArrayLike) -> FloatArray:
    """Force (N) of a curve of straight segments (Fig. 7c) at contact travel x (m), same shape."""
    travel = np.asarray(x, dtype=np.float64)
    starts, stiffnesses = np.asarray(table.x), np.asarray(table.k)
    at_start = np.concatenate(([0.0], np.cumsum(stiffnesses[:-1] * np.diff(starts))))
    segment = np.maximum(np.searchsorted(starts, travel, side="right") - 1, 0)
    force = at_start[segment] + stiffnesses[segment] * (travel - starts[segment])
    return np.where(travel <= starts[0], 0.0, force)
