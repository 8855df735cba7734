"""Makes the synthetic records beside it: no joystick was measured, the reference was sampled.

Four repeats for each damping law, as a camera at 60 Hz would see them: held near -20 degrees, released
between two frames, with 0.1 degree of noise. What was put in is stored beside them as synthetic_*_truth.json.
The same seed gives the same files.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np

from pyjoystick.laboratory import ANGLE_NOISE, CAMERA_RATE, synthetic_record
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, STOP_ANGLE, JoystickParameters
from pyjoystick.motion import Record
from pyjoystick.support import write_text

JOYSTICKS = {"constant": NOMINAL, "power_law": NOMINAL_POWER_LAW}
REPEATS = 4
SEED = 2004
RELEASE_SPREAD = math.radians(0.2)  # the hand does not let go at the very same angle
HOLD = 0.25  # s, and up to one frame more


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
    return 0


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
