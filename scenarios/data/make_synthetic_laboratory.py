"""Makes the files of a synthetic laboratory: no joystick was measured, the reference was sampled.

Four releases of the paper's joystick (eq. 11, alpha = 0.9) as cameras at 60 Hz and an accelerometer at
1800 Hz would record them, in results/synthetic_laboratory/: two C3D files, two exports as from Vicon Nexus,
in one of which the laboratory's x axis points backward, the accelerometer of the first, whose clock is late,
and truth.json with what was put in. There are noise and lost frames. ezc3d writes the C3D files.
"""

import json
import math
import sys
from pathlib import Path

import ezc3d
import numpy as np

from pyjoystick.measurements.markers import Markers
from pyjoystick.output import replacing, write_text
from pyjoystick.parameters import NOMINAL_POWER_LAW
from pyjoystick.reference import simulate
from pyjoystick.synthetic_laboratory import MarkerLayout, synthetic_acceleration, synthetic_markers

JOYSTICK = NOMINAL_POWER_LAW
SEED = 274
RATE, ACCELEROMETER_RATE, DURATION = 60.0, 1800.0, 3.0
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
    releases = {}
    every = round(ACCELEROMETER_RATE / RATE)
    for name, (angle, heading) in TRIALS.items():
        start = 0.25 + random.uniform() / RATE
        time, theta, alpha = motion(angle, start)
        layout = MarkerLayout(heading=heading)
        seen = synthetic_markers(
            time[::every], theta[::every], random=random, noise=MARKER_NOISE, layout=layout
        )
        for lost in LOST:
            seen.positions[lost, 0] = np.nan
        (write_c3d if name.endswith(".c3d") else write_nexus)(seen, folder / name)
        releases[name] = {"release_angle": angle, "release_time": start}
        if name == "trial_1.c3d":
            reading = synthetic_acceleration(
                theta, alpha, distance=DISTANCE, random=random, noise=ACCELERATION_NOISE
            )
            rows = [f"{t + DELAY:.9g},{a:.6g}" for t, a in zip(time, reading, strict=True)]
            heading_line = "time (s),acceleration (m/s2)"
            write_text(folder / "acceleration_1.csv", "\n".join(["# synthetic", heading_line, *rows, ""]))
    truth = {
        "about": "what the synthetic laboratory was made from; SI units, angles in rad",
        "joystick": "the paper's, eq. (11) with alpha = 0.9",
        "marker_noise": MARKER_NOISE,
        "acceleration_noise": ACCELERATION_NOISE,
        "distance": DISTANCE,
        "delay": DELAY,
        "releases": releases,
    }
    write_text(folder / "truth.json", json.dumps(truth, indent=2) + "\n")
    return 0


def motion(angle: float, start: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time (s), angle (rad) and angular acceleration (rad/s2) of a joystick that is let go at an instant."""
    time = np.arange(round(DURATION * ACCELEROMETER_RATE)) / ACCELEROMETER_RATE
    after = time > start
    run = simulate(JOYSTICK, time=np.insert(time[after], 0, start), theta_start=angle)
    theta, alpha = np.full(len(time), angle), np.zeros(len(time))
    theta[after], alpha[after] = run.theta[1:], run.alpha[1:]
    return time, theta, alpha


def write_c3d(markers: Markers, path: Path) -> None:
    """Write a C3D file in mm."""
    file = ezc3d.c3d()
    point = file["parameters"]["POINT"]
    point["RATE"]["value"] = [RATE]
    point["LABELS"]["value"] = list(markers.names)
    point["UNITS"]["value"] = ["mm"]
    places = np.ones((4, len(markers.names), len(markers.time)))
    places[:3] = 1e3 * markers.positions.transpose(2, 1, 0)
    file["data"]["points"] = places
    with replacing(path) as temporary:
        file.write(str(temporary))


def write_nexus(markers: Markers, path: Path) -> None:
    """Write the trajectories as Vicon Nexus exports them, in mm."""
    count = len(markers.names)
    lines = [
        "Trajectories",
        f"{RATE:g}",
        "," + "".join(f",Joystick:{name},," for name in markers.names),
        "Frame,Sub Frame" + ",X,Y,Z" * count,
        "," + ",mm" * (3 * count),
    ]
    for i, frame in enumerate(1e3 * markers.positions.reshape(len(markers.time), -1), start=1):
        lines.append(f"{i},0," + ",".join("" if math.isnan(value) else f"{value:.4f}" for value in frame))
    write_text(path, "\n".join([*lines, ""]))


if __name__ == "__main__":
    sys.exit(main())
