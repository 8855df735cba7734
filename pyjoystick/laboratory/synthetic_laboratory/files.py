"""Files of a synthetic laboratory, sampled from the reference; no joystick was measured.

They describe a joystick that is not the paper's: load-deflection curves of both sides with friction, its
parts and a swing test, four releases recorded by cameras at 60 Hz (in one of them the laboratory's x axis
points backward), and the accelerometer of the first release, whose clock is late. Noise and lost frames are
included.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Final

import numpy as np

from pyjoystick.laboratory.inertia.budget import Measured
from pyjoystick.laboratory.inertia.parts import Part, from_parts
from pyjoystick.laboratory.measurements.markers import Markers
from pyjoystick.laboratory.synthetic_laboratory.cameras import (
    MarkerLayout,
    synthetic_acceleration,
    synthetic_markers,
    synthetic_swing,
)
from pyjoystick.laboratory.synthetic_laboratory.testing_machine import synthetic_load_cycle
from pyjoystick.model import NOMINAL, ActuatorAssembly, JoystickParameters, SegmentTable, simulate
from pyjoystick.support import FloatArray, write_text

_SEED: Final = 274
#: Travels (m) and stiffnesses (N/m) of both sides.
_CURVES: Final = {
    "forward": SegmentTable((0.082e-3, 0.2105e-3, 2.861e-3, 2.873e-3), (412e3, 2740.0, 985e3, 5850.0)),
    "backward": SegmentTable((0.069e-3, 0.1580e-3, 3.010e-3, 3.0195e-3), (640e3, 1265.0, 1070e3, 4210.0)),
}
#: Part: mass (kg), height of its center (m), inertia about its center (kg m2).
_PARTS: Final = {"shaft": (0.36, 0.070, 1.2e-3), "grip": (0.35, 0.150, 6e-4), "cam": (0.20, -0.020, 3e-4)}
#: Standard uncertainties of masses (kg), heights (m), and inertias (relative).
_U_MASS, _U_HEIGHT, _U_INERTIA = 5e-4, 3e-4, 0.03
_GEOMETRY: Final = {"a": 0.0241, "b": 0.0051}
_DAMPING: Final = 0.0512
_RATE, _ACCELEROMETER_RATE, _DURATION = 60.0, 1800.0, 4.0
_MARKER_NOISE, _ACCELERATION_NOISE = 3e-4, 0.05  # m, m/s2
_DISTANCE, _DELAY = 0.25, 0.02  # m, s
_TRIALS: Final = {  # name: release angle (rad), heading of forward in the laboratory (rad)
    "trial_1": (math.radians(-20.0), math.radians(4.0)),
    "trial_2": (math.radians(-19.8), math.radians(4.0)),
    "trial_3": (math.radians(-20.1), math.radians(4.0)),
    "trial_4": (math.radians(-19.9), math.radians(184.0)),
}
_LOST: Final = (slice(3, 5), slice(150, 157))  # frames without the top: in the hold and at rest
#: Releases that are C3D files, if the laboratory has any.
_IN_C3D: Final = ("trial_1", "trial_2")

#: Writes markers to a file.
Writer = Callable[[Markers, Path], None]


def write_synthetic_laboratory(folder: Path, truth: Path, *, write_c3d: Writer | None = None) -> None:
    """Write the files of the laboratory, each marked as synthetic.

    Args:
        folder: folder for the files
        truth: folder for the true values: ``truth.json`` and the angle of each release
        write_c3d: writes the first two releases as C3D files; if None, they are Vicon Nexus exports
            like the others

    Raises:
        OutputFileError: a file cannot be written
    """
    random = np.random.default_rng(_SEED)
    joystick = true_joystick()
    _write_bench(joystick, folder, random)
    releases = {
        f"{name}{'.c3d' if write_c3d and name in _IN_C3D else '.csv'}": _write_trial(
            joystick, name, folder, truth, random, write_c3d
        )
        for name in _TRIALS
    }
    content = {
        "about": "what the synthetic laboratory was made from; SI units, angles in rad",
        "parameters": joystick.to_names(),
        "curves": {side: {"x": table.x, "k": table.k} for side, table in _CURVES.items()},
        "marker_noise": _MARKER_NOISE,
        "radius": MarkerLayout().height,
        "acceleration_noise": _ACCELERATION_NOISE,
        "distance": _DISTANCE,
        "delay": _DELAY,
        "releases": releases,
    }
    write_text(truth / "truth.json", json.dumps(content, indent=2) + "\n")


def true_joystick() -> JoystickParameters:
    """The joystick of the laboratory."""
    parts = [
        Part(name=name, mass=Measured(mass), height=Measured(height), inertia=Measured(inertia))
        for name, (mass, height, inertia) in _PARTS.items()
    ]
    body = from_parts(parts)
    springs = {
        f"{side}.{name}": value
        for side, table in _CURVES.items()
        for name, value in _spring_values(ActuatorAssembly.from_table(table.x, table.k)).items()
    }
    measured = {"m": body.m.value, "h": body.h.value, "J": body.J.value, "damping.C": _DAMPING}
    return NOMINAL.replace(springs | _GEOMETRY | measured)


def _spring_values(actuator: ActuatorAssembly) -> dict[str, float]:
    """The springs of one side by name."""
    springs = {"returnSpring": actuator.return_spring, "balanceSpring": actuator.balance_spring}
    fields = ("k_s", "k_h", "F_0", "x_0")
    return {f"{name}.{field}": getattr(one, field) for name, one in springs.items() for field in fields}


def _write_bench(joystick: JoystickParameters, folder: Path, random: np.random.Generator) -> None:
    """Write the bench measurements of the joystick: load-deflection curves, parts, the swing test."""
    for side, table in _CURVES.items():
        travel, force = synthetic_load_cycle(table, random=random)
        rows = ([f"{1e3 * x:.5f}", f"{f:.4f}"] for x, f in zip(travel, force, strict=True))
        _write_table(folder / f"synthetic_{side}.csv", ["travel (mm)", "force (N)"], rows)
    headings = ["part", "mass (g)", "u_mass (g)", "height (mm)", "u_height (mm)"]
    headings += ["inertia (g.cm2)", "u_inertia (g.cm2)"]
    parts = []
    for name, true in _PARTS.items():
        errors = (_U_MASS, _U_HEIGHT, _U_INERTIA * true[2])
        read = [value + error * random.standard_normal() for value, error in zip(true, errors, strict=True)]
        cells = zip(read, errors, (1e3, 1e3, 1e7), (1, 2, 0), strict=True)
        parts.append([name, *(f"{factor * n:.{d}f}" for value, u, factor, d in cells for n in (value, u))])
    _write_table(folder / "synthetic_parts.csv", headings, parts)
    swing = synthetic_swing(joystick, random=random)
    rows = ([f"{t:.6f}", f"{math.degrees(a):.4f}"] for t, a in zip(swing.time, swing.theta, strict=True))
    _write_table(folder / "synthetic_swing.csv", ["time (s)", "theta (deg)"], rows)


def _write_trial(
    joystick: JoystickParameters,
    name: str,
    folder: Path,
    truth: Path,
    random: np.random.Generator,
    write_c3d: Writer | None,
) -> dict[str, float | str]:
    """Write the markers of one release, and for the first its accelerometer; returns the true values."""
    angle, heading = _TRIALS[name]
    start = 0.25 + random.uniform() / _RATE
    time, theta, alpha = _motion(joystick, angle, start)
    every = round(_ACCELEROMETER_RATE / _RATE)
    layout = MarkerLayout(heading=heading)
    frames = slice(None, None, every)
    seen = synthetic_markers(time[frames], theta[frames], random=random, noise=_MARKER_NOISE, layout=layout)
    for lost in _LOST:
        seen.positions[lost, 0] = np.nan
    if write_c3d and name in _IN_C3D:
        write_c3d(seen, folder / f"synthetic_{name}.c3d")
    else:
        _write_nexus(seen, folder / f"synthetic_{name}.csv")
    if name == "trial_1":
        reading = synthetic_acceleration(
            theta, alpha, distance=_DISTANCE, random=random, noise=_ACCELERATION_NOISE
        )
        rows = ([f"{t + _DELAY:.9g}", f"{a:.6g}"] for t, a in zip(time, reading, strict=True))
        _write_table(folder / "synthetic_acceleration_1.csv", ["time (s)", "acceleration (m/s2)"], rows)
    rows = ([f"{t:.9g}", f"{a:.9g}"] for t, a in zip(time[frames], theta[frames], strict=True))
    _write_table(truth / f"{name}.csv", ["time (s)", "theta (rad)"], rows)
    side = "forward" if theta[-1] > 0.0 else "backward"
    return {"release_angle": angle, "release_time": start, "rests": side}


def _motion(
    joystick: JoystickParameters, angle: float, start: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Time (s), angle (rad) and angular acceleration (rad/s2) of a joystick released at a given time."""
    time = np.arange(round(_DURATION * _ACCELEROMETER_RATE)) / _ACCELEROMETER_RATE
    after = time > start
    run = simulate(joystick, time=np.insert(time[after], 0, start), theta_start=angle)
    theta, alpha = np.full(len(time), angle), np.zeros(len(time))
    theta[after], alpha[after] = run.theta[1:], run.alpha[1:]
    return time, theta, alpha


def _write_table(path: Path, headings: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Write CSV that is marked as synthetic in its first line."""
    write_text(path, "\n".join(["# synthetic", ",".join(headings), *map(",".join, rows), ""]))


def _write_nexus(markers: Markers, path: Path) -> None:
    """Write the trajectories like a Vicon Nexus export, in mm, of a subject that is called synthetic."""
    count = len(markers.names)
    lines = [
        "Trajectories",
        f"{_RATE:g}",
        "," + "".join(f",synthetic:{name},," for name in markers.names),
        "Frame,Sub Frame" + ",X,Y,Z" * count,
        "," + ",mm" * (3 * count),
    ]
    for i, frame in enumerate(1e3 * markers.positions.reshape(len(markers.time), -1), start=1):
        lines.append(f"{i},0," + ",".join("" if math.isnan(value) else f"{value:.4f}" for value in frame))
    write_text(path, "\n".join([*lines, ""]))
