"""Why the period falls with the amplitude: the paper's main finding, from the energy and in closed form.

Compares undamped periods by quadrature with those that the FMU simulates without damping, those with
linearized geometry in closed form, and those of two decaying free oscillations. Prints them and saves the
figure in results/period/. docs/period.md explains it.
"""

import math
import sys
from pathlib import Path

import numpy as np
import pandas as pd

from pyjoystick import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    Fmu,
    TextTable,
    find_peaks,
    free_oscillation,
    line_style,
    save_results,
)
from pyjoystick.model import decaying_periods, exponent, period_table, plot_periods

JOYSTICK = NOMINAL  # read_parameters("joystick.toml") loads your own
RELEASE = math.radians(-20.0)
SHOWN = -np.radians([0.3, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0])
DRAWN = -np.radians(np.geomspace(0.2, 20.8, 250))
DECAYING = {"constant": NOMINAL, "power-law": NOMINAL_POWER_LAW}
RESULTS = Path(__file__).parents[1] / "results" / "period"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    table, curve = period_table(JOYSTICK, SHOWN), period_table(JOYSTICK, DRAWN)
    table["exponent"] = np.interp(-table["release"], -curve["release"], exponent(curve))
    with Fmu("Joystick") as fmu:
        table["simulated"] = [simulated_period(fmu, row.release, row.period) for row in table.itertuples()]
    decaying = {}
    for law, joystick in DECAYING.items():
        run = free_oscillation(RELEASE, parameters=joystick)
        periods = decaying_periods(find_peaks(run.index, run["theta"], run["omega"]))
        decaying[f"{law} damping"] = periods, line_style(law)["color"]
    shortest = curve.loc[curve["period"].idxmin()]
    summary = "\n".join(
        (
            "## Undamped periods",
            "",
            report(table),
            "",
            f"The shortest period, {1e3 * shortest['period']:.2f} ms, is that of "
            f"{math.degrees(shortest['amplitude']):.2f} degrees. Below, the clearance takes over.",
        )
    )
    save_results(results, summary, {"period": plot_periods(curve, decaying)})
    return 0


def simulated_period(fmu: Fmu, release: float, expected: float) -> float:
    """The period (s) of the FMU without damping: the time of the second peak after a release at rest."""
    parameters = JOYSTICK.replace({"damping.C": 0.0})
    run = free_oscillation(
        release,
        fmu=fmu,
        parameters=parameters,
        duration=1.2 * expected,
        output_interval=1e-3 * expected,
        tolerance=1e-12,
    )
    peaks = find_peaks(run.index, run["theta"], run["omega"])
    return float(peaks["time"].iloc[1])


def report(table: pd.DataFrame) -> str:
    """The periods in Markdown, and the time spent in each part of the motion."""
    rows = [
        [
            f"{math.degrees(row.release):g}",
            f"{1e3 * row.period:.5f}",
            f"{row.simulated / row.period - 1.0:+.0e}",
            f"{100.0 * (row.linearized / row.period - 1.0):+.2f}",
            f"{row.exponent:+.2f}",
            *(f"{100.0 * part:.0f}" for part in (row.clearance, row.steep, row.soft)),
        ]
        for row in table.itertuples()
    ]
    header = ["release (deg)", "period (ms)", "FMU off by", "linearized off by (%)", "exponent"]
    return TextTable([*header, "clearance (%)", "steep (%)", "soft (%)"], rows).markdown()


if __name__ == "__main__":
    sys.exit(main())
