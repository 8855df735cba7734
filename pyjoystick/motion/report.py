"""Short reports in Markdown."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest

import pandas as pd

from pyjoystick.motion.comparison import Difference
from pyjoystick.motion.peaks import find_peaks, periods
from pyjoystick.support import TextTable, versions

#: Number of displacement peaks that eqs. (12a, b) compare.
_PEAKS = 9


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """A free oscillation on an FMU, and its differences from the reference.

    Attributes:
        run: the table of the FMU
        differences: differences from the reference
        events: crossings of kinks and of the middle in the reference
    """

    run: pd.DataFrame
    differences: Sequence[Difference]
    events: int


def free_oscillation_report(title: str, cases: Mapping[str, Case]) -> str:
    """Peaks, the period around each peak, and the largest differences from the reference, by label."""
    legend = "; ".join(cases)
    names = ", ".join(f"{name} {version}" for name, version in versions().items())
    return "\n".join(
        (
            f"# {title}",
            "",
            f"Side by side: {legend}.",
            "",
            peak_table([case.run for case in cases.values()]),
            "",
            _difference_table(cases),
            "",
            f"Made with {names}.",
            "",
        )
    )


def peak_table(runs: Sequence[pd.DataFrame]) -> str:
    """The first peaks of runs that start with the release, side by side: time, angle and period.

    Args:
        runs: tables over ``time`` (s) with ``theta`` (rad) and ``omega`` (rad/s)
    """
    columns = [_peak_cells(run) for run in runs]
    rows = [
        [str(number), *(cell for cells in row for cell in cells)]
        for number, row in enumerate(zip_longest(*columns, fillvalue=("", "", "")), start=1)
    ]
    return TextTable(["no.", *(["t (s)", "peak (deg)", "period (s)"] * len(runs))], rows).markdown()


def _peak_cells(run: pd.DataFrame) -> list[tuple[str, str, str]]:
    """Time, displacement and period of the first peaks as text."""
    peaks = find_peaks(run.index, run["theta"], run["omega"])
    spans = periods(peaks, release_time=float(run.index[0]))["period"]
    return [
        (f"{time:.5f}", f"{math.degrees(value):+.4f}", "" if math.isnan(span) else f"{span:.5f}")
        for time, value, span in zip_longest(
            peaks["time"][:_PEAKS], peaks["value"][:_PEAKS], spans[:_PEAKS], fillvalue=math.nan
        )
    ]


def _difference_table(cases: Mapping[str, Case]) -> str:
    by_name = [{one.variable: one for one in case.differences} for case in cases.values()]
    rows = []
    for name, unit in (("theta", "rad"), ("omega", "rad/s"), ("alpha", "rad/s2")):
        rows.append([f"{name} ({unit})", *(f"{differences[name].largest:.1e}" for differences in by_name)])
    rows.append(["state events of the reference", *(str(case.events) for case in cases.values())])
    return TextTable(["largest difference to the reference", *cases], rows).markdown()
