"""Write the files of a synthetic laboratory, sampled from the reference; no joystick was measured.

    python scenarios/data/make_synthetic_laboratory.py laboratory

The same files as from `pyjoystick new laboratory --example`, except for the first two releases, which are C3D
files written by ezc3d. The true values are in the folder `truth`.
"""

import sys
from pathlib import Path

import ezc3d
import numpy as np

from pyjoystick import PyJoystickError
from pyjoystick.laboratory import Markers, write_synthetic_laboratory
from pyjoystick.support import replacing

RESULTS = Path(__file__).parents[2] / "results" / "synthetic_laboratory"


def main(folder: Path = RESULTS) -> int:
    """Write the files into a folder."""
    write_synthetic_laboratory(folder, folder / "truth", write_c3d=write_c3d)
    print(f"wrote a synthetic laboratory into {folder}")
    return 0


def write_c3d(markers: Markers, path: Path) -> None:
    """Write a C3D file in mm, with a subject named synthetic."""
    file = ezc3d.c3d()
    point = file["parameters"]["POINT"]
    point["RATE"]["value"] = [markers.rate]
    point["LABELS"]["value"] = [f"synthetic:{name}" for name in markers.names]
    point["UNITS"]["value"] = ["mm"]
    places = np.ones((4, len(markers.names), len(markers.time)))
    places[:3] = 1e3 * markers.positions.transpose(2, 1, 0)
    file["data"]["points"] = places
    with replacing(path) as temporary:
        file.write(str(temporary))


if __name__ == "__main__":
    try:
        sys.exit(main(*map(Path, sys.argv[1:2])))
    except PyJoystickError as error:
        sys.exit(f"error: {error}")
