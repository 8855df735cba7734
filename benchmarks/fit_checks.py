"""Do fits of wrong physics fail, and fits of the right one pass? The checks of a fit, measured.

    python -m benchmarks.fit_checks                       # every case, 20 data sets each, 200 clean ones
    python -m benchmarks.fit_checks --case friction --sets 50

Every data set has four releases, sampled at 60 Hz with 0.1 degree of noise; the release angle differs from
repeat to repeat and the release falls anywhere between two samples. C and what belongs to each record are
fitted by the default settings, whatever the records were made with. Prints a Markdown table for
docs/fitting-accuracy.md: the bias of C, how often its 95 % interval contains the truth, how often the fit
fails and by which checks, and how often it names what is wrong.
"""

from __future__ import annotations

import argparse
import dataclasses
import sys
import time
from collections import Counter
from collections.abc import Sequence
from typing import Final

import numpy as np

from benchmarks.disturbed_records import CASES, Case, disturbed_records
from pyjoystick.fmu import Fmu
from pyjoystick.identification import CONSTANT_DAMPING, Fit, FitError, Uncertainty, fit
from pyjoystick.model import NOMINAL
from pyjoystick.support import TextTable

_SETTINGS: Final = dataclasses.replace(CONSTANT_DAMPING, uncertainty=Uncertainty(profiles=()))
_TRUTH: Final = NOMINAL.to_names()["damping.C"]
_HEADER: Final = (
    *("what the records have", "size", "sets", "bias of C", "in standard errors", "beyond 3"),
    *("interval holds", "fails", "beyond 3 and passes", "failed checks", "named"),
)


def main() -> None:
    """Run the requested cases and print their tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, default=20, help="data sets of each case")
    parser.add_argument("--clean", type=int, default=200, help="data sets without anything wrong")
    parser.add_argument("--case", choices=(*CASES, "all"), default="all")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chosen = CASES if options.case == "all" else {options.case: CASES[options.case]}
    rows, begun = [], time.perf_counter()
    with Fmu(_SETTINGS.fmu) as fmu:
        for name, case in chosen.items():
            for size in case.sizes:
                sets = options.sets if size else options.clean
                rows.append(row(fmu, name, case, size, sets, options.seed))
                print(
                    f"{time.perf_counter() - begun:.0f} s: {' | '.join(rows[-1])}",
                    file=sys.stderr,
                    flush=True,
                )
    print(TextTable(_HEADER, rows).markdown())


def row(fmu: Fmu, name: str, case: Case, size: float, sets: int, seed: int) -> Sequence[str]:
    """One line of the table."""
    found: list[Fit] = []
    broken = 0
    for number in range(sets):
        random = np.random.default_rng([seed, number, *name.encode()])
        try:
            found.append(fit(disturbed_records(case, size, random), _SETTINGS, fmu=fmu))
        except FitError:
            broken += 1
    z = np.array([(one.value("damping.C") - _TRUTH) / one.error("damping.C") for one in found])
    bias = np.array([one.value("damping.C") / _TRUTH - 1.0 for one in found])
    holds = [one.intervals[0][0] <= _TRUTH <= one.intervals[0][1] for one in found]
    passed = np.array([one.trusted for one in found])
    far = np.abs(z) > 3.0
    failed = Counter(check.name for one in found for check in one.checks if not check.passed)
    named = sum(_names(one, case.suspects) for one in found)
    return [
        name,
        f"{size:g} {case.unit}".strip() if size else "none",
        str(sets) + (f" ({broken} refused)" if broken else ""),
        f"{100.0 * bias.mean():+.2f} %",
        f"{np.median(np.abs(z)):.1f}",
        f"{100.0 * far.mean():.0f} %",
        f"{100.0 * np.mean(holds):.0f} %",
        f"{100.0 * np.mean(~passed):.1f} %",
        f"{100.0 * np.mean(far & passed):.0f} %",
        ", ".join(f"{check} {count}" for check, count in failed.most_common()),
        f"{100.0 * named / max(len(found), 1):.0f} %" if case.suspects else "",
    ]


def _names(found: Fit, suspects: Sequence[str]) -> bool:
    """Return whether the fit names one of the suspects as the best explanation of the residuals."""
    messages = [
        check.message for check in found.checks if check.name == "missing physics" and not check.passed
    ]
    return any(suspect in message for message in messages for suspect in suspects)


if __name__ == "__main__":
    main()
