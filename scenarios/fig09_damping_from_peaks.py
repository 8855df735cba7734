"""Fig. 9: the damping from the peaks of four free oscillations, and the error of the method.

The records are synthetic (see scenarios/data). To use your own, provide one CSV file per repeat with the
columns time (s) and theta (deg). Prints the estimates and their biases and saves the figures in
results/fig09_damping_from_peaks/.
"""

import sys
from pathlib import Path

import numpy as np

from pyjoystick import (
    NOMINAL,
    SimulatedReleases,
    estimate_damping,
    measured_peaks,
    read_repeats,
    save_results,
)
from pyjoystick.identification import (
    bias_report,
    bias_table,
    biases,
    damping_report,
    plot_damping_estimate,
    releases_report,
)

DATA = Path(__file__).parent / "data"
RECORDS = {
    "eq. (11) with alpha = 0.9": sorted(DATA.glob("synthetic_power_law_?.csv")),
    "constant C = 0.045": sorted(DATA.glob("synthetic_constant_?.csv")),
}
JOYSTICK = NOMINAL  # all but the damping is considered known; read_parameters("joystick.toml") loads your own
TRUE_C = (0.02, 0.03, 0.045, 0.06, 0.08)  # N m s/rad
RELEASE_ANGLES = np.radians([-20.0, -10.0])
RESULTS = Path(__file__).parents[1] / "results" / "fig09_damping_from_peaks"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    texts, figures = [], {}
    with SimulatedReleases() as simulate:
        for law, paths in RECORDS.items():
            releases = [measured_peaks(record) for record in read_repeats(paths, released="backward")]
            estimate = estimate_damping(releases, JOYSTICK.J)
            constants, lines = biases(estimate, JOYSTICK, releases, simulate)
            title = f"{len(releases)} synthetic records made with {law}"
            texts += [f"## {title}", releases_report(releases), damping_report(estimate, constants, lines)]
            figure = plot_damping_estimate(estimate, constant=constants["both"].corrected, title=title)
            figures[paths[0].stem[:-2]] = figure
        table = bias_table(JOYSTICK, TRUE_C, RELEASE_ANGLES, simulate)
    texts += ["## What the method makes of a known constant C, as parts of it", bias_report(table)]
    save_results(results, "\n\n".join(texts), figures)
    return 0


if __name__ == "__main__":
    sys.exit(main())
