"""Vibration feedthrough: how far a handle moves, relative to its base and in space, when the base shakes.

The base moves in one of three directions in the plane of the handle, and with the moment
m*h*(a_base_z*sin(theta) - a_base*cos(theta)) - J*alpha_base leaves the handle behind. A hand holds the handle
at an angle: a spring and a damper about the pivot whose other end moves with the base, as the operator's seat
does, and a mass at the grip.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from pyjoystick.fmu import Fmu, Linearization, UnsupportedFmuError, Value
from pyjoystick.forced_motion.sine import ROWS, sine_table
from pyjoystick.forced_motion.vibration.direction import ALONG, TURNING, UPWARD, Direction
from pyjoystick.model import PIVOT_TO_TOP, JoystickParameters, values_for
from pyjoystick.support import FloatArray, ParameterError, angle, not_negative, positive

#: The part of the motion at the beginning that may be left in what is measured, and in its fundamental from
#: one period to the next.
_TRANSIENT: Final = 1e-5
_STEADY: Final = 1e-3
#: Periods of further runs where a motion is not steady when small ones would be.
_LONGER: Final = (50, 200)
_NEEDED: Final = (ALONG, UPWARD, TURNING, "theta_ref", "grip", "hand.K", "hand.D", "stops.theta_stop")


@dataclass(frozen=True, slots=True, kw_only=True)
class Hand:
    """A hand that holds the handle.

    Attributes:
        stiffness: of hand and arm about the pivot (N m/rad), 0 or more; the default is the library's
        damping: the same (N m s/rad), 0 or more
        mass: what of hand and arm moves with the handle (kg), 0 or more; its weight rests on the handle
        distance: from the pivot to the grip (m), above 0

    Raises:
        ParameterError: a value is not finite or outside its range
    """

    stiffness: float = 25.0
    damping: float = 0.7
    mass: float = 0.0
    distance: float = PIVOT_TO_TOP

    def __post_init__(self) -> None:
        not_negative("stiffness", self.stiffness, "N.m/rad")
        not_negative("damping", self.damping, "N.m.s/rad")
        not_negative("mass", self.mass, "kg")
        positive("distance", self.distance, "m")

    def on(self, joystick: JoystickParameters) -> JoystickParameters:
        """The joystick with the mass of the hand at the grip as a part of its handle."""
        mass = joystick.m + self.mass
        moment = joystick.m * joystick.h + self.mass * self.distance
        inertia = joystick.J + self.mass * self.distance**2
        return dataclasses.replace(joystick, J=inertia, m=mass, h=moment / mass if mass else 0.0)


class MountedHandle:
    """A handle that is held at an angle on a base that shakes.

    A steady torque balances springs and weight at that angle; the hand, if there is one, is relaxed there.
    """

    def __init__(
        self,
        fmu: Fmu,
        joystick: JoystickParameters,
        held: float,
        hand: Hand | None = None,
        *,
        direction: Direction = Direction.HORIZONTAL,
        pivot_to_top: float = PIVOT_TO_TOP,
    ) -> None:
        """Find how small motions about the angle go.

        Args:
            fmu: ``MountedJoystick`` or ``MountedJoystickPowerLaw``, as the joystick's damping law is
            joystick: the joystick, without dry friction
            held: the angle (rad)
            hand: the hand; None where nothing but the torque holds the handle
            direction: how the base shakes; pitch is about the pivot
            pivot_to_top: where the handle's motion in space is seen (m)

        Raises:
            UnsupportedFmuError: the FMU has no base or no hand
            ParameterError: the joystick has dry friction, by which small motions stick; the angle is beyond a
                stop; or the handle would not stay there
        """
        missing = [name for name in _NEEDED if name not in fmu.description.variables]
        if missing:
            raise UnsupportedFmuError(
                fmu.description.path, f"is not a MountedJoystick: no {', '.join(missing)}"
            )
        if joystick.friction:
            raise ParameterError("friction", joystick.friction, "none: small motions would stick")
        self.held = angle("held", held)
        if joystick.stops and abs(held) >= joystick.stops.theta_stop:
            allowed = f"within the stops at {joystick.stops.theta_stop:.6g} rad"
            raise ParameterError("held", held, allowed)
        self.fmu = fmu
        self.joystick = joystick if hand is None else hand.on(joystick)
        if direction not in tuple(Direction):
            raise ParameterError("direction", direction, f"one of {', '.join(Direction)}")
        self.direction = direction = Direction(direction)
        if direction is Direction.VERTICAL and held == 0.0:
            allowed = "other than 0: a base that goes up and down does not move an upright handle"
            raise ParameterError("held", held, allowed)
        self._arm = direction.arm(held, positive("pivot_to_top", pivot_to_top, "m"))
        self._parameters: dict[str, Value] = {
            **values_for(self.joystick, fmu.description.variables),
            "theta_start": held,
        }
        self._inputs = {"theta_ref": held, "grip": 0.0 if hand is None else 1.0}
        if hand is not None:
            self._parameters |= {"hand.K": hand.stiffness, "hand.D": hand.damping}
        free = fmu.linearize(parameters=self._parameters, inputs=self._inputs).point
        self._inputs["T"] = float(free["M_s"] - free["M_g"])
        if self.decay <= 0.0:
            allowed = "an angle at which springs or a hand keep it: small motions about this one grow"
            raise ParameterError("held", held, allowed)

    @cached_property
    def linearization(self) -> Linearization:
        """Small motions about the angle, from the FMU's derivatives."""
        return self.fmu.linearize(parameters=self._parameters, inputs=self._inputs, outputs=["theta"])

    @property
    def decay(self) -> float:
        """The rate (1/s) at which the slowest part of a small motion decays."""
        return -float(self.linearization.poles()["real"].max())

    def small(self, frequencies: ArrayLike) -> pd.DataFrame:
        """What small vibrations do: the frequency response of the linearized joystick.

        Args:
            frequencies: Hz, above 0, shape (n,)

        Returns:
            indexed by ``frequency`` (Hz): ``gain``, the amplitude of the angle over that of the base's
            acceleration (rad over `Direction.unit`); ``phase`` of the angle against it (rad); and
            ``transmissibility``, the acceleration in space over that of the base (1): that of the top in the
            same direction, with pitch the handle's angular acceleration

        Raises:
            ParameterError: a frequency is not above 0
        """
        rates = _checked(frequencies)
        return self._table(rates, self._responses(rates))

    def driven(self, frequencies: ArrayLike, acceleration: float) -> pd.DataFrame:
        """What vibrations of any size do: the fundamental of the steady motion, from runs of the FMU.

        Args:
            frequencies: Hz, above 0, shape (n,)
            acceleration: amplitude of the base's acceleration (`Direction.unit`), above 0

        Returns:
            the columns of `small`, and ``theta_max`` and ``theta_min`` (rad); NaN where the motion does not
            repeat with its period within 200 periods: it is chaotic, or takes several periods to repeat

        Raises:
            ParameterError: a frequency or the acceleration is not above 0, or the base would turn over
            FmuRunError: a run fails, as where the handle falls to pi/2
        """
        size = positive("acceleration", acceleration, self.direction.unit)
        rates = _checked(frequencies)
        found = [self._fundamental(float(frequency), size) for frequency in rates]
        table = self._table(rates, np.array([response for response, _, _ in found]))
        table["theta_max"] = [high for _, high, _ in found]
        table["theta_min"] = [low for _, _, low in found]
        return table

    def _responses(self, frequencies: FloatArray) -> np.ndarray[tuple[int], np.dtype[np.complex128]]:
        """The angle over the base's acceleration, of small ones."""
        found, gravity = self.linearization, self.joystick.g
        names = list(self.direction.shares(1.0, gravity))
        a, b, c, d = (one.to_numpy() for one in (found.A, found.B[names], found.C, found.D[names]))
        responses = []
        for frequency in frequencies:
            parts = np.array(list(self.direction.shares(float(frequency), gravity).values()))
            states = np.linalg.solve(2j * np.pi * frequency * np.eye(len(a)) - a, b @ parts)
            responses.append(complex(c[0] @ states + d[0] @ parts))
        return np.array(responses)

    def _fundamental(self, frequency: float, acceleration: float) -> tuple[complex, float, float]:
        """The angle over the acceleration as `small` has it, and the largest and smallest angle (rad)."""
        turn = np.exp(-2j * np.pi * np.arange(1, ROWS + 1) / ROWS)
        small = math.ceil(frequency * -math.log(_TRANSIENT) / self.decay) + 2
        for periods in (small, *(longer for longer in _LONGER if longer > small)):
            theta = self._last_periods(frequency, acceleration, periods)
            before, last = 2.0 / ROWS * theta @ turn
            if abs(last - before) <= _STEADY * abs(last):
                return 1j * complex(last) / acceleration, float(theta.max()), float(theta.min())
        return complex(math.nan, math.nan), math.nan, math.nan

    def _last_periods(self, frequency: float, acceleration: float, periods: int) -> FloatArray:
        """The angle (rad) in the last two of 3 or more periods from rest, shape (2, `ROWS`)."""
        inputs = self._shaking(frequency, acceleration, periods).assign(**self._inputs)
        time = np.append(0.0, inputs.index[-2 * ROWS - 1 :])
        plan = self.fmu.plan(time, parameters=self._parameters, inputs=inputs, outputs=["theta"])
        # By the compiled loop, which a single `Fmu.run` does without: there are 1e5 rows and more.
        return plan.run()[-2 * ROWS :].reshape(2, ROWS)

    def _shaking(self, frequency: float, acceleration: float, periods: int) -> pd.DataFrame:
        """The base's acceleration as inputs of the FMU, see `sine_table`; raises ParameterError."""
        if self.direction is not Direction.PITCH:
            (name,) = self.direction.shares(frequency, self.joystick.g)
            return sine_table(name, acceleration, frequency, periods)
        square = (2.0 * math.pi * frequency) ** 2
        if acceleration > 0.5 * math.pi * square:
            allowed = f"at most {0.5 * math.pi * square:.4g} rad/s2 at {frequency:g} Hz: the base turns over"
            raise ParameterError("acceleration", acceleration, allowed)
        table = sine_table(TURNING, acceleration, frequency, periods)
        turn, gravity = table[TURNING] / -square, self.joystick.g
        return table.assign(**{ALONG: -gravity * np.sin(turn), UPWARD: gravity * (np.cos(turn) - 1.0)})

    def _table(
        self, frequencies: FloatArray, responses: np.ndarray[tuple[int], np.dtype[np.complex128]]
    ) -> pd.DataFrame:
        in_space = 1.0 - self._arm * (2.0 * np.pi * frequencies) ** 2 * responses
        return pd.DataFrame(
            {
                "gain": np.abs(responses),
                "phase": np.angle(responses),
                "transmissibility": np.abs(in_space),
            },
            index=pd.Index(frequencies, name="frequency"),
        )


def _checked(frequencies: ArrayLike) -> FloatArray:
    values = np.atleast_1d(np.asarray(frequencies, dtype=np.float64))
    return np.array([positive("frequencies", float(value), "Hz") for value in values])
