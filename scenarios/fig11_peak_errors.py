"""Fig. 11: how well simulations with different damping match measured peaks, by the errors of eqs. (12a, b).

The records are synthetic, made with the power law, eq. (11), at alpha = 0.9 (see scenarios/data). Sweeps
alpha in the power law and C in the constant law, prints the errors with their minima and saves the figure in
results/fig11_peak_errors/.
"""

import sys
from pathlib import Path

import numpy as np

from pyjoystick import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    SimulatedReleases,
    measured_peaks,
    read_repeats,
    save_results,
)
from pyjoystick.identification import peak_error_report, plot_peak_errors
from pyjoystick.motion import average_peaks, sweep_peak_errors

RECORDS = sorted((Path(__file__).parent / "data").glob("synthetic_power_law_?.csv"))
SWEEPS = {  # label: the joystick, the parameter that varies, its values
    "alpha": (NOMINAL_POWER_LAW, "damping.alpha", np.linspace(0.0, 1.0, 41)),
    "C (N m s/rad)": (NOMINAL, "damping.C", np.linspace(0.02, 0.08, 61)),
}
SHOWN = {"alpha": (0.0, 0.5, 0.9, 1.0), "C (N m s/rad)": (0.03, 0.045, 0.06, 0.08)}
RESULTS = Path(__file__).parents[1] / "results" / "fig11_peak_errors"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    records = read_repeats(RECORDS, released="backward")
    measured = average_peaks([measured_peaks(record) for record in records])
    sweeps = {}
    with SimulatedReleases() as simulate:
        for label, (joystick, name, values) in SWEEPS.items():
            runs = simulate.vary(joystick, measured.release_angle, name, values)
            sweeps[label] = sweep_peak_errors(runs, runs.__getitem__, measured)
    title = f"Average of {len(records)} synthetic records against simulations"
    summary = f"## {title}, eqs. (12a, b)\n\n{peak_error_report(sweeps, SHOWN)}"
    save_results(results, summary, {"errors": plot_peak_errors(sweeps, title=title)})
    return 0


if __name__ == "__main__":
    sys.exit(main())
