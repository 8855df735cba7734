"""Makes the files of a synthetic laboratory: no joystick was measured, the reference was sampled.

    python scenarios/data/make_synthetic_laboratory.py laboratory

A joystick that is not the paper's: load-deflection curves of both sides with friction, its parts and a swing
test, four releases as cameras at 60 Hz see them (two C3D files, two exports as from Vicon Nexus, in one of
which the laboratory's x axis points backward), and the accelerometer of the first, whose clock is late.
There are noise and lost frames. What was put in is in the folder `truth`. ezc3d writes the C3D files.
"""

import json
import math
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

import ezc3d
import numpy as np

from pyjoystick.laboratory import (
    MarkerLayout,
    Markers,
    Measured,
    Part,
    from_parts,
    synthetic_acceleration,
    synthetic_load_cycle,
    synthetic_markers,
    synthetic_swing,
)
from pyjoystick.model import NOMINAL, ActuatorAssembly, JoystickParameters, SegmentTable, simulate
from pyjoystick.support import PyJoystickError, replacing, write_text

SEED = 274
#: Travels (m) and stiffnesses (N/m) of both sides.
CURVES = {
    "forward": SegmentTable((0.082e-3, 0.2105e-3, 2.861e-3, 2.873e-3), (412e3, 2740.0, 985e3, 5850.0)),
    "backward": SegmentTable((0.069e-3, 0.1580e-3, 3.010e-3, 3.0195e-3), (640e3, 1265.0, 1070e3, 4210.0)),
}
#: Part: mass (kg), height of its center (m), inertia about its center (kg m2).
PARTS = {"shaft": (0.36, 0.070, 1.2e-3), "grip": (0.35, 0.150, 6e-4), "cam": (0.20, -0.020, 3e-4)}
#: Standard uncertainties of masses (kg) and heights (m), and of inertias in parts of them.
U_MASS, U_HEIGHT, U_INERTIA = 5e-4, 3e-4, 0.03
GEOMETRY = {"a": 0.0241, "b": 0.0051}
DAMPING = 0.0512
RATE, ACCELEROMETER_RATE, DURATION = 60.0, 1800.0, 4.0
MARKER_NOISE, ACCELERATION_NOISE = 3e-4, 0.05  # m, m/s2
DISTANCE, DELAY = 0.25, 0.02  # m, s
TRIALS = {  # file: angle of release (rad), heading of forward in the laboratory (rad)
    "trial_1.c3d": (math.radians(-20.0), math.radians(4.0)),
    "trial_2.c3d": (math.radians(-19.8), math.radians(4.0)),
    "trial_3.csv": (math.radians(-20.1), math.radians(4.0)),
    "trial_4.csv": (math.radians(-19.9), math.radians(184.0)),
}
LOST = (slice(3, 5), slice(150, 157))  # frames without the top: in the hold and at rest
RESULTS = Path(__file__).parents[2] / "results" / "synthetic_laboratory"


def main(folder: Path = RESULTS) -> int:
    """Write the files into a folder."""
    random = np.random.default_rng(SEED)
    joystick = true_joystick()
    write_bench(joystick, folder, random)
    releases = {name: write_trial(joystick, name, folder, random) for name in TRIALS}
    truth = {
        "about": "what the synthetic laboratory was made from; SI units, angles in rad",
        "parameters": joystick.to_names(),
        "curves": {side: {"x": table.x, "k": table.k} for side, table in CURVES.items()},
        "marker_noise": MARKER_NOISE,
        "radius": MarkerLayout().height,
        "acceleration_noise": ACCELERATION_NOISE,
        "distance": DISTANCE,
        "delay": DELAY,
        "releases": releases,
    }
    write_text(folder / "truth" / "truth.json", json.dumps(truth, indent=2) + "\n")
    print(f"wrote a synthetic laboratory into {folder}")
    return 0


def true_joystick() -> JoystickParameters:
    """The joystick that the laboratory has."""
    parts = [
        Part(name=name, mass=Measured(mass), height=Measured(height), inertia=Measured(inertia))
        for name, (mass, height, inertia) in PARTS.items()
    ]
    body = from_parts(parts)
    springs = {
        f"{side}.{name}": value
        for side, table in CURVES.items()
        for name, value in spring_values(ActuatorAssembly.from_table(table.x, table.k)).items()
    }
    measured = {"m": body.m.value, "h": body.h.value, "J": body.J.value, "damping.C": DAMPING}
    return NOMINAL.replace(springs | GEOMETRY | measured)


def spring_values(actuator: ActuatorAssembly) -> dict[str, float]:
    """The springs of one side by name."""
    springs = {"returnSpring": actuator.return_spring, "balanceSpring": actuator.balance_spring}
    fields = ("k_s", "k_h", "F_0", "x_0")
    return {f"{name}.{field}": getattr(one, field) for name, one in springs.items() for field in fields}


def write_bench(joystick: JoystickParameters, folder: Path, random: np.random.Generator) -> None:
    """What is measured without cameras on the joystick: load-deflection curves, parts, the swing test."""
    for side, table in CURVES.items():
        travel, force = synthetic_load_cycle(table, random=random)
        rows = ([f"{1e3 * x:.5f}", f"{f:.4f}"] for x, f in zip(travel, force, strict=True))
        write_table(folder / f"synthetic_{side}.csv", ["travel (mm)", "force (N)"], rows)
    headings = ["part", "mass (g)", "u_mass (g)", "height (mm)", "u_height (mm)"]
    headings += ["inertia (g.cm2)", "u_inertia (g.cm2)"]
    parts = []
    for name, true in PARTS.items():
        errors = (U_MASS, U_HEIGHT, U_INERTIA * true[2])
        read = [value + error * random.standard_normal() for value, error in zip(true, errors, strict=True)]
        cells = zip(read, errors, (1e3, 1e3, 1e7), (1, 2, 0), strict=True)
        parts.append([name, *(f"{factor * n:.{d}f}" for value, u, factor, d in cells for n in (value, u))])
    write_table(folder / "synthetic_parts.csv", headings, parts)
    swing = synthetic_swing(joystick, random=random)
    rows = ([f"{t:.6f}", f"{math.degrees(a):.4f}"] for t, a in zip(swing.time, swing.theta, strict=True))
    write_table(folder / "synthetic_swing.csv", ["time (s)", "theta (deg)"], rows)


def write_trial(
    joystick: JoystickParameters, name: str, folder: Path, random: np.random.Generator
) -> dict[str, float | str]:
    """The markers of one release, and of the first its accelerometer; returns what was put in."""
    angle, heading = TRIALS[name]
    start = 0.25 + random.uniform() / RATE
    time, theta, alpha = motion(joystick, angle, start)
    every = round(ACCELEROMETER_RATE / RATE)
    layout = MarkerLayout(heading=heading)
    frames = slice(None, None, every)
    seen = synthetic_markers(time[frames], theta[frames], random=random, noise=MARKER_NOISE, layout=layout)
    for lost in LOST:
        seen.positions[lost, 0] = np.nan
    (write_c3d if name.endswith(".c3d") else write_nexus)(seen, folder / f"synthetic_{name}")
    if name == "trial_1.c3d":
        reading = synthetic_acceleration(
            theta, alpha, distance=DISTANCE, random=random, noise=ACCELERATION_NOISE
        )
        rows = ([f"{t + DELAY:.9g}", f"{a:.6g}"] for t, a in zip(time, reading, strict=True))
        write_table(folder / "synthetic_acceleration_1.csv", ["time (s)", "acceleration (m/s2)"], rows)
    rows = ([f"{t:.9g}", f"{a:.9g}"] for t, a in zip(time[frames], theta[frames], strict=True))
    write_table(folder / "truth" / f"{Path(name).stem}.csv", ["time (s)", "theta (rad)"], rows)
    side = "forward" if theta[-1] > 0.0 else "backward"
    return {"release_angle": angle, "release_time": start, "rests": side}


def motion(
    joystick: JoystickParameters, angle: float, start: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time (s), angle (rad) and angular acceleration (rad/s2) of a joystick that is let go at an instant."""
    time = np.arange(round(DURATION * ACCELEROMETER_RATE)) / ACCELEROMETER_RATE
    after = time > start
    run = simulate(joystick, time=np.insert(time[after], 0, start), theta_start=angle)
    theta, alpha = np.full(len(time), angle), np.zeros(len(time))
    theta[after], alpha[after] = run.theta[1:], run.alpha[1:]
    return time, theta, alpha


def write_table(path: Path, headings: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Write CSV that says in its first line that it is synthetic."""
    write_text(path, "\n".join(["# synthetic", ",".join(headings), *map(",".join, rows), ""]))


def write_c3d(markers: Markers, path: Path) -> None:
    """Write a C3D file in mm, of a subject that is called synthetic."""
    file = ezc3d.c3d()
    point = file["parameters"]["POINT"]
    point["RATE"]["value"] = [RATE]
    point["LABELS"]["value"] = [f"synthetic:{name}" for name in markers.names]
    point["UNITS"]["value"] = ["mm"]
    places = np.ones((4, len(markers.names), len(markers.time)))
    places[:3] = 1e3 * markers.positions.transpose(2, 1, 0)
    file["data"]["points"] = places
    with replacing(path) as temporary:
        file.write(str(temporary))


def write_nexus(markers: Markers, path: Path) -> None:
    """Write the trajectories as Vicon Nexus exports them, in mm, of a subject that is called synthetic."""
    count = len(markers.names)
    lines = [
        "Trajectories",
        f"{RATE:g}",
        "," + "".join(f",synthetic:{name},," for name in markers.names),
        "Frame,Sub Frame" + ",X,Y,Z" * count,
        "," + ",mm" * (3 * count),
    ]
    for i, frame in enumerate(1e3 * markers.positions.reshape(len(markers.time), -1), start=1):
        lines.append(f"{i},0," + ",".join("" if math.isnan(value) else f"{value:.4f}" for value in frame))
    write_text(path, "\n".join([*lines, ""]))


if __name__ == "__main__":
    try:
        sys.exit(main(*map(Path, sys.argv[1:2])))
    except PyJoystickError as error:
        sys.exit(f"error: {error}")
