"""Write the synthetic records in this folder, sampled from the reference; no joystick was measured.

Four repeats for each damping law, as recorded by a camera at 60 Hz: held near -20 degrees, released between
two frames, with 0.1 degree of noise. The true values are stored with them as synthetic_*_truth.json. The same
seed gives the same files.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np

from pyjoystick import NOMINAL, NOMINAL_POWER_LAW, STOP_ANGLE, JoystickParameters, Record, simulate
from pyjoystick.laboratory import ANGLE_NOISE, CAMERA_RATE, synthetic_record
from pyjoystick.support import json_text, write_text

JOYSTICKS = {"constant": NOMINAL, "power_law": NOMINAL_POWER_LAW}
REPEATS = 4
SEED = 2004
RELEASE_SPREAD = math.radians(0.2)  # the release angle varies between repeats
HOLD = 0.25  # s, and up to one frame more
DRIVEN_RATE = 1000.0  # Hz
DRIVEN_NOISE = math.radians(0.02)
DRIVEN_START = math.radians(6.0)
DELAY = 0.004  # s


def main(folder: Path = Path(__file__).parent) -> int:
    """Write the records and their truths into a folder."""
    random = np.random.default_rng(SEED)
    for law, joystick in JOYSTICKS.items():
        truths = {}
        for number in range(1, REPEATS + 1):
            name = f"synthetic_{law}_{number}"
            release = {
                "release_time": HOLD + random.uniform() / CAMERA_RATE,
                "release_angle": -STOP_ANGLE + RELEASE_SPREAD * random.standard_normal(),
            }
            record = synthetic_record(joystick, random=random, name=name, **release)
            write_text(folder / f"{name}.csv", _csv(record))
            truths[name] = release
        write_text(folder / f"synthetic_{law}_truth.json", _truth(joystick, truths))
    _write_driven(folder, random)
    return 0


def _write_driven(folder: Path, random: np.random.Generator) -> None:
    """A hand pushes in both directions; torque and angle at 1 kHz, the angle `DELAY` behind the torque."""
    time = np.arange(3001) / DRIVEN_RATE
    # Nearly in equilibrium at first, pressed against one side.
    rest = simulate(NOMINAL, time=[0.0, 1.0], theta_start=DRIVEN_START)
    hold = 1.0001 * float(rest.M_s[0] - rest.M_g[0])
    corners, levels = [0.0, 0.25, 0.35, 0.75, 0.85, 1.3, 1.4, 1.8, 1.9, 2.4, 2.5, 3.0], [hold, hold]
    for push in (-1.6, 1.65, -1.7, 1.6, -1.65):
        levels += [push, push]
    torque = np.interp(time, corners, levels)
    run = simulate(
        NOMINAL,
        time=time,
        theta_start=DRIVEN_START,
        torque=lambda t: float(np.interp(t, corners, levels)),
        torque_breakpoints=corners,
    )
    theta = np.interp(time - DELAY, time, run.theta) + DRIVEN_NOISE * random.standard_normal(len(time))
    lines = [
        "# synthetic_driven_1: synthetic, no measurement; made by make_synthetic_records.py",
        f"# {DRIVEN_RATE:g} Hz; the angle has {math.degrees(DRIVEN_NOISE):g} degree of normal noise and lags "
        f"{1e3 * DELAY:g} ms behind the torque",
        "time (s),theta (deg),T (N.m)",
    ]
    lines += [
        f"{t:.3f},{math.degrees(a):.4f},{moment:.5f}"
        for t, a, moment in zip(time, theta, torque, strict=True)
    ]
    write_text(folder / "synthetic_driven_1.csv", "\n".join(lines) + "\n")
    truth = {
        "about": "what the synthetic driven record was made from; SI units, angles in rad",
        "noise": DRIVEN_NOISE,
        "rate": DRIVEN_RATE,
        "delay": DELAY,
        "theta_start": DRIVEN_START,
        "parameters": NOMINAL.to_names(),
    }
    write_text(folder / "synthetic_driven_truth.json", json_text(truth) + "\n")


def _csv(record: Record) -> str:
    lines = [
        f"# {record.name}: synthetic, no measurement; made by make_synthetic_records.py from the reference",
        f"# {CAMERA_RATE:g} Hz, normal noise, standard deviation {math.degrees(ANGLE_NOISE):g} degree",
        "time (s),theta (deg)",
    ]
    lines += [f"{t:.6f},{math.degrees(a):.4f}" for t, a in zip(record.time, record.theta, strict=True)]
    return "\n".join(lines) + "\n"


def _truth(joystick: JoystickParameters, releases: dict[str, dict[str, float]]) -> str:
    truth = {
        "about": "what the synthetic records were made from; SI units, angles in rad",
        "noise": ANGLE_NOISE,
        "rate": CAMERA_RATE,
        "seed": SEED,
        "parameters": joystick.to_names(),
        "releases": releases,
    }
    return json.dumps(truth, indent=2) + "\n"


if __name__ == "__main__":
    sys.exit(main())
