"""Fig. 10: a measured free oscillation and simulations with the damping function and with a constant.

The record is synthetic (see scenarios/data) and processed by the paper's measuring chain; to use your own,
provide a CSV file with the columns time (s) and theta (deg). Prints the peaks and their errors, eqs. (12a,
b), and saves the figure in results/fig10_free_oscillation/.
"""

import sys
from pathlib import Path

import pandas as pd

from pyjoystick import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    Chain,
    TextTable,
    free_oscillation,
    line_style,
    measured_peaks,
    plot_motion,
    read_repeats,
    save_results,
)
from pyjoystick.motion import peak_errors, peak_table, peaks_of_run

RECORD = Path(__file__).parent / "data" / "synthetic_power_law_1.csv"
DURATION = 1.25  # s
SIMULATED = {
    "damping function": (NOMINAL_POWER_LAW, line_style("power-law")),
    f"constant C = {NOMINAL.to_names()['damping.C']:g}": (NOMINAL, line_style("constant")),
}
RESULTS = Path(__file__).parents[1] / "results" / "fig10_free_oscillation"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    record = read_repeats([RECORD], released="backward")[0]
    release = measured_peaks(record)
    motion = Chain().run(record.time, record.theta)
    clock = motion.time - release.release_time
    shown = (clock >= 0.0) & (clock <= DURATION)
    series = {name: getattr(motion, name)[shown] for name in ("theta", "omega", "alpha")}
    measured = pd.DataFrame(series, index=clock[shown])
    runs = {
        label: free_oscillation(release.release_angle, parameters=joystick, duration=DURATION)
        for label, (joystick, _) in SIMULATED.items()
    }
    errors = [
        [label, *(f"{error:.1f}" for error in (found.displacement, found.displacement_time))]
        for label, found in ((label, peak_errors(peaks_of_run(run), release)) for label, run in runs.items())
    ]
    summary = "\n\n".join(
        (
            f"## Peaks: {', '.join(runs)}",
            peak_table(list(runs.values())),
            TextTable(["error against the record (%)", "displacement", "its time"], errors).markdown(),
        )
    )
    styles = {label: style for label, (_, style) in SIMULATED.items()}
    styles["measured (synthetic)"] = line_style("measured")
    figure = plot_motion({"measured (synthetic)": measured, **runs}, styles=styles)
    save_results(results, summary, {"free_oscillation": figure})
    return 0


if __name__ == "__main__":
    sys.exit(main())
