"""Fig. 12: the energy falls in steps, and why the energy computed from a measured motion seems to rise.

A free oscillation is simulated, so that its energy is known, sampled at 60 Hz like the paper's cameras, and
processed by the paper's chain: spline to 600 Hz, Butterworth at 13 Hz forward and reverse, 5-point and
3-point derivatives. Prints the plateaus of the energy, the loss at the peaks of the velocity and the error
budget, and saves the figures in results/fig12_measured_energy/.
"""

import math
import sys
from pathlib import Path

import numpy as np
import pandas as pd

from pyjoystick import NOMINAL_POWER_LAW, Chain, TextTable, save_results
from pyjoystick.laboratory import LowPass, chain_effect, error_budget, error_budget_report, plot_chain_effect
from pyjoystick.reports import plateaus, plot_energy, sampled_closely

JOYSTICK = NOMINAL_POWER_LAW
RELEASE = math.radians(-20.0)
CHAINS = {  # label: the chain, the camera's rate (Hz)
    "13 Hz, camera 60 Hz": (Chain(), 60.0),
    "13 Hz, camera 240 Hz": (Chain(), 240.0),
    "13 Hz at -3 dB, camera 60 Hz": (Chain(low_pass=LowPass(corrected=True)), 60.0),
    "25 Hz, camera 60 Hz": (Chain(low_pass=LowPass(cutoff=25.0)), 60.0),
    "25 Hz, camera 240 Hz": (Chain(low_pass=LowPass(cutoff=25.0)), 240.0),
    "100 Hz, camera 240 Hz": (Chain(low_pass=LowPass(cutoff=100.0)), 240.0),
}
PEAKS = (0, 1, 2, 4, 6, 8)
SHOWN_PLATEAUS = 12
RESULTS = Path(__file__).parents[1] / "results" / "fig12_measured_energy"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    effects = {
        label: chain_effect(JOYSTICK, chain, release_angle=RELEASE, camera_rate=rate)
        for label, (chain, rate) in CHAINS.items()
    }
    rows = [
        [
            label,
            *(f"{100.0 * effect.shortfall[i]:.1f}" for i in PEAKS),
            f"{100.0 * effect.energy_rise / effect.energy_start:.1f}",
        ]
        for label, effect in effects.items()
    ]
    lost = TextTable(["lost (%)", *(f"peak {i + 1}" for i in PEAKS), "energy rises by"], rows).markdown()
    budget = error_budget(JOYSTICK, Chain(), release_angle=RELEASE, random=np.random.default_rng(1))
    title = "A simulated release through the paper's measuring chain, 60 Hz camera"
    run = sampled_closely(JOYSTICK, release_angle=RELEASE, duration=1.5)
    rests = plateaus(run)
    summary = "\n\n".join(
        (
            "## The plateaus of the energy",
            plateau_report(rests.head(SHOWN_PLATEAUS)),
            f"## {title}",
            lost,
            error_budget_report(budget),
        )
    )
    figures = {
        "plateaus": plot_energy(run, rests.head(SHOWN_PLATEAUS)),
        "energy": plot_chain_effect(JOYSTICK, effects["13 Hz, camera 60 Hz"]),
    }
    save_results(results, summary, figures)
    return 0


def plateau_report(rests: pd.DataFrame) -> str:
    """The plateaus in Markdown: position, duration, and the energy lost on them."""
    rows = [
        [
            f"{row.time:.4f}",
            f"{math.degrees(row.theta):+.2f}",
            f"{1e3 * row.energy:.2f}",
            f"{1e3 * (row.end - row.start):.1f}",
            f"{1e3 * row.lost:.3f}",
            f"{1e3 * row.swing_lost:.2f}",
        ]
        for row in rests.itertuples()
    ]
    header = ["turns at (s)", "angle (deg)", "energy (mJ)", "plateau (ms)", "lost on it (mJ)"]
    return TextTable([*header, "lost in the swing before (mJ)"], rows).markdown()


if __name__ == "__main__":
    sys.exit(main())
