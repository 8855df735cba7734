"""From the synthetic laboratory to a fitted joystick in Python, with the error contribution of each stage.

Follows docs/your-joystick.md. Prints what each stage contributes to the errors of the angle, its velocity and
the period, and of the fitted moment of inertia and damping; all results are in results/your_joystick/.
"""

import math
import runpy
import sys
from pathlib import Path

import numpy as np

from pyjoystick import (
    NOMINAL,
    Chain,
    Fmu,
    JoystickParameters,
    measure_angle,
    read_markers,
    read_record,
    save_results,
)
from pyjoystick.identification import FITTED, Bench, Contribution, contribution_table, fit_contributions
from pyjoystick.laboratory import (
    AngleMeasurement,
    Measured,
    error_budget,
    fit_load_curve,
    from_parts,
    inertia_of_swing,
    period_of_record,
    read_load_curve,
    read_parts,
    rest_angle,
)

MAKER = Path(__file__).parent / "data" / "make_synthetic_laboratory.py"
SIDES = ("forward", "backward")
GEOMETRY = {"a": 0.0241, "b": 0.0051}
U_GEOMETRY = 1e-5  # m, uncertainty of a
RADIUS, U_RADIUS = 0.266, 5e-4  # m
FORWARD = {"trial_1.c3d": "x", "trial_2.c3d": "x", "trial_3.csv": "x", "trial_4.csv": "-x"}
RELEASE = math.radians(-20.0)
RESULTS = Path(__file__).parents[1] / "results" / "your_joystick"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    laboratory = results / "laboratory"
    runpy.run_path(str(MAKER))["main"](laboratory)
    bench = measure_bench(laboratory)
    angles = [measure_trial(laboratory / f"synthetic_{name}", bench.joystick) for name in FORWARD]
    records = [one.record(Path(one.source).stem) for one in angles]
    with Fmu("Joystick") as fmu:
        found, contributions = fit_contributions(records, bench, fmu, release_angle=RELEASE)
    contributions = [*measuring_stages(bench.joystick.replace(found.shared())), *contributions]
    values = (f"{name} = {found.value(name):.6g} +- {found.error(name):.1g}" for name in FITTED)
    table = contribution_table(contributions)
    summary = f"{', '.join(values)} (SI units), with the noise of the records alone\n\n{table}"
    save_results(results, summary, {})
    return 0


def measure_bench(laboratory: Path) -> Bench:
    """Load-deflection curves, parts and swing test."""
    curves = {side: fit_load_curve(read_load_curve(laboratory / f"synthetic_{side}.csv")) for side in SIDES}
    parts = from_parts(read_parts(laboratory / "synthetic_parts.csv"))
    m, h = (Measured(one.value, one.uncertainty) for one in (parts.m, parts.h))
    swing = period_of_record(read_record(laboratory / "synthetic_swing.csv", free_oscillation=False))
    inertia = inertia_of_swing(swing.period, m, h, Measured(NOMINAL.g))
    springs = {
        f"{side}.{name}": value for side in SIDES for name, (value, _) in curves[side].springs().items()
    }
    body = {"m": m.value, "h": h.value, "J": inertia.value}
    uncertainties = {"m": m.uncertainty, "h": h.uncertainty, "J": inertia.uncertainty, "a": U_GEOMETRY}
    return Bench(
        joystick=NOMINAL.replace(springs | body | GEOMETRY),
        curves=curves,
        uncertainties=uncertainties,
        scale=U_RADIUS / RADIUS,
    )


def measure_trial(file: Path, joystick: JoystickParameters) -> AngleMeasurement:
    """The angle of one release; the joystick leans forward at the end."""
    return measure_angle(
        read_markers(file),
        top="TOP",
        base=("BASE1", "BASE2"),
        forward=FORWARD[file.name.removeprefix("synthetic_")],
        radius=RADIUS,
        rest_angle=rest_angle(joystick, "forward"),
    )


def measuring_stages(joystick: JoystickParameters) -> list[Contribution]:
    """What the chain of section 2 does to a motion; the fit uses the angle before it."""
    random = np.random.default_rng(1)
    budget = error_budget(joystick, Chain(), release_angle=RELEASE, random=random, radius=RADIUS)
    return [
        Contribution(one.stage, one.theta, one.omega, one.period)
        for one in budget
        if not one.stage.startswith("all")
    ]


if __name__ == "__main__":
    sys.exit(main())
