"""Fig. 13: the damping function of eq. (11) over time, with its jumps, and the equivalent constant.

Prints the change of the function within 1 ms of the zeros of angle and velocity, and its means; saves the
figure in results/fig13_damping_function/.
"""

import math
import sys
from pathlib import Path

from pyjoystick import NOMINAL, NOMINAL_POWER_LAW, TextTable, save_results
from pyjoystick.reports import (
    damping_jumps,
    equivalent_damping,
    mean_damping,
    plot_damping_function,
    sampled_closely,
)

JOYSTICK = NOMINAL_POWER_LAW
CONSTANT = NOMINAL.to_names()["damping.C"]
RELEASE = math.radians(-20.0)
DURATION = 0.75  # s, some eleven peaks
SHOWN = 10
RESULTS = Path(__file__).parents[1] / "results" / "fig13_damping_function"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    run = sampled_closely(JOYSTICK, release_angle=RELEASE, duration=DURATION)
    jumps, equivalent = damping_jumps(run), equivalent_damping(run)
    rows = [
        [f"{row.time:.4f}", str(row.zero), f"{math.degrees(row.amplitude):.2f}", f"{row.jump:.4f}"]
        for row in jumps.head(SHOWN).itertuples()
    ]
    largest = jumps.groupby("zero")["jump"].max()
    summary = "\n".join(
        (
            f"## The damping function, alpha = {JOYSTICK.to_names()['damping.alpha']:g}, {DURATION:g} s",
            "",
            TextTable(["time (s)", "zero of", "amplitude (deg)", "change of C (N m s/rad)"], rows).markdown(),
            "",
            f"Largest change: {largest['theta']:.3f} where theta is zero, {largest['omega']:.3f} where omega "
            "is.",
            f"Mean over time {mean_damping(run):.4f}; a constant {equivalent:.4f} takes as much energy along "
            f"this motion; the paper's constant is {CONSTANT:g} N m s/rad.",
        )
    )
    figure = plot_damping_function(run, constant=CONSTANT, equivalent=equivalent)
    save_results(results, summary, {"damping_function": figure})
    return 0


if __name__ == "__main__":
    sys.exit(main())
