"""The response of a joystick to a shaken handle: 0.6 N m at 4 Hz, and around that frequency.

Shows the motions reached from different releases, with the share of the releases and the time up to which
runs can be trusted, and the branch of the large motion with its fold. Prints both and saves the figures in
results/response/. docs/response.md explains it.
"""

import sys
from pathlib import Path

import numpy as np

from pyjoystick import NOMINAL, Fmu, save_results
from pyjoystick.forced_motion import (
    PeriodicAttractor,
    Response,
    ShakenJoystick,
    Shaking,
    attractor_report,
    basins,
    branch_report,
    plot_attractors,
    plot_response,
)

JOYSTICK = NOMINAL  # read_parameters("joystick.toml") loads your own
SHAKING = Shaking(torque=0.6, frequency=4.0)  # N m, Hz
RANGE = (3.4, 4.4)  # Hz
RELEASES = np.radians([-20.0, -15.0, -10.0, -5.0, -1.0, 1.0, 5.0, 10.0, 15.0, 20.0])
RESULTS = Path(__file__).parents[1] / "results" / "response"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    with Fmu("Joystick") as fmu:
        shaken = ShakenJoystick(fmu, JOYSTICK, SHAKING)
        found = basins(shaken, RELEASES)
        response = Response(shaken, RANGE)
        large = next(one for one in found.attractors if isinstance(one, PeriodicAttractor))
        response.follow(shaken, large.solution)
        summary = "\n".join(
            (
                f"## {SHAKING.torque:g} N m at {SHAKING.frequency:g} Hz",
                "",
                attractor_report(found, shaken),
                "",
                "## The branch of the large motion",
                "",
                branch_report(response),
            )
        )
        figures = {"motions": plot_attractors(found, shaken), "branch": plot_response(response)}
    save_results(results, summary, figures)
    return 0


if __name__ == "__main__":
    sys.exit(main())
