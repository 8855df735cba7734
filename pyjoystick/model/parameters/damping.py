"""The two damping laws: constant, and the power law of eq. (11)."""

from __future__ import annotations

from dataclasses import dataclass

from pyjoystick.support import ParameterError, finite, not_negative, positive


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstantDamping:
    """A constant damping coefficient.

    Attributes:
        C: damping coefficient (N m s/rad), 0 or more

    Raises:
        ParameterError: C is not finite or negative
    """

    C: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "C", not_negative("C", self.C, "N.m.s/rad"))


@dataclass(frozen=True, slots=True, kw_only=True)
class PowerLawDamping:
    """Eq. (11): C = alpha*A*|theta|^n + beta*B*|omega|^m, beta = 1 - alpha; A, n chosen by the sign of theta.

    Near zero |theta| and |omega| are rounded off to sqrt(theta^2 + eps_theta^2) and
    sqrt(omega^2 + eps_omega^2), because the exponents may be negative. theta in rad, omega in rad/s.

    Attributes:
        alpha: weight of the displacement term, 0 to 1
        A_pos, n_pos: coefficient (N m s/rad) and exponent for theta >= 0
        A_neg, n_neg: coefficient (N m s/rad) and exponent for theta < 0
        B, m: coefficient (N m s/rad) and exponent of the velocity term
        eps_theta: rounding-off angle (rad), above 0
        eps_omega: rounding-off angular velocity (rad/s), above 0

    Raises:
        ParameterError: a value is not finite or outside its range
    """

    alpha: float
    A_pos: float
    n_pos: float
    A_neg: float
    n_neg: float
    B: float
    m: float
    eps_theta: float = 1e-4
    eps_omega: float = 1e-3

    def __post_init__(self) -> None:
        alpha = not_negative("alpha", self.alpha)
        if alpha > 1.0:
            raise ParameterError("alpha", self.alpha, "between 0 and 1")
        object.__setattr__(self, "alpha", alpha)
        for name in ("A_pos", "A_neg", "B"):
            object.__setattr__(self, name, not_negative(name, getattr(self, name), "N.m.s/rad"))
        for name in ("n_pos", "n_neg", "m"):
            object.__setattr__(self, name, finite(name, getattr(self, name)))
        object.__setattr__(self, "eps_theta", positive("eps_theta", self.eps_theta, "rad"))
        object.__setattr__(self, "eps_omega", positive("eps_omega", self.eps_omega, "rad/s"))

    @property
    def beta(self) -> float:
        """Weight of the velocity term: 1 - alpha."""
        return 1.0 - self.alpha


Damping = ConstantDamping | PowerLawDamping
