"""Fig. 15: the torque that moves the joystick forward and back, eq. (13), with both damping laws.

The inverse FMUs compute the torque and its parts; prints the difference to plain Python, and how well the
joystick's FMUs reproduce the motion under this torque. Then shows how the statements of section 5 depend on
the time of a stroke, and on the sign of an exponent of eq. (11). Figures, of the motion in closed form and of
its synthetic measurement, and the summary go to results/fig15_torque/.
"""

import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from pyjoystick import NOMINAL, NOMINAL_POWER_LAW, TextTable, save_results
from pyjoystick.forced_motion import (
    TORQUES,
    Samples,
    measure,
    measures_report,
    plot_torque,
    round_trip,
    seen_by_cameras,
    torque_by_fmu,
    torque_by_reference,
)
from pyjoystick.reports import MOTION, Section5, section_5

JOYSTICKS = {"constant": NOMINAL, "power-law": NOMINAL_POWER_LAW}
STROKES = (0.08, 0.1, 0.12, 0.15, 0.2, 0.3, 0.5)  # s
#: Eq. (11) with the exponent that falling lines in Fig. 9(a) would give at positive angles.
FALLING = NOMINAL_POWER_LAW.replace({"damping.n_pos": -0.084})
SEED = 15
RESULTS = Path(__file__).parents[1] / "results" / "fig15_torque"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    motions = {
        "torque": Samples.evenly(MOTION, 5e-4),
        "torque_measured": seen_by_cameras(MOTION, random=np.random.default_rng(SEED)),
    }
    figures = {
        name: plot_torque({law: torque_by_fmu(one, samples) for law, one in JOYSTICKS.items()})
        for name, samples in motions.items()
    }

    found, differences, returned = {}, [], []
    for law, joystick in JOYSTICKS.items():
        samples = Samples.of(joystick, MOTION)
        torque, expected = torque_by_fmu(joystick, samples), torque_by_reference(joystick, samples)
        found[law] = measure(joystick, samples, torque)
        differences += [
            np.abs(torque[name].to_numpy() - expected[name].to_numpy()).max() / expected[name].abs().max()
            for name in TORQUES
        ]
        returned.append(round_trip(joystick, MOTION).theta_error)
    degrees = math.degrees(MOTION.amplitude)
    summary = "\n\n".join(
        (
            f"## {degrees:g} degrees forward in {MOTION.rise:g} s and back, minimum jerk",
            measures_report(found),
            f"FMU against plain Python: {max(differences):.0e} of the largest value at most. "
            f"Torque put back into the FMUs: the angle differs by {max(returned):.0e} rad at most.",
            "## Section 5's statements over the time of a stroke",
            _statements(),
            "Printed n_pos: the coefficient rises with the angle. -n_pos: it falls, as section 3.3 says that "
            "the lines of Fig. 9 do.",
        )
    )
    save_results(results, summary, figures)
    return 0


def _statements() -> str:
    rows = []
    for stroke in STROKES:
        motion = replace(MOTION, rise=stroke)
        rows.append(_row(f"{stroke:g} s", section_5(motion), section_5(motion, power_law=FALLING)))
    measured = seen_by_cameras(MOTION, random=np.random.default_rng(SEED))
    label = f"{MOTION.rise:g} s, measured"
    rows.append(_row(label, section_5(measured), section_5(measured, power_law=FALLING)))
    backward = replace(MOTION, amplitude=-MOTION.amplitude)
    label = f"{MOTION.rise:g} s, backward"
    rows.append(_row(label, section_5(backward), section_5(backward, power_law=FALLING)))
    header = [
        "stroke",
        "inertia/stiffness",
        "damping/total, C",
        "eq. (11)",
        "eq. (11)/C",
        "with -n_pos",
    ]
    return TextTable(header, [["paper", "comparable", "about 10 %", "", "about 2", ""], *rows]).markdown()


def _row(label: str, printed: Section5, falling: Section5) -> list[str]:
    return [
        label,
        f"{printed.inertia_to_stiffness:.2f}",
        *(f"{100.0 * share:.1f} %" for share in printed.damping_to_total.values()),
        f"{printed.damping_ratio:.2f}",
        f"{falling.damping_ratio:.2f}",
    ]


if __name__ == "__main__":
    sys.exit(main())
