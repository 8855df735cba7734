"""Do 95 % intervals hold the truth in 95 % of cases? A Monte Carlo of fits to synthetic records.

    python -m benchmarks.fit_coverage            # all cases, 200 data sets of four records each
    python -m benchmarks.fit_coverage --sets 50 --case constant

Every data set has four releases made by the pure-Python reference, sampled at 60 Hz with 0.1 degree of white
noise. The release angle differs from repeat to repeat and the release falls anywhere between two samples, as
in a laboratory. Prints a Markdown table for docs/fitting-accuracy.md.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import sys
import time
from collections import defaultdict
from typing import Final

import numpy as np

from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    DISPLACEMENT_DAMPING,
    Fit,
    FitSettings,
    Free,
    Uncertainty,
    fit,
    with_friction,
)
from pyjoystick.laboratory import synthetic_record
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters
from pyjoystick.motion import Record
from pyjoystick.support import TextTable

RECORDS: Final = 4
NOISE: Final = math.radians(0.1)
#: Number of data sets between two lines of progress.
_NEWS: Final = 10
_PRELOADS: Final = ("forward.returnSpring.F_0", "backward.returnSpring.F_0")
_SPRINGS: Final = dataclasses.replace(
    CONSTANT_DAMPING,
    free=(*CONSTANT_DAMPING.free, *(Free(name, start=1.05 * NOMINAL.to_names()[name]) for name in _PRELOADS)),
)
CASES: Final[dict[str, tuple[FitSettings, JoystickParameters, tuple[str, ...]]]] = {
    "constant": (CONSTANT_DAMPING, NOMINAL, ("damping.C",)),
    "friction": (with_friction(CONSTANT_DAMPING), NOMINAL.replace({"friction.T_c": 0.0072}), ()),
    "springs": (_SPRINGS, NOMINAL, _PRELOADS),
    # The profile of the most curved parameter only; all four would take most of the time.
    "displacement": (
        DISPLACEMENT_DAMPING,
        NOMINAL_POWER_LAW.replace({"damping.alpha": 1.0}),
        ("damping.n_neg",),
    ),
}


def main() -> None:
    """Run the requested cases and print their tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sets", type=int, default=200, help="data sets of each case")
    parser.add_argument("--case", choices=(*CASES, "all"), default="all", help="what is fitted")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    for case in CASES if options.case == "all" else [options.case]:
        print(coverage_table(case, options.sets, options.seed), flush=True)


def coverage_table(case: str, sets: int, seed: int) -> str:
    """Return the table of one case: how often each interval contains the truth, and the bias of the fits."""
    settings, truth, profiles = CASES[case]
    settings = dataclasses.replace(settings, uncertainty=Uncertainty(profiles=profiles))
    hits: dict[str, list[bool]] = defaultdict(list)
    profile_hits: dict[str, list[bool]] = defaultdict(list)
    deviations: dict[str, list[float]] = defaultdict(list)
    doubted, runs, begun = 0, 0, time.perf_counter()
    with Fmu(settings.fmu) as fmu:
        for number in range(sets):
            records, known = _data_set(truth, np.random.default_rng([seed, number]))
            found = fit(records, settings, fmu=fmu)
            doubted += not found.trusted
            runs += found.runs
            _count(found, known, hits, profile_hits, deviations)
            if (number + 1) % _NEWS == 0:
                seconds = time.perf_counter() - begun
                print(
                    f"{case}: {number + 1} of {sets} data sets, {seconds:.0f} s", file=sys.stderr, flush=True
                )
    rows = [
        [
            name,
            str(len(hits[name])),
            f"{100.0 * np.mean(hits[name]):.1f} %",
            f"{100.0 * np.mean(profile_hits[name]):.1f} %" if profile_hits[name] else "",
            f"{np.mean(deviations[name]):+.2f}",
            f"{np.std(deviations[name]):.2f}",
        ]
        for name in hits
    ]
    header = ["parameter", "intervals", "linear holds", "profile holds", "mean of z", "deviation of z"]
    seconds = time.perf_counter() - begun
    return (
        f"{case}: {sets} data sets of {RECORDS} records, {runs} runs, {seconds:.0f} s; "
        f"{doubted} fits were called doubtful\n\n{TextTable(header, rows).markdown()}\n"
    )


def _data_set(
    truth: JoystickParameters, random: np.random.Generator
) -> tuple[list[Record], dict[str, float]]:
    """Return four records, and the true values by label."""
    known = truth.to_names()
    records = []
    for number in range(1, RECORDS + 1):
        name = f"run {number}"
        angle = math.radians(-20.0 + 0.3 * random.standard_normal())
        release = 0.1 + random.uniform(0.0, 1.0 / 60.0)
        records.append(
            synthetic_record(
                truth,
                release_angle=angle,
                random=random,
                name=name,
                release_time=release,
                duration=1.6,
                noise=NOISE,
            )
        )
        known[f"theta_start [{name}]"] = angle
        known[f"release_time [{name}]"] = release
        known[f"zero_offset [{name}]"] = 0.0
    return records, known


def _count(
    found: Fit,
    known: dict[str, float],
    hits: dict[str, list[bool]],
    profile_hits: dict[str, list[bool]],
    deviations: dict[str, list[float]],
) -> None:
    for j, variable in enumerate(found.variables):
        truth = known[variable.label]
        low, high = found.intervals[j]
        hits[variable.name].append(bool(low <= truth <= high))
        deviations[variable.name].append(float((found.x[j] - truth) / found.standard_errors.errors[j]))
        if j in found.profiles:
            low, high = found.profiles[j].interval
            profile_hits[variable.name].append(low <= truth <= high)


if __name__ == "__main__":
    main()
