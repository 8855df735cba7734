"""The load of 20,000 moves per shift on an operator (section 1) by preload, stiffness and speed.

The moves are synthetic, drawn with a fixed seed: see `MOVES`. Each variant is a run of the inverse FMU.
Prints forces, work and impulse and saves the figure in results/ergonomics/.
"""

import sys
from pathlib import Path

from pyjoystick import NOMINAL, Fmu, save_results
from pyjoystick.forced_motion import (
    MOVES_PER_SHIFT,
    PRELOADS,
    STIFFNESSES,
    MoveDistribution,
    demand_report,
    demands,
    faster,
    inverse_fmu,
    plot_demands,
    scaled,
)

MOVES = MoveDistribution().draw(60, seed=1)
JOYSTICK = NOMINAL  # read_parameters("joystick.toml") loads your own
RESULTS = Path(__file__).parents[1] / "results" / "ergonomics"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    springs = {
        "Preload": {
            "as it is": JOYSTICK,
            "half": scaled(JOYSTICK, PRELOADS, 0.5),
            "one and a half": scaled(JOYSTICK, PRELOADS, 1.5),
        },
        "Stiffness": {
            "as it is": JOYSTICK,
            "half": scaled(JOYSTICK, STIFFNESSES, 0.5),
            "double": scaled(JOYSTICK, STIFFNESSES, 2.0),
        },
    }
    speeds = {"as it is": 1.0, "half": 0.5, "double": 2.0}
    with Fmu(inverse_fmu(JOYSTICK.damping)) as fmu:
        groups = {
            name: dict(zip(variants, demands(list(variants.values()), MOVES, fmu=fmu), strict=True))
            for name, variants in springs.items()
        }
        groups["Speed"] = {
            label: demands([JOYSTICK], faster(MOVES, factor), fmu=fmu)[0] for label, factor in speeds.items()
        }
    rows = {"as it is": groups["Preload"]["as it is"]}
    for name, variants in groups.items():
        rows |= {f"{name.lower()}, {label}": one for label, one in variants.items() if label != "as it is"}
    title = f"A shift of {MOVES_PER_SHIFT:,} moves"
    nominal = rows["as it is"]
    summary = "\n\n".join(
        (
            f"## {title}, {len(MOVES)} of them invented, {nominal.time:.2f} s each",
            demand_report(rows),
            "F: force at the handle that is not exceeded for that part of the time of the moves. W+: work of "
            "the hand on the joystick. W-: work of the joystick on the hand, which a muscle has to take up.",
        )
    )
    save_results(results, summary, {"force": plot_demands(groups, title=title)})
    return 0


if __name__ == "__main__":
    sys.exit(main())
