"""The paper's free oscillation (section 3.3, Fig. 10): released at -20 degrees.

Runs the FMUs of both damping laws, compares them with the pure-Python reference and writes the motion, the
figure and a summary into results/free_oscillation/. Edit the settings below to make it yours.
"""

import math
import sys
from pathlib import Path

from pyjoystick import (
    PAPER,
    compare,
    free_oscillation,
    line_style,
    plot_motion,
    reference_free_oscillation,
    save_results,
    write_csv,
)
from pyjoystick.motion import Case, free_oscillation_report, within_limits

RELEASE_ANGLE = math.radians(-20.0)
DURATION = 1.5  # s
FILE = PAPER  # read_parameter_file("joystick.toml") loads your own joystick
JOYSTICKS = {
    "constant damping": FILE.with_law("constant"),
    "power-law damping": FILE.with_law("power-law"),
}
LIMITS = {"theta": 1e-7}  # rad, largest difference to the reference
RESULTS = Path(__file__).parents[1] / "results" / "free_oscillation"


def main(results: Path = RESULTS) -> int:
    """Run the scenario; returns 1 if an FMU differs from the reference by more than `LIMITS`."""
    cases = {}
    for label, joystick in JOYSTICKS.items():
        run = free_oscillation(RELEASE_ANGLE, parameters=joystick, duration=DURATION)
        reference = reference_free_oscillation(RELEASE_ANGLE, parameters=joystick, duration=DURATION)
        differences = compare(run, reference, limits=LIMITS)
        cases[label] = Case(run, differences, events=len(reference.attrs["events"]))
        write_csv(run, results / f"{label.replace(' ', '_')}.csv")

    styles = dict(zip(JOYSTICKS, (line_style("constant"), line_style("power-law")), strict=True))
    figure = plot_motion({label: case.run for label, case in cases.items()}, styles=styles)
    summary = free_oscillation_report(f"Free oscillation from {math.degrees(RELEASE_ANGLE):g} degrees", cases)
    save_results(results, summary, {"motion": figure})
    return 0 if all(within_limits(case.differences) for case in cases.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
