"""Fig. 1: a mass between two opposing restrained preloaded springs, with and without clearance.

Builds the FMU of PreloadedSprings.Examples.OpposingSprings, releases the mass, and compares the simulated
undamped periods with the closed form for piecewise linear forces, which is exact for this system. Prints them
and saves the figure and the FMU in results/fig01_opposing_springs/.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from fmu_build import build_fmu
from pyjoystick import (
    Fmu,
    RestrainedSpring,
    TextTable,
    dress,
    find_peaks,
    legend_above,
    line_style,
    save_results,
)
from pyjoystick.model import LineOscillator, LineSide

SPRING = {f"rightSpring.{field}": field for field in ("k_s", "k_h", "F_0")}
CLEARANCES = {"clearance 0.5 mm": 0.5e-3, "no clearance": 0.0}  # m
RELEASE = 10e-3  # m
AMPLITUDES = np.array([0.7, 1.0, 2.0, 4.0, 7.0, 10.0]) * 1e-3  # m
DURATION = 1.0  # s
OUTPUTS = ["mass.s", "mass.v", "E"]
RESULTS = Path(__file__).parents[1] / "results" / "fig01_opposing_springs"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    built = build_fmu("PreloadedSprings.Examples.OpposingSprings", results)
    time = np.linspace(0.0, DURATION, 4001)
    with Fmu(built.path) as fmu:
        oscillators = {label: oscillator(fmu, clearance) for label, clearance in CLEARANCES.items()}
        runs = {
            label: fmu.run(time, parameters={"mass.s": RELEASE, "clearance": clearance}, outputs=OUTPUTS)
            for label, clearance in CLEARANCES.items()
        }
        rows = [
            [f"{1e3 * amplitude:g}", *cells(fmu, oscillators, float(amplitude))] for amplitude in AMPLITUDES
        ]
    headings = [f"{label}, {what}" for label in CLEARANCES for what in ("period (ms)", "FMU off by")]
    table = TextTable(["amplitude (mm)", *headings], rows).markdown()
    rises = max(float(np.max(np.diff(run["E"]))) for run in runs.values())
    summary = (
        f"## Periods without damping, closed form\n\n{table}\n\nLargest rise of the energy: {rises:.1e} J."
    )
    save_results(results, summary, {"opposing_springs": plot(runs, oscillators)})
    return 0


def oscillator(fmu: Fmu, clearance: float) -> LineOscillator:
    """The FMU's system without its damper, in closed form."""
    start = {name: fmu.description.variables[name].start for name in ("mass.m", *SPRING)}
    spring = RestrainedSpring(x_0=clearance, **{field: float(start[name]) for name, field in SPRING.items()})
    return LineOscillator(float(start["mass.m"]), LineSide.of_spring(spring), LineSide.of_spring(spring))


def cells(fmu: Fmu, oscillators: dict[str, LineOscillator], amplitude: float) -> list[str]:
    """Period in closed form (ms), and the difference of the FMU's period, for each clearance."""
    texts = []
    for label, clearance in CLEARANCES.items():
        period = oscillators[label].oscillation(amplitude).period
        undamped = {"mass.s": amplitude, "clearance": clearance, "damper.d": 0.0}
        time = np.linspace(0.0, 1.2 * period, 1201)
        run = fmu.run(time, parameters=undamped, outputs=OUTPUTS, tolerance=1e-12)
        simulated = float(find_peaks(run.index, run["mass.s"], run["mass.v"])["time"].iloc[1])
        texts += [f"{1e3 * period:.4f}", f"{simulated / period - 1.0:+.0e}"]
    return texts


def plot(runs: dict[str, pd.DataFrame], oscillators: dict[str, LineOscillator]) -> Figure:
    """Position and energy over time with damping, and undamped periods over amplitudes."""
    figure = Figure(figsize=(7.0, 7.0), layout="constrained")
    position, energy, period = figure.subplots(3, 1)
    amplitudes = np.geomspace(0.52e-3, RELEASE, 200)
    for i, (label, run) in enumerate(runs.items()):
        style = line_style(i)
        position.plot(run.index, 1e3 * run["mass.s"], label=label, **style)
        energy.plot(run.index, 1e3 * run["E"], **style)
        periods = [1e3 * oscillators[label].oscillation(amplitude).period for amplitude in amplitudes]
        period.plot(1e3 * amplitudes, periods, **style)
    position.set_ylabel("Position (mm)")
    energy.set_ylabel("Energy (mJ)")
    period.set_ylabel("Undamped period (ms)")
    for axes in (position, energy):
        axes.set_xlabel("Time (s)")
        axes.set_xlim(0.0, DURATION)
    period.set_xlabel("Amplitude (mm)")
    period.set_xlim(0.0, 1e3 * RELEASE)
    period.set_ylim(bottom=0.0)
    dress(position, zero=True)
    dress(energy)
    dress(period)
    figure.align_ylabels([position, energy, period])
    legend_above(figure, position)
    return figure


if __name__ == "__main__":
    sys.exit(main())
