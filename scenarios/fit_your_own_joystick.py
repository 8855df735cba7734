"""Fit a joystick to measured releases, from files to a judged answer.

Reads four records, fits the constant damping coefficient, the displacement terms of eq. (11) and all of
eq. (11) to them, and compares the three by information criteria and by the prediction of records left out.
The best of those that pass every check becomes a parameter file, which all commands read. The records here
are synthetic, made with eq. (11); put your own files in their place.
Everything is written into results/fit_your_own_joystick/.
"""

import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pyjoystick import (
    PAPER,
    Fit,
    fitted_joystick,
    read_parameter_file,
    read_repeats,
    save_results,
    write_parameters,
)
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    DISPLACEMENT_DAMPING,
    POWER_LAW_DAMPING,
    Candidate,
    compare_models,
    comparison_table,
    save_fit,
)

ROOT = Path(__file__).parents[1]
RECORDS = sorted((ROOT / "scenarios" / "data").glob("synthetic_power_law_*.csv"))
MODELS = {
    "constant": CONSTANT_DAMPING,
    "displacement terms": DISPLACEMENT_DAMPING,
    "power law": POWER_LAW_DAMPING,
}
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
        save_fit(candidate.fit, folder, f"Fit of the {candidate.name} damping")

    lines = [comparison_table(candidates), ""]
    for candidate in candidates:
        verdict = "trusted" if candidate.fit.trusted else "failed a check, see fit.md"
        lines.append(f"{candidate.name}: {verdict}; {candidate.fit.runs} runs, {candidate.fit.seconds:.1f} s")
        lines.append(f"  left over: {left_over(candidate.fit):.3f} deg root mean square")
    lines += ["", write_best(candidates, results / "joystick.toml")]
    save_results(results, "\n".join(lines), {})
    return 0


def write_best(candidates: Sequence[Candidate], path: Path) -> str:
    """Write the joystick of the best model whose fit passed every check; returns what was done."""
    trusted = [one for one in candidates if one.fit.trusted and one.fit.criteria is not None]
    if not trusted:
        return f"no fit can be trusted; {path.name} is not written"
    best = min(trusted, key=lambda one: one.fit.criteria.aicc)
    # Parameters that were not fitted keep the file's values or, without a file, the paper's.
    before = read_parameter_file(path) if path.exists() else PAPER
    law = "constant" if best.name == "constant" else "power-law"
    found = fitted_joystick(best.fit, before.with_law(law), before.uncertainties)
    sources = dict.fromkeys(found.tables, f"fit to {len(best.fit.records)} records")
    write_parameters(path, found.joystick, uncertainties=found.uncertainties, sources=sources)
    return f"{best.name}: written into {path.name}"


def left_over(fit: Fit) -> float:
    """Root mean square of the residuals (deg)."""
    residuals = np.concatenate([record.residuals() for record in fit.records])
    return math.degrees(float(np.sqrt(np.mean(residuals**2))))


if __name__ == "__main__":
    sys.exit(main())
