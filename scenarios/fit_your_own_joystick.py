"""Fit a joystick to measured releases, from files to a judged answer.

Reads four records, fits the constant damping coefficient and eq. (11) to them, and says which of the two the
records ask for, by information criteria and by the prediction of records left out. The records here are
synthetic, made with eq. (11); put your own files in their place. Everything is written into
results/fit_your_own_joystick/.
"""

import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pyjoystick.fitting import CONSTANT_DAMPING, POWER_LAW_DAMPING, Fit
from pyjoystick.fitting.figures import save_figures
from pyjoystick.fitting.json_report import as_json
from pyjoystick.fitting.selection import compare_models, comparison_table
from pyjoystick.fitting.text_report import report
from pyjoystick.output import write_text
from pyjoystick.records import read_repeats

ROOT = Path(__file__).parents[1]
RECORDS = sorted((ROOT / "scenarios" / "data").glob("synthetic_power_law_*.csv"))
MODELS = {"constant": CONSTANT_DAMPING, "power law": POWER_LAW_DAMPING}
RESULTS = ROOT / "results" / "fit_your_own_joystick"


def main(results: Path = RESULTS, paths: Sequence[Path] = RECORDS) -> int:
    """Run the scenario."""
    records = read_repeats(paths)
    for record in records:
        for note in record.notes:
            print(f"{record.name}: {note}")

    candidates = compare_models(records, MODELS)
    for candidate in candidates:
        folder = results / candidate.name.replace(" ", "_")
        write_text(folder / "fit.md", report(candidate.fit, f"Fit of the {candidate.name} damping"))
        write_text(folder / "fit.json", as_json(candidate.fit))
        save_figures(candidate.fit, folder)

    lines = [comparison_table(candidates), ""]
    for candidate in candidates:
        verdict = "trusted" if candidate.fit.trusted else "not to be trusted, see fit.md"
        lines.append(f"{candidate.name}: {verdict}; {candidate.fit.runs} runs, {candidate.fit.seconds:.1f} s")
        lines.append(f"  left over: {left_over(candidate.fit):.3f} deg root mean square")
    summary = "\n".join(lines) + "\n"
    write_text(results / "summary.md", summary)
    print(summary)
    return 0


def left_over(fit: Fit) -> float:
    """Root mean square of the residuals (deg)."""
    residuals = np.concatenate([record.residuals() for record in fit.records])
    return math.degrees(float(np.sqrt(np.mean(residuals**2))))


if __name__ == "__main__":
    sys.exit(main())
