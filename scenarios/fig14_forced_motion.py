"""Fig. 14: a joystick moved forward and back, exactly and as measured by the paper's cameras.

The paper does not print its motion as numbers. This one is in closed form, so that it is known exactly; the
measurement is synthetic: markers with noise at 60 Hz, processed by the chain of section 2. Prints the peaks
of both and saves the figure in results/fig14_forced_motion/.
"""

import math
import sys
from pathlib import Path

import numpy as np

from pyjoystick import NOMINAL, TextTable, line_style, plot_motion, save_results, write_csv
from pyjoystick.forced_motion import Samples, seen_by_cameras, torque_by_reference
from pyjoystick.reports import MOTION

INTERVAL = 1e-3  # s
SEED = 14
RESULTS = Path(__file__).parents[1] / "results" / "fig14_forced_motion"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    motions = {
        "in closed form": Samples.evenly(MOTION, INTERVAL),
        "synthetic measurement": seen_by_cameras(MOTION, random=np.random.default_rng(SEED)),
    }
    rows = [
        [
            name,
            f"{math.degrees(samples.theta.max()):.2f}",
            f"{samples.omega.max():.2f}",
            f"{samples.omega.min():.2f}",
            f"{samples.alpha.max():.1f}",
            f"{samples.alpha.min():.1f}",
        ]
        for name, samples in motions.items()
    ]
    header = ["", "angle (deg)", "velocity (rad/s)", "lowest", "acceleration (rad/s2)", "lowest"]
    tables = {name: torque_by_reference(NOMINAL, samples) for name, samples in motions.items()}
    for name, table in tables.items():
        write_csv(table, results / f"{name.replace(' ', '_')}.csv")
    title = f"Forward and back, {math.degrees(MOTION.amplitude):g} degrees in {MOTION.rise:g} s"
    styles = dict(zip(tables, (line_style(1), line_style("measured")), strict=True))
    summary = f"## {title}: peaks\n\n{TextTable(header, rows).markdown()}"
    save_results(results, summary, {"motion": plot_motion(tables, styles=styles)})
    return 0


if __name__ == "__main__":
    sys.exit(main())
