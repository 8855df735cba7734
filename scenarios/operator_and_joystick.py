"""An operator's hand moves the joystick: two FMUs in one SSP archive, coupled at communication points.

Writes results/operator_and_joystick/joystick.ssp, reads it back and runs it; prints the coupling error,
relative to the same system as one model, over the communication step, and the gain from input derivatives and
saved FMU states.
"""

import math
import sys
from pathlib import Path

from pyjoystick import Fmu, TextTable, save_results
from pyjoystick.runs import (
    coupling_errors,
    operator_and_joystick,
    orders,
    plot_operated_joystick,
    plot_step_errors,
    read_ssp,
    run_coupled,
    write_ssp,
)

STEPS = (20e-3, 10e-3, 5e-3, 2e-3, 1e-3, 0.5e-3)  # s
RESULTS = Path(__file__).parents[1] / "results" / "operator_and_joystick"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    write_ssp(operator_and_joystick(), results / "joystick.ssp")
    system = read_ssp(results / "joystick.ssp", results / "unpacked")
    with Fmu("OperatedJoystick") as monolithic:
        errors = coupling_errors(system, "joystick.theta", monolithic=monolithic, steps=STEPS)
    run = run_coupled(system, step=1e-3, scheme="iterate")
    found = orders(errors)
    rows = [
        [scheme, *(f"{error:.1e}" for error in table["error"]), f"{found[str(scheme)]:.2f}"]
        for scheme, table in errors.groupby("scheme", sort=False)
    ]
    work = [
        [scheme, *(f"{count}" for count in table["fmu_steps"])]
        for scheme, table in errors.groupby("scheme", sort=False)
    ]
    headings = [f"H = {1e3 * step:g} ms" for step in STEPS]
    summary = "\n".join(
        (
            "## Operator and joystick, coupled",
            "",
            "Largest error of theta (rad):",
            "",
            TextTable(["scheme", *headings, "order"], rows).markdown(),
            "",
            "Steps of FMUs in all:",
            "",
            TextTable(["scheme", *headings], work).markdown(),
            "",
            f"The joystick reaches {math.degrees(run['joystick.theta'].max()):.1f} of the wanted "
            f"{math.degrees(run['operator.theta_ref'].max()):.1f} degrees; the operator needs up to "
            f"{run['operator.T'].max():.2f} N m and does {1e3 * run['operator.W'].iloc[-1]:.1f} mJ of work.",
        )
    )
    figures = {"motion": plot_operated_joystick(run), "errors": plot_step_errors(errors)}
    save_results(results, summary, figures)
    return 0


if __name__ == "__main__":
    sys.exit(main())
