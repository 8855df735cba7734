"""A joystick under a sinusoidal torque, sampled once per period; its fixed points are periodic motions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum, auto
from functools import cached_property, lru_cache, partial
from typing import Final

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from pyjoystick.fmu import Fmu, FmuRunError, Plan, Value
from pyjoystick.forced_motion.periodic.maps import CentralDifferences, Linearization, SmoothMap, Tangents
from pyjoystick.forced_motion.predictability import trusted_until
from pyjoystick.forced_motion.response.derivatives import MOTION, STARTS, MapSensitivities
from pyjoystick.forced_motion.sine import sine_table
from pyjoystick.model import JoystickParameters, angle_of_travel, values_for
from pyjoystick.support import FloatArray, ParameterError, UnknownParameterError, positive, whole_number

#: Tolerance of the FMU's integrator.
TOLERANCE: Final = 1e-12
#: The same for how fast motions part: their tangents are exact at any tolerance, differences are not.
_ROUGH: Final = 1e-9
#: Steps of differences, as a part of the scales: 5e-7 rad, small beside the steep segments of Table 1.
_DIFFERENCE: Final = 1e-5
#: Up to this many runs, running one after the other is faster than starting the threads of a batch.
_FEW: Final = 12
_THETA_SCALE: Final = 0.05
#: Parameters of the shaking; any other is one of the joystick.
FREQUENCY: Final = "frequency"
TORQUE: Final = "torque"


class _Run(Enum):
    """What a run records: its last state, the motion, or its last state and the derivatives."""

    END = auto()
    MOTION = auto()
    DERIVATIVES = auto()
    ROUGH_DERIVATIVES = auto()


@dataclass(frozen=True, slots=True)
class Shaking:
    """The torque A sin(2 pi f t).

    Attributes:
        torque: A (N m), above zero
        frequency: f (Hz), above zero
    """

    torque: float
    frequency: float

    def __post_init__(self) -> None:
        positive("torque", self.torque, "N.m")
        positive("frequency", self.frequency, "Hz")


@dataclass(frozen=True, eq=False)
class Orbit:
    """A motion over one or several periods.

    Attributes:
        time: s, shape (n,)
        theta: rad, shape (n,)
        omega: rad/s, shape (n,)
    """

    time: FloatArray
    theta: FloatArray
    omega: FloatArray

    @cached_property
    def extremes(self) -> tuple[float, float]:
        """Largest and smallest angle (rad), also between samples, by cubic Hermite interpolation."""
        path = CubicHermiteSpline(self.time, self.theta, self.omega)
        values = np.append(path(path.derivative().roots(extrapolate=False)), self.theta)
        return float(np.nanmax(values)), float(np.nanmin(values))

    @property
    def amplitude(self) -> float:
        """Half of the peak-to-peak angle (rad)."""
        high, low = self.extremes
        return 0.5 * (high - low)


class ShakenJoystick:
    """A joystick's FMU under A sin(2 pi f t), with one free parameter.

    The state is (theta, omega) at the instants 0, kT, 2kT ... where the torque passes zero upward.

    Attributes:
        fmu, joystick, shaking, free, periods: as given
        value: of the free parameter
    """

    def __init__(
        self,
        fmu: Fmu,
        joystick: JoystickParameters,
        shaking: Shaking,
        *,
        free: str = FREQUENCY,
        periods: int = 1,
        tolerance: float = TOLERANCE,
    ) -> None:
        """Set what is constant.

        Args:
            fmu: FMU of the joystick, with its damping law
            joystick: the parameters
            shaking: the torque
            free: ``frequency``, ``torque``, or the FMU's name of a joystick parameter
            periods: k, number of periods of the torque from one state to the next
            tolerance: tolerance of the FMU's integrator

        Raises:
            ParameterError: the joystick has dry friction, which merges motions from different states, so that
                the derivatives for the search do not exist; or a value is not allowed
            UnknownParameterError: the joystick has no parameter of that name
        """
        if joystick.friction:
            allowed = "none: where a joystick sticks, its motion has no derivatives to search by"
            raise ParameterError("friction", joystick.friction, allowed)
        self.fmu, self.joystick, self.shaking, self.free = fmu, joystick, shaking, free
        self.periods = whole_number("periods", periods, 1)
        self._tolerance = tolerance
        self._plan = lru_cache(maxsize=4)(self._new_plan)
        values = {TORQUE: shaking.torque, FREQUENCY: shaking.frequency, **joystick.to_names()}
        if free not in values:
            raise UnknownParameterError(free, values)
        self.value = float(values[free])
        if free == FREQUENCY and not joystick.stops:
            self._sensitivities = MapSensitivities.over_frequency(fmu)
        else:
            self._sensitivities = MapSensitivities.of(fmu, () if free in (FREQUENCY, TORQUE) else (free,))

    def with_periods(self, periods: int) -> ShakenJoystick:
        """The same joystick, sampled every k-th period."""
        return ShakenJoystick(
            self.fmu,
            self.joystick,
            self.shaking,
            free=self.free,
            periods=periods,
            tolerance=self._tolerance,
        )

    @property
    def scales(self) -> FloatArray:
        """Sizes of theta (rad), omega (rad/s) and the free parameter, shape (3,)."""
        omega = _THETA_SCALE * 2.0 * math.pi * self.shaking.frequency
        return np.array([_THETA_SCALE, omega, self._parameter_scale])

    @property
    def _parameter_scale(self) -> float:
        return abs(self.value) or 1.0

    @property
    def is_exact(self) -> bool:
        """Derivatives of the map are those of `Fmu.sensitive`, otherwise differences of runs."""
        return self._sensitivities is not None

    def smooth(self) -> SmoothMap:
        """The map with its derivatives."""
        return self._differences if self._sensitivities is None else partial(self._exact, self._sensitivities)

    @property
    def _differences(self) -> CentralDifferences:
        return CentralDifferences(self.images, self.scales[:2], self._parameter_scale, step=_DIFFERENCE)

    def _exact(self, slopes: MapSensitivities, state: FloatArray, value: float) -> Linearization:
        """By differences where the FMU has no sensitivities: a motion that touches a kink ends its run."""
        ends = self._ends(state[None, :], value, _Run.DERIVATIVES)
        if not np.all(np.isfinite(ends)):
            return self._differences(state, value)
        by_parameter = partial(self._by_parameter, slopes, state, value, ends[0])
        return Linearization(ends[0, :2], slopes.monodromies(ends)[0], by_parameter, error=None)

    def _by_parameter(
        self, slopes: MapSensitivities, state: FloatArray, value: float, end: FloatArray
    ) -> FloatArray:
        if not slopes.by:
            return self._differences.by_parameter(state, value, end[:2])
        if self.free != FREQUENCY:
            return slopes.by_parameter(end)
        inertia, damping = (float(self.joystick.to_names()[name]) for name in slopes.by)
        return slopes.by_frequency(end, state, value, inertia, damping)

    def tangents(self) -> Tangents | None:
        """The map of many states with exact derivatives, at a larger tolerance; None if not `is_exact`."""
        return None if self._sensitivities is None else partial(self._tangents, self._sensitivities)

    def _tangents(
        self, slopes: MapSensitivities, states: FloatArray, value: float
    ) -> tuple[FloatArray, FloatArray]:
        ends = self._ends(states, value, _Run.ROUGH_DERIVATIVES)
        images, monodromies = ends[:, :2].copy(), slopes.monodromies(ends).copy()
        for i in np.flatnonzero(~np.all(np.isfinite(ends), axis=1)):
            here = self._differences(states[i], value)
            images[i], monodromies[i] = here.image, here.monodromy
        return images, monodromies

    def period(self, value: float) -> float:
        """Duration k T (s) at a value of the free parameter."""
        return self.periods / self._at(value)[0].frequency

    def images(self, states: FloatArray, value: float) -> FloatArray:
        """States k periods later, from a batch with one run each.

        Args:
            states: shape (runs, 2)
            value: value of the free parameter

        Returns:
            shape (runs, 2); NaN if a run fails, an angle is not below pi/2, or the value is not allowed
        """
        return self._ends(states, value, _Run.END)

    def _ends(self, states: FloatArray, value: float, kind: _Run) -> FloatArray:
        """What runs of a kind record at their end, a row each, as `images` has it."""
        found = np.full((len(states), len(self._recorded(kind)[1])), np.nan)
        try:
            plan = self._plan(value, kind)
        except ParameterError:
            return found
        allowed = np.all(np.isfinite(states), axis=1) & (np.abs(states[:, 0]) < 0.5 * math.pi)
        if not np.any(allowed):
            return found
        if len(states) <= _FEW:
            found[allowed] = [_end(plan, state) for state in states[allowed]]
            return found
        batch = plan.run_batch(states[allowed], on_progress=lambda *_: None)
        if batch.interrupted:
            raise KeyboardInterrupt
        assert batch.values is not None
        found[allowed] = batch.values[:, -1]
        return found

    def orbit(self, state: FloatArray, value: float) -> Orbit:
        """The motion over the k periods from a state on; raises FmuRunError if the run fails."""
        plan = self._plan(value, _Run.MOTION)
        theta, omega = plan.run(state).T
        return Orbit(plan.time, theta, omega)

    def kinks(self, value: float) -> dict[str, float]:
        """Angles (rad) at which the moment has a kink: ``forward x_0`` and so on, ``forward stop``."""
        joystick = self._at(value)[1]
        sides = (("forward", joystick.forward, 1.0), ("backward", joystick.backward, -1.0))
        found = {
            f"{side} x_{i}": sign * angle_of_travel(joystick, x)
            for side, assembly, sign in sides
            for i, x in enumerate(assembly.kinks)
        }
        if joystick.stops:
            found |= {f"{side} stop": sign * joystick.stops.theta_stop for side, _, sign in sides}
        return found

    def _at(self, value: float) -> tuple[Shaking, JoystickParameters]:
        if self.free == FREQUENCY:
            return Shaking(self.shaking.torque, value), self.joystick
        if self.free == TORQUE:
            return Shaking(value, self.shaking.frequency), self.joystick
        return self.shaking, self.joystick.replace({self.free: value})

    def trusted_until(self, state: FloatArray, periods: int) -> float:
        """Time at which the error of a run from a state has grown to 1 % of its largest angle (s).

        As `pyjoystick.forced_motion.trusted_until`, at its tolerance; infinite if the error is smaller after
        `periods` periods of the torque.
        """
        torque = sine_table("T", self.shaking.torque, self.shaking.frequency, periods)
        parameters: dict[str, Value] = {
            **values_for(self.joystick, self.fmu.description.variables),
            "omega_start": float(state[1]),
        }
        return trusted_until(
            self.fmu, torque.index, theta_start=float(state[0]), inputs=torque, parameters=parameters
        )

    def _new_plan(self, value: float, kind: _Run) -> Plan:
        shaking, joystick = self._at(value)
        torque = sine_table("T", shaking.torque, shaking.frequency, self.periods)
        time = torque.index.to_numpy()
        fmu, outputs = self._recorded(kind)
        return fmu.plan(
            time if kind is _Run.MOTION else time[[0, -1]],
            varied=STARTS,
            parameters=values_for(joystick, self.fmu.description.variables),
            inputs=torque,
            outputs=outputs,
            tolerance=max(self._tolerance, _ROUGH) if kind is _Run.ROUGH_DERIVATIVES else self._tolerance,
        )

    def _recorded(self, kind: _Run) -> tuple[Fmu, tuple[str, ...]]:
        """The FMU that carries out runs of a kind, and what they record."""
        if kind in (_Run.DERIVATIVES, _Run.ROUGH_DERIVATIVES):
            assert self._sensitivities is not None
            return self._sensitivities.fmu, self._sensitivities.outputs
        return self.fmu, MOTION


def _end(plan: Plan, state: FloatArray) -> FloatArray:
    try:
        samples = plan.run(state)
    except FmuRunError:
        return np.full(len(plan.outputs), np.nan)
    end: FloatArray = samples[-1]
    return end
