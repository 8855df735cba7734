"""What is read: a table of known contents, and its reader."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Final

import numpy as np

from pyjoystick.laboratory import read_accelerometer, read_load_curve, read_markers
from pyjoystick.motion.logs.reading import read_log
from pyjoystick.motion.records.reading import read_record
from pyjoystick.support import FloatArray
from tests.fuzz.tables.style import Series

_TIMES: Final = (
    ("Time", "s"),
    ("time", "s"),
    ("Zeit", "s"),
    ("Temps", "s"),
    ("t", "s"),
    ("Time", "ms"),
    ("Zeit", "ms"),
)
_ANGLES: Final = (
    ("Angle", "deg"),
    ("theta", "deg"),
    ("Winkel", "°"),
    ("Ángulo", "deg"),
    ("theta", "rad"),
    ("Angle", "mrad"),
)
_SPEEDS: Final = (("Velocity", "rad/s"), ("omega", "deg/s"), ("Winkelgeschwindigkeit", "rad/s"))
_FACTORS: Final = {
    "s": 1.0,
    "ms": 1e-3,
    "rad": 1.0,
    "mrad": 1e-3,
    "deg": math.pi / 180.0,
    "°": math.pi / 180.0,
    "rad/s": 1.0,
    "deg/s": math.pi / 180.0,
    "mm": 1e-3,
    "m/s2": 1.0,
    "N": 1.0,
}


@dataclass(frozen=True)
class Found:
    """What a reader returned: series in SI units by quantity, the same length each, and its notes."""

    series: Mapping[str, FloatArray]
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Subject:
    """A kind of table.

    Attributes:
        name: what is read
        is_plain: whether only plain CSV is read
        columns: makes the contents
        read: reads a file
    """

    name: str
    is_plain: bool
    columns: Callable[[Random], list[Series]]
    read: Callable[[Path], Found]


def _series(name: str, heading: tuple[str, str], values: FloatArray, digits: int) -> Series:
    """Write SI values in the unit of the heading."""
    text, unit = heading
    factor = _FACTORS[unit] if unit else 1.0
    return Series(name, text, unit, factor, tuple(f"{value:.{digits}f}" for value in values / factor))


def _release(random: Random) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Times (s), angles (rad) and velocities (rad/s) of a release from a hold, with noise."""
    rate = random.choice((50.0, 100.0, 240.0, 500.0, 1000.0))
    time = np.arange(int(rate * random.uniform(1.2, 2.0))) / rate + random.choice((0.0, 0.0, 12.5))
    since = np.maximum(time - time[0] - random.uniform(0.1, 0.3), 0.0)
    amplitude, decay, speed = (
        math.radians(random.uniform(-20.0, -8.0)),
        random.uniform(1.0, 4.0),
        random.uniform(20.0, 45.0),
    )
    theta = (
        amplitude * np.exp(-decay * since) * (np.cos(speed * since) + decay / speed * np.sin(speed * since))
    )
    omega = -amplitude * np.exp(-decay * since) * (speed + decay**2 / speed) * np.sin(speed * since)
    noise = np.random.default_rng(random.randrange(2**32)).standard_normal(len(time))
    return time, theta + math.radians(0.01) * noise, omega


def _more(random: Random, count: int) -> list[Series]:
    """Columns that are not read."""
    others = [
        Series(
            "", random.choice(("Frame", "Sample", "Nr")), "", 1.0, tuple(str(i + 1) for i in range(count))
        ),
        Series("", "Temperature", "degC", 1.0, tuple(f"{21.0 + i % 7 / 10:.1f}" for i in range(count))),
        Series("", "Supply", "V", 1.0, tuple(f"{5.0 + i % 11 / 1000:.3f}" for i in range(count))),
    ]
    return random.sample(others, random.choice((0, 0, 1, 2)))


def _with_more(first: list[Series], random: Random) -> list[Series]:
    """Add columns that are not read, before the others or behind them."""
    for one in _more(random, len(first[0].cells)):
        first.insert(random.choice((0, len(first))), one)
    return first


def _log(random: Random) -> list[Series]:
    time, theta, omega = _release(random)
    angle = random.choice(_ANGLES)
    found = [
        _series("time", random.choice(_TIMES), time, random.choice((4, 5, 6))),
        _series("theta", angle, theta, {"rad": 5, "mrad": 2}.get(angle[1], random.choice((2, 4)))),
    ]
    if random.random() < 0.3:
        found.append(_series("omega", random.choice(_SPEEDS), omega, 4))
    return _with_more(found, random)


def _record(random: Random) -> list[Series]:
    time, theta, omega = _release(random)
    angle = random.choice((("theta", "deg"), ("theta", "rad")))
    found = [_series("time", ("time", "s"), time, 5), _series("theta", angle, theta, 5)]
    if random.random() < 0.3:
        found.append(_series("omega", ("omega", "rad/s"), omega, 4))
    return found


def _markers(random: Random) -> list[Series]:
    time, theta, _ = _release(random)
    found = [_series("time", ("time", "s"), time, 5)]
    for marker, radius in random.choice(((("TOP", 0.266),), (("TOP", 0.266), ("BASE", 0.0)))):
        for axis, values in zip(
            "xyz", (radius * np.sin(theta), 0.01 * theta, radius * np.cos(theta)), strict=True
        ):
            found.append(_series(f"{marker} {axis}", (f"{marker} {axis}", "mm"), values + 0.3, 2))
    return found


def _accelerometer(random: Random) -> list[Series]:
    time, theta, omega = _release(random)
    values = 0.25 * np.gradient(omega, time) - 9.81 * np.sin(theta)
    return [
        _series("time", ("time", "s"), time, 5),
        _series("acceleration", ("acceleration", "m/s2"), values, 3),
    ]


def _load_curve(random: Random) -> list[Series]:
    travel = np.linspace(0.0, random.uniform(0.008, 0.02), random.randrange(60, 200))
    force = 20.0 + 900.0 * travel
    names = random.choice((("travel", "force"), ("Weg", "Kraft"), ("Displacement", "Load")))
    found = [_series("travel", (names[0], "mm"), travel, 4), _series("force", (names[1], "N"), force, 3)]
    return _with_more(found, random)


def _read_log(path: Path) -> Found:
    log = read_log(path)
    left = (f"{len(log.left_out)} rows left out",) if len(log.left_out) else ()
    return Found({name: log.series[name] for name in log.found}, (*log.notes, *left))


def _read_record(path: Path) -> Found:
    record = read_record(path)
    omega = {} if record.omega is None else {"omega": record.omega}
    return Found({"time": record.time, "theta": record.theta} | omega, record.notes)


def _read_markers(path: Path) -> Found:
    markers = read_markers(path)
    places = {
        f"{name} {axis}": markers.positions[:, i, k]
        for i, name in enumerate(markers.names)
        for k, axis in enumerate("xyz")
    }
    return Found({"time": markers.time} | places, markers.notes)


def _read_accelerometer(path: Path) -> Found:
    record = read_accelerometer(path)
    return Found({"time": record.time, "acceleration": record.acceleration}, record.notes)


def _read_load_curve(path: Path) -> Found:
    curve = read_load_curve(path)
    travel, force = (
        np.concatenate([getattr(one, name) for one in curve.branches]) for name in ("travel", "force")
    )
    return Found({"travel": travel, "force": force}, curve.notes)


SUBJECTS: Final = (
    Subject("log", False, _log, _read_log),
    Subject("record", True, _record, _read_record),
    Subject("markers", True, _markers, _read_markers),
    Subject("accelerometer", True, _accelerometer, _read_accelerometer),
    Subject("load curve", False, _load_curve, _read_load_curve),
)
