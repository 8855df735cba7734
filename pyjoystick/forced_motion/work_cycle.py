"""The load of a shift on an operator: percentiles of torque and force, work, impulse (section 1).

The moves are invented, not measured: no distribution has been published for this joystick. They are drawn
with a fixed seed, or given.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu
from pyjoystick.forced_motion.motions import ForwardAndReturn
from pyjoystick.forced_motion.samples import Samples
from pyjoystick.forced_motion.torque import MOTION, inverse_fmu, inverse_values
from pyjoystick.model import FRICTION_NAMES, PIVOT_TO_TOP, JoystickParameters, require_within_stops
from pyjoystick.support import FloatArray, ParameterError, angle, not_negative, positive

#: Number of moves in a typical operator's shift (section 1).
MOVES_PER_SHIFT: Final = 20_000
#: Percentages at which the distribution of a load over time is stored. Jonsson (1982) calls the levels at 10,
#: 50 and 90 % the static, median and peak load.
PERCENTAGES: Final = np.arange(101.0)
#: Preloads of all four springs, and their stiffnesses.
PRELOADS: Final = tuple(
    f"{side}.{spring}Spring.F_0" for side in ("forward", "backward") for spring in ("return", "balance")
)
STIFFNESSES: Final = tuple(name.replace("F_0", "k_s") for name in PRELOADS)


@dataclass(frozen=True, slots=True, kw_only=True)
class MoveDistribution:
    """Distribution of the moves of a shift: forward or backward and return, with minimum jerk.

    Attributes:
        smallest, largest: range of the magnitude of the angle (rad), uniformly distributed
        stroke: median duration of a stroke to the largest angle (s); it scales with the square root of the
            angle, so that all strokes have about the same acceleration
        spread: standard deviation of the logarithm of the duration
        dwell: longest time at the angle (s), uniformly distributed from 0
        backward: fraction of the moves that go backward

    Raises:
        ParameterError: a value is outside its range
    """

    smallest: float = math.radians(4.0)
    largest: float = math.radians(18.0)
    stroke: float = 0.25
    spread: float = 0.25
    dwell: float = 0.5
    backward: float = 0.5

    def __post_init__(self) -> None:
        positive("smallest", angle("smallest", self.smallest), "rad")
        if angle("largest", self.largest) < self.smallest:
            raise ParameterError("largest", self.largest, f"at least the smallest, {self.smallest:g} rad")
        positive("stroke", self.stroke, "s")
        not_negative("spread", self.spread)
        not_negative("dwell", self.dwell, "s")
        if not 0.0 <= self.backward <= 1.0:
            raise ParameterError("backward", self.backward, "from 0 to 1")

    def draw(self, count: int, *, seed: int = 0) -> list[ForwardAndReturn]:
        """Draw this number of moves; the same seed gives the same moves."""
        random = np.random.default_rng(seed)
        angles = random.uniform(self.smallest, self.largest, count)
        times = self.stroke * np.sqrt(angles / self.largest) * random.lognormal(0.0, self.spread, (2, count))
        dwells = random.uniform(0.0, self.dwell, count)
        signs = np.where(random.uniform(size=count) < self.backward, -1.0, 1.0)
        return [
            ForwardAndReturn(amplitude=float(a), rise=float(rise), fall=float(fall), dwell=float(dwell))
            for a, rise, fall, dwell in zip(angles * signs, *times, dwells, strict=True)
        ]


@dataclass(frozen=True, slots=True, eq=False)
class Demand:
    """The load of moves on the hand; percentiles and means are over the time of the moves only.

    Attributes:
        levels: magnitude of the torque (N m) that is not exceeded for 0, 1, ... 100 % of the time, shape
            (101,)
        positive_work, negative_work: work of the hand, mean per move (J)
        impulse: integral of the magnitude of the torque, mean per move (N m s)
        time: mean duration of a move (s)
        pivot_to_handle: distance from the pivot to the hand (m)
    """

    levels: FloatArray
    positive_work: float
    negative_work: float
    impulse: float
    time: float
    pivot_to_handle: float

    def torque(self, percentage: float) -> float:
        """Magnitude of the torque (N m) that is not exceeded for this percentage of the time."""
        return float(np.interp(percentage, PERCENTAGES, self.levels))

    def force(self, percentage: float) -> float:
        """Force at the hand (N), perpendicular to the handle, not exceeded for this percentage of time."""
        return self.torque(percentage) / self.pivot_to_handle

    def work_per_shift(self, moves: int = MOVES_PER_SHIFT) -> float:
        """Work of the hand on the joystick over a shift (J), without the work that the joystick returns."""
        return moves * self.positive_work

    def impulse_per_shift(self, moves: int = MOVES_PER_SHIFT) -> float:
        """Integral of the magnitude of the force over a shift (N s)."""
        return moves * self.impulse / self.pivot_to_handle


def faster(moves: Sequence[ForwardAndReturn], factor: float) -> list[ForwardAndReturn]:
    """The same strokes in 1/`factor` of the time, with the same dwell."""
    return [
        dataclasses.replace(move, rise=move.rise / factor, fall=move.return_time / factor) for move in moves
    ]


def scaled(joystick: JoystickParameters, names: Sequence[str], factor: float) -> JoystickParameters:
    """Multiply some parameters of a joystick by a factor."""
    values = dict.fromkeys(FRICTION_NAMES, 0.0) | joystick.to_names()
    return joystick.replace({name: factor * values[name] for name in names})


def demands(
    joysticks: Sequence[JoystickParameters],
    moves: Sequence[ForwardAndReturn],
    *,
    pivot_to_handle: float = PIVOT_TO_TOP,
    fmu: Fmu | None = None,
) -> list[Demand]:
    """Compute the demand of the same moves for several joysticks of one damping law, with the inverse FMU.

    Args:
        joysticks: one or more
        moves: one or more
        pivot_to_handle: distance from the pivot to the hand (m), by default the top of Table 2
        fmu: open inverse FMU of that law; by default the project's own

    Raises:
        ParameterError: there are no joysticks or moves, a distance is not above 0, an angle is beyond a stop,
            or the FMU does not allow a value
        UnknownParameterError: the FMU has another damping law
        FmuRunError: the FMU rejects a joystick
    """
    pivot_to_handle = positive("pivot_to_handle", pivot_to_handle, "m")
    if not joysticks or not moves:
        raise ParameterError("joysticks, moves", "an empty sequence", "one or more")
    if fmu is None:
        with Fmu(inverse_fmu(joysticks[0].damping)) as opened:
            return demands(joysticks, moves, pivot_to_handle=pivot_to_handle, fmu=opened)
    samples = [Samples.of(joysticks[0], move) for move in moves]
    theta, omega, alpha, weights = (
        np.concatenate([getattr(one, name) for one in samples]) for name in (*MOTION, "weights")
    )
    # The FMU has no states, so the moves can be concatenated, with one second per sample.
    count = np.arange(len(theta), dtype=np.float64)
    inputs = pd.DataFrame({"theta": theta, "omega": omega, "alpha": alpha}, index=count)
    for joystick in joysticks:
        require_within_stops(joystick, theta)
    names = tuple({name: None for joystick in joysticks for name in inverse_values(joystick)})
    plan = fmu.plan(count, varied=names, inputs=inputs, outputs=["T"])
    runs = ([inverse_values(joystick).get(name, 0.0) for name in names] for joystick in joysticks)
    return [_demand(plan.run(values)[:, 0], omega, weights, len(moves), pivot_to_handle) for values in runs]


def _demand(
    torque: FloatArray, omega: FloatArray, weights: FloatArray, moves: int, pivot_to_handle: float
) -> Demand:
    magnitude, power = np.abs(torque), torque * omega
    return Demand(
        levels=_levels(magnitude, weights),
        positive_work=float(np.sum(np.maximum(power, 0.0) * weights)) / moves,
        negative_work=float(np.sum(np.minimum(power, 0.0) * weights)) / moves,
        impulse=float(np.sum(magnitude * weights)) / moves,
        time=float(np.sum(weights)) / moves,
        pivot_to_handle=pivot_to_handle,
    )


def _levels(values: FloatArray, weights: FloatArray) -> FloatArray:
    """Values that are not exceeded for 0, 1, ... 100 % of the weight."""
    order = np.argsort(values)
    reached = np.cumsum(weights[order]) - 0.5 * weights[order]
    levels = np.interp(PERCENTAGES / 100.0 * np.sum(weights), reached, values[order])
    # Peaks may occur at corners, which have no weight.
    levels[[0, -1]] = values[order[[0, -1]]]
    return levels
