"""Fig. 7b: load-deflection curves of the actuators, steep at the preloads, with cubic fits.

The curves are those of Table 1; `pyjoystick import load-curve` fits your own. Prints forces and secant
stiffnesses at the kinks and the errors of the cubics, and saves the figure in results/fig07_load_deflection/.
"""

import sys
from pathlib import Path

from pyjoystick import NOMINAL, STOP_ANGLE, TextTable, save_results
from pyjoystick.laboratory import CubicFit, cubic_fits, plot_load_deflection
from pyjoystick.model import assembly_force

JOYSTICK = NOMINAL
RESULTS = Path(__file__).parents[1] / "results" / "fig07_load_deflection"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    fits = cubic_fits(JOYSTICK, STOP_ANGLE)
    parts = ["## Load-deflection curves up to the stops"]
    for side, fit in fits.items():
        parts.append(f"{side}:\n\n{kink_report(fit)}")
        parts.append(f"The cubic misses the curve by {fit.rms:.2f} N (rms).")
    save_results(results, "\n\n".join(parts), {"load_deflection": plot_load_deflection(fits)})
    return 0


def kink_report(fit: CubicFit) -> str:
    """Force, secant stiffness and the stiffness beyond each kink, in Markdown."""
    table = fit.assembly.to_table()
    rows = []
    for i, (x, k) in enumerate([*zip(table.x, table.k, strict=True), (fit.travel[-1], None)]):
        force = float(assembly_force(fit.assembly, x))
        name = "stop" if k is None else f"x_{i}"
        after = "" if k is None else f"{k:g}"
        rows.append([name, f"{1e3 * x:.4f}", f"{force:.3f}", f"{force / x:.0f}", after])
    return TextTable(
        ["", "travel (mm)", "force (N)", "force/travel (N/m)", "slope after (N/m)"], rows
    ).markdown()


if __name__ == "__main__":
    sys.exit(main())
