"""Fig. 4: a free oscillation as recorded by a camera and an accelerometer.

The camera's record is synthetic (see scenarios/data) and processed by the paper's measuring chain; the ideal
accelerometer reads the motion from which the record was made. Prints the peaks and the contribution of
gravity to the accelerometer's signal, and saves the figure in results/fig04_instruments/.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np
import pandas as pd

from pyjoystick import NOMINAL_POWER_LAW, PIVOT_TO_TOP, Chain, read_repeats, save_results, simulate
from pyjoystick.laboratory import plot_instruments
from pyjoystick.motion import GRAVITY, peak_table

DATA = Path(__file__).parent / "data"
RECORD = DATA / "synthetic_power_law_1.csv"
TRUTH = DATA / "synthetic_power_law_truth.json"
DURATION = 1.25  # s
RESULTS = Path(__file__).parents[1] / "results" / "fig04_instruments"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    record = read_repeats([RECORD], released="backward")[0]
    motion = Chain().run(record.time, record.theta)
    release = json.loads(TRUTH.read_text(encoding="utf-8"))["releases"][record.name]
    start, angle = release["release_time"], release["release_angle"]
    true = simulate(NOMINAL_POWER_LAW, time=np.linspace(0.0, DURATION, 2251), theta_start=angle)
    # Peaks are searched after the release, where they are larger than the chain's noise.
    after = (motion.time > start) & (motion.time < start + DURATION)
    measured = pd.DataFrame(
        {"theta": motion.theta[after], "omega": motion.omega[after]}, index=motion.time[after] - start
    )
    simulated = pd.DataFrame({"theta": true.theta, "omega": true.omega}, index=true.time)
    gravity = GRAVITY * math.sin(abs(angle)) / (PIVOT_TO_TOP * float(np.max(np.abs(true.alpha))))
    summary = "\n".join(
        (
            "## Peaks: through the measuring chain, and true",
            "",
            peak_table([measured, simulated]),
            "",
            f"Gravity's part of the accelerometer's signal is at most {100.0 * gravity:.1f} % of the peak "
            "acceleration.",
        )
    )
    figure = plot_instruments(motion, true, release_time=start, distance=PIVOT_TO_TOP)
    save_results(results, summary, {"instruments": figure})
    return 0


if __name__ == "__main__":
    sys.exit(main())
