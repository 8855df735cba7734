"""From the synthetic laboratory to a fitted joystick in Python, and what each stage adds to its errors.

The way of docs/your-joystick.md. Prints what each stage contributes to the angle, its velocity and the
period, and to the fitted moment of inertia and damping; everything is in results/your_joystick/.
"""

import dataclasses
import math
import runpy
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pyjoystick.fitting import Fit
from pyjoystick.fmu import Fmu
from pyjoystick.inertia import Measured, from_parts, inertia_of_swing, period_of_record, read_parts
from pyjoystick.laboratory_errors import (
    FITTED,
    Contribution,
    contribution_table,
    curve_axes,
    noise_contribution,
    refit,
    run_contribution,
    with_fitted,
)
from pyjoystick.load_curve import LoadCurveFit, fit_load_curve, read_load_curve
from pyjoystick.measurement_errors import error_budget
from pyjoystick.measurements.angle import AngleMeasurement, measure_angle
from pyjoystick.measurements.chain import Chain
from pyjoystick.measurements.reading import read_markers
from pyjoystick.measurements.rest_position import rest_angle
from pyjoystick.output import write_text
from pyjoystick.parameters import NOMINAL, SIDES, JoystickParameters, Side
from pyjoystick.records import Record, read_record
from pyjoystick.reference import simulate

MAKER = Path(__file__).parent / "data" / "make_synthetic_laboratory.py"
GEOMETRY = {"a": 0.0241, "b": 0.0051}
U_GEOMETRY = 1e-5  # m, of a
RADIUS, U_RADIUS = 0.266, 5e-4  # m
FORWARD = {"trial_1.c3d": "x", "trial_2.c3d": "x", "trial_3.csv": "x", "trial_4.csv": "-x"}
RELEASE = math.radians(-20.0)
RESULTS = Path(__file__).parents[1] / "results" / "your_joystick"


@dataclass(frozen=True)
class Bench:
    """What is measured without cameras: the joystick but for its damping, with standard uncertainties."""

    joystick: JoystickParameters
    curves: dict[Side, LoadCurveFit]
    uncertainties: dict[str, float]


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    laboratory = results / "laboratory"
    runpy.run_path(str(MAKER))["main"](laboratory)
    bench = measure_bench(laboratory)
    angles = [measure_trial(laboratory / f"synthetic_{name}", bench.joystick) for name in FORWARD]
    with Fmu("Joystick") as fmu:
        records = [one.record(Path(one.source).stem) for one in angles]
        found = refit(records, bench.joystick, fmu)
        fitted = dataclasses.replace(bench, joystick=bench.joystick.replace(found.shared()))
        contributions = [
            *measuring_stages(fitted.joystick),
            *record_stages(fitted.joystick, angles, records, found, fmu),
            *bench_stages(fitted, records, found, fmu),
            noise_contribution("fit, noise of the records", fitted.joystick, found, release_angle=RELEASE),
        ]
    values = (f"{name} = {found.value(name):.6g} +- {found.error(name):.1g}" for name in FITTED)
    table = contribution_table(contributions)
    summary = f"{', '.join(values)} (SI units), with the noise of the records alone\n\n{table}\n"
    write_text(results / "summary.md", summary)
    print(summary)
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
    return Bench(NOMINAL.replace(springs | body | GEOMETRY), curves, uncertainties)


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
    """What the chain of section 2 does to a motion; the fit takes the angle before it."""
    random = np.random.default_rng(1)
    budget = error_budget(joystick, Chain(), release_angle=RELEASE, random=random, radius=RADIUS)
    return [
        Contribution(one.stage, one.theta, one.omega, one.period)
        for one in budget
        if not one.stage.startswith("all")
    ]


def record_stages(
    joystick: JoystickParameters,
    angles: Sequence[AngleMeasurement],
    records: Sequence[Record],
    found: Fit,
    fmu: Fmu,
) -> list[Contribution]:
    """Scale and zero of the records, which no number of frames averages out."""
    scale = U_RADIUS / RADIUS
    run = simulate(joystick, time=np.arange(901) / 600.0, theta_start=RELEASE)
    theta, omega = (scale * float(np.sqrt(np.mean(one**2))) for one in (run.theta, run.omega))
    zero = angles[0].noise / math.sqrt(15.0)  # frames of the last 0.25 s
    scaled = [dataclasses.replace(one, theta=one.theta * (1.0 + scale)) for one in records]
    shifted = [
        [dataclasses.replace(one, theta=one.theta + zero * (one is moved)) for one in records]
        for moved in records
    ]
    return [
        with_fitted(Contribution("radius, 0.5 mm", theta, omega, 0.0), found, [refit(scaled, joystick, fmu)]),
        with_fitted(
            Contribution("zero, from the noise at rest", theta=zero),
            found,
            [refit(one, joystick, fmu) for one in shifted],
        ),
    ]


def bench_stages(bench: Bench, records: Sequence[Record], found: Fit, fmu: Fmu) -> list[Contribution]:
    """What is known before the fit. As J is fitted, that of the swing test counts for runs only."""
    joystick = bench.joystick
    moved = {f"load curve, {side}": curve_axes(joystick, side, bench.curves[side]) for side in SIDES}
    values = joystick.to_names()
    for name, error in bench.uncertainties.items():
        moved[f"{name}, {error:.1g}"] = [joystick.replace({name: values[name] + error})]
    stages = []
    for stage, joysticks in moved.items():
        run = run_contribution(stage, joystick, joysticks, release_angle=RELEASE)
        if not stage.startswith("J"):
            run = with_fitted(run, found, [refit(records, one, fmu) for one in joysticks])
        stages.append(run)
    return stages


if __name__ == "__main__":
    sys.exit(main())
