"""Sets of records of a known joystick, with one effect that a fit of C does not model."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from scipy.signal import butter, sosfiltfilt

from benchmarks.disturbed_motion import Disturbance, disturbed_motion
from pyjoystick.identification import scaled_forces
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters
from pyjoystick.motion import Record
from pyjoystick.support import FloatArray

RATE: Final = 60.0
NOISE: Final = math.radians(0.1)
RECORDS: Final = 4
_DURATION: Final = 1.6


@dataclass(slots=True)
class Making:
    """How a record is generated; a case changes part of it.

    Attributes:
        joystick: the joystick
        disturbance: effects in addition to its equation
        speed: velocity at the release (rad/s)
        play: play of a loose sensor (rad)
        scale, time_base, offset: instrument errors: it reads too much by `scale`, its clock is slow by
            `time_base`, its zero is off by `offset` (rad)
        noise: maps a generator and a number of samples to noise
        seen: maps samples with noise to those of the record
    """

    joystick: JoystickParameters = NOMINAL
    disturbance: Disturbance = field(default_factory=Disturbance)
    speed: float = 0.0
    scale: float = 0.0
    time_base: float = 0.0
    offset: float = 0.0
    play: float = 0.0
    noise: Callable[[np.random.Generator, int], FloatArray] = lambda random, n: (
        NOISE * random.standard_normal(n)
    )
    seen: Callable[[FloatArray, np.random.Generator], FloatArray] = lambda theta, random: theta


@dataclass(frozen=True, slots=True)
class Case:
    """A fault, in several sizes.

    Attributes:
        sizes: in `unit`
        unit: of the sizes
        change: maps a size to the generation of records, with a generator for what varies between them
        suspects: what a fit should name
    """

    sizes: tuple[float, ...]
    unit: str
    change: Callable[[Making, float, np.random.Generator], None]
    suspects: tuple[str, ...] = ()


def disturbed_records(
    case: Case, size: float, random: np.random.Generator, angle: float = math.radians(-20.0)
) -> list[Record]:
    """Return four releases from about the same angle (rad)."""
    found = []
    for number in range(1, RECORDS + 1):
        making = Making()
        case.change(making, size, random)
        found.append(
            _record(making, f"run {number}", angle + math.radians(0.3) * random.standard_normal(), random)
        )
    return found


def _record(making: Making, name: str, angle: float, random: np.random.Generator) -> Record:
    release = 0.1 + random.uniform(0.0, 1.0 / RATE)
    time = np.arange(math.floor(_DURATION * RATE) + 1) / RATE
    after = time > release
    theta = np.full(len(time), angle)
    instants = np.concatenate(([0.0], (1.0 + making.time_base) * (time[after] - release)))
    motion = disturbed_motion(
        making.joystick, making.disturbance, time=instants, theta_start=angle, omega_start=making.speed
    )
    theta[after] = motion[1:]
    if making.play > 0.0:
        theta[after] = _dragged(making, instants, angle)
    shown = (1.0 + making.scale) * theta + making.offset + making.noise(random, len(time))
    return Record(name, time, making.seen(shown, random), source="synthetic")


def _dragged(making: Making, instants: FloatArray, angle: float) -> FloatArray:
    """Return the reading of a sensor that moves only after the handle has crossed the sensor's play."""
    fine = np.linspace(0.0, instants[-1], 20 * len(instants))
    motion = disturbed_motion(
        making.joystick, making.disturbance, time=fine, theta_start=angle, omega_start=making.speed
    )
    shown, last = np.empty_like(motion), angle
    for k, value in enumerate(motion):
        last = min(max(last, value - 0.5 * making.play), value + 0.5 * making.play)
        shown[k] = last
    return np.interp(instants[1:], fine, shown)


def _friction(making: Making, size: float, random: np.random.Generator) -> None:
    making.disturbance = Disturbance(T_c=size)


def _plungers(making: Making, size: float, random: np.random.Generator) -> None:
    making.disturbance = Disturbance(F_c=size)


def _stop(making: Making, size: float, random: np.random.Generator) -> None:
    making.disturbance = Disturbance(stop=math.radians(size))


def _inertia(making: Making, size: float, random: np.random.Generator) -> None:
    making.joystick = NOMINAL.replace({"J": NOMINAL.J * (1.0 + 0.01 * size)})


def _preload(making: Making, size: float, random: np.random.Generator) -> None:
    name = "forward.returnSpring.F_0"
    making.joystick = NOMINAL.replace({name: NOMINAL.to_names()[name] * (1.0 + 0.01 * size)})


def _force_scale(making: Making, size: float, random: np.random.Generator) -> None:
    making.joystick = scaled_forces(NOMINAL, 1.0 + 0.01 * size)


def _law(making: Making, size: float, random: np.random.Generator) -> None:
    """Eq. (11) in part: coefficients between a constant C and their true values."""
    values = {"damping.alpha": 1.0}
    for coefficient, exponent in (("A_pos", "n_pos"), ("A_neg", "n_neg")):
        own = NOMINAL_POWER_LAW.to_names()[f"damping.{exponent}"] * size
        values |= {f"damping.{coefficient}": 0.045 * 0.1**-own, f"damping.{exponent}": own}
    making.joystick = NOMINAL_POWER_LAW.replace(values)


def _offset(making: Making, size: float, random: np.random.Generator) -> None:
    making.offset = math.radians(size)


def _time_base(making: Making, size: float, random: np.random.Generator) -> None:
    making.time_base = 0.01 * size


def _scale(making: Making, size: float, random: np.random.Generator) -> None:
    making.scale = 0.01 * size


def _speed(making: Making, size: float, random: np.random.Generator) -> None:
    making.speed = size * random.uniform(0.5, 1.5)


def _filter(making: Making, size: float, random: np.random.Generator) -> None:
    filtered = butter(4, size, fs=RATE, output="sos")
    making.seen = lambda theta, _: np.asarray(sosfiltfilt(filtered, theta))


def _clipping(making: Making, size: float, random: np.random.Generator) -> None:
    making.seen = lambda theta, _: np.clip(theta, -math.radians(size), math.radians(size))


def _saturation(making: Making, size: float, random: np.random.Generator) -> None:
    """The angle itself is limited; noise is added afterwards."""
    limit = math.radians(size)
    noise = making.noise
    making.noise = lambda generator, n: np.zeros(n)
    making.seen = lambda theta, generator: np.clip(theta, -limit, limit) + noise(generator, len(theta))


def _backlash(making: Making, size: float, random: np.random.Generator) -> None:
    making.play = math.radians(size)


def _sign(making: Making, size: float, random: np.random.Generator) -> None:
    making.seen = lambda theta, _: -theta


def _mixture(making: Making, size: float, random: np.random.Generator) -> None:
    factor = 1.0 + 0.01 * size * random.standard_normal()
    making.joystick = NOMINAL.replace({"damping.C": NOMINAL.to_names()["damping.C"] * factor})


def _color(making: Making, size: float, random: np.random.Generator) -> None:
    def noise(generator: np.random.Generator, n: int) -> FloatArray:
        found = generator.standard_normal(n)
        for i in range(1, n):
            found[i] = size * found[i - 1] + math.sqrt(1.0 - size**2) * found[i]
        return NOISE * found

    making.noise = noise


def _outliers(making: Making, size: float, random: np.random.Generator) -> None:
    def seen(theta: FloatArray, generator: np.random.Generator) -> FloatArray:
        found = theta.copy()
        found[generator.choice(len(theta), 2, replace=False)] += math.radians(size)
        return found

    making.seen = seen


CASES: Final[Mapping[str, Case]] = {
    "nothing wrong": Case((0.0,), "", lambda making, size, random: None),
    "friction": Case((0.0005, 0.001, 0.002, 0.0072, 0.02, 0.05), "N m", _friction, ("friction",)),
    "friction at the plungers": Case((0.02, 0.05, 0.1, 0.3, 1.0), "N", _plungers, ("friction",)),
    "another law": Case((0.1, 0.3, 1.0), "of eq. (11)", _law, ("damping coefficient",)),
    "stop": Case((14.0, 12.0, 10.0), "deg", _stop, ("stop",)),
    "J": Case((0.2, 1.0, 5.0), "%", _inertia, ("moment of inertia",)),
    "preload": Case((0.2, 1.0, 5.0), "%", _preload, ("preloads",)),
    "forces of the springs": Case((0.2, 0.5, 2.0), "%", _force_scale, ("forces of the springs",)),
    "zero offset": Case((0.1, 0.3, 1.0), "deg", _offset),
    "time base": Case((0.1, 0.3, 1.0), "%", _time_base, ("time base",)),
    "angle scale": Case((0.2, 0.5, 2.0), "%", _scale, ("scale",)),
    "speed at the release": Case((0.2, 1.0, 3.0), "rad/s", _speed, ("motion at",)),
    "filter": Case((20.0, 13.0, 8.0), "Hz", _filter, ("filter",)),
    "clipping": Case((18.0, 12.0, 8.0), "deg", _clipping, ("clipping",)),
    "saturation": Case((18.0, 12.0, 8.0), "deg", _saturation, ("clipping",)),
    "backlash": Case((0.2, 0.5, 1.0), "deg", _backlash, ("backlash",)),
    "other sign": Case((1.0,), "", _sign, ("other sign",)),
    "another C in each record": Case((1.0, 3.0, 10.0), "%", _mixture, ("differ in damping.C",)),
    "colored noise": Case((0.3, 0.6, 0.8), "", _color),
    "outliers": Case((0.5, 2.0, 10.0), "deg", _outliers),
}
