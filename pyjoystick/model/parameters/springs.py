"""Restrained preloaded springs (eqs. 6-8) and the actuator assembly made of two of them (Fig. 7, Table 1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from pyjoystick.support import ParameterError, not_negative, positive

#: x_1 = x_0 + F_0/k_h is computed, so where it should equal x_2 it may exceed it by rounding.
_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True)
class RestrainedSpring:
    """A spring held at a preload by a restraint (rod or housing) that carries tension only (eqs. 6-8).

    Attributes:
        k_s: stiffness of the spring (N/m), above 0
        k_h: stiffness of the restraint (N/m), above 0
        F_0: preload (N), 0 or more
        x_0: contact travel at which the spring engages (m), 0 or more

    Raises:
        ParameterError: a value is not finite or outside its range
    """

    k_s: float
    k_h: float
    F_0: float
    x_0: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "k_s", positive("k_s", self.k_s, "N/m"))
        object.__setattr__(self, "k_h", positive("k_h", self.k_h, "N/m"))
        object.__setattr__(self, "F_0", not_negative("F_0", self.F_0, "N"))
        object.__setattr__(self, "x_0", not_negative("x_0", self.x_0, "m"))

    @property
    def x_release(self) -> float:
        """Contact travel at which the restraint goes slack (m): the compression is then F_0/k_h."""
        return self.x_0 + self.F_0 / self.k_h


@dataclass(frozen=True, slots=True)
class SegmentTable:
    """A load-deflection curve of straight segments: stiffness k[i] (N/m) from travel x[i] (m) to x[i+1].

    The force is zero up to x[0]; the last segment has no end. Any number of segments.

    Raises:
        ParameterError: a value is not finite, a travel is negative or below the one before it,
            a stiffness is not above 0, or the two lists differ in length or are empty
    """

    x: tuple[float, ...]
    k: tuple[float, ...]

    def __post_init__(self) -> None:
        x = tuple(not_negative(f"x[{i}]", value, "m") for i, value in enumerate(self.x))
        k = tuple(positive(f"k[{i}]", value, "N/m") for i, value in enumerate(self.k))
        if not x or len(x) != len(k):
            raise ParameterError(
                "k", k, f"as many stiffnesses as travels, at least one, not {len(k)} for {len(x)}"
            )
        require_increasing([f"x[{i}]" for i in range(len(x))], x)
        object.__setattr__(self, "x", x)
        object.__setattr__(self, "k", k)


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorAssembly:
    """Return spring and balance spring side by side; their kinks x_0 <= x_1 <= x_2 <= x_3 bound the segments.

    Attributes:
        return_spring: engages at the clearance x_0, its restraint goes slack at x_1
        balance_spring: engages at x_2 where the rod bottoms out, its restraint goes slack at x_3

    Raises:
        ParameterError: the balance spring engages before the return spring has been released
    """

    return_spring: RestrainedSpring
    balance_spring: RestrainedSpring

    def __post_init__(self) -> None:
        x_1, x_2 = self.return_spring.x_release, self.balance_spring.x_0
        if x_2 < x_1 * (1.0 - _ROUNDING):
            raise ParameterError(
                "balanceSpring.x_0",
                x_2,
                f"at least {x_1:.9g} m, where the restraint of the return spring goes slack (x_0 + F_0/k_h)",
            )

    @property
    def kinks(self) -> tuple[float, float, float, float]:
        """The contact travels x_0, x_1, x_2, x_3 of Table 1 (m), not decreasing."""
        x_1 = self.return_spring.x_release
        x_2 = max(x_1, self.balance_spring.x_0)
        return self.return_spring.x_0, x_1, x_2, max(x_2, self.balance_spring.x_release)

    @classmethod
    def from_table(cls, x: Sequence[float], k: Sequence[float]) -> ActuatorAssembly:
        """The assembly of a four-segment curve in the form of Table 1.

        Args:
            x: the travels x_0 .. x_3 (m), not decreasing
            k: the stiffnesses k_0 .. k_3 (N/m) with k_0 > k_1, k_3 > k_1 and k_2 > k_3

        Raises:
            ParameterError: not four segments, or stiffnesses that no pair of restrained springs has
        """
        table = SegmentTable(tuple(x), tuple(k))
        if len(table.x) != 4:
            raise ParameterError("x", table.x, "four travels x_0 .. x_3")
        x_0, x_1, x_2, x_3 = table.x
        k_0, k_1, k_2, k_3 = table.k
        for field, stiff, name, soft in (
            ("k[0]", k_0, "k[1]", k_1),
            ("k[3]", k_3, "k[1]", k_1),
            ("k[2]", k_2, "k[3]", k_3),
        ):
            if stiff <= soft:
                raise ParameterError(field, stiff, f"above {name} = {soft:.9g} N/m")
        return cls(
            return_spring=RestrainedSpring(k_s=k_1, k_h=k_0 - k_1, F_0=(k_0 - k_1) * (x_1 - x_0), x_0=x_0),
            balance_spring=RestrainedSpring(
                k_s=k_3 - k_1, k_h=k_2 - k_3, F_0=(k_2 - k_3) * (x_3 - x_2), x_0=x_2
            ),
        )

    def to_table(self) -> SegmentTable:
        """The same assembly in the form of Table 1: four travels (m) and four stiffnesses (N/m)."""
        first, second = self.return_spring, self.balance_spring
        k_3 = first.k_s + second.k_s
        return SegmentTable(self.kinks, (first.k_s + first.k_h, first.k_s, k_3 + second.k_h, k_3))


def require_increasing(fields: Sequence[str], values: Sequence[float]) -> None:
    """Raise ParameterError naming the first of `values` that lies below the one before it."""
    for i in range(1, len(values)):
        if values[i] < values[i - 1]:
            raise ParameterError(fields[i], values[i], f"at least {fields[i - 1]} = {values[i - 1]:.9g} m")
