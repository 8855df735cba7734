"""A design as a table, as JSON and as a figure."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from pyjoystick.identification.design.choice import Design
from pyjoystick.identification.design.trial import Trial
from pyjoystick.support import FloatArray, TextTable, document_text, dress, legend_above


def design_table(rows: Mapping[str, Design]) -> str:
    """Table of standard errors in Markdown, one row per design; in percent, or in its unit if the value is 0.

    Args:
        rows: designs by name
    """
    table = TextTable(
        ["experiments", *_headings(next(iter(rows.values())))],
        [[label, *_cells(design)] for label, design in rows.items()],
    )
    return table.markdown()


def chosen_experiments(design: Design) -> str:
    """The chosen experiments as text: ``2 x release from 20 degrees, 1 x ...``."""
    return ", ".join(
        f"{count} x {one.experiment.name}"
        for one, count in zip(design.informations, design.counts, strict=True)
        if count
    )


def design_json(rows: Mapping[str, Design], trial: Trial | None, notes: Sequence[str] = ()) -> str:
    """The designs, their standard errors in the units of the FMU, and the check by simulation."""
    return document_text(
        "design",
        {
            "designs": [
                {
                    "name": label,
                    "experiments": [
                        {"name": one.experiment.name, "count": int(count)}
                        for one, count in zip(design.informations, design.counts, strict=True)
                        if count
                    ],
                    "parameters": [
                        {"name": name, "value": value, "standard_error": error}
                        for name, value, error in zip(design.names, design.values, design.errors, strict=True)
                    ],
                    "covariance": design.covariance,
                }
                for label, design in rows.items()
            ],
            "check": None
            if trial is None
            else {
                "sets": trial.sets,
                "parameters": [
                    {"name": name, "scatter_over_standard_error": ratio}
                    for name, ratio in zip(trial.names, trial.ratios, strict=True)
                ],
            },
        },
        notes,
    )


def plot_design(design: Design) -> Figure:
    """Plot the standard errors of the design and of records of one experiment alone.

    Releases are drawn over their angle, other experiments side by side.
    """
    total = int(np.sum(design.counts))
    each = np.eye(len(design.counts), dtype=np.intp) * total
    errors = np.array([_shown(design.with_counts(counts)) for counts in each])
    experiments = [one.experiment for one in design.informations]
    angles = np.array([math.degrees(one.release_angle) for one in experiments])
    are_releases = bool(np.all(angles != 0.0))
    places = angles if are_releases else np.arange(len(experiments), dtype=np.float64)
    figure = Figure(figsize=(7.0, 4.2), layout="constrained")
    axes = figure.subplots()
    order = np.argsort(places)
    style = "o-" if are_releases else "o"
    for j, name in enumerate(_headings(design)):
        (line,) = axes.semilogy(places[order], errors[order, j], style, markersize=4.0, label=name)
        axes.axhline(_shown(design)[j], color=line.get_color(), linestyle="--", linewidth=1.0)
    for place, count in zip(places, design.counts, strict=True):
        if count:
            axes.axvline(float(place), color="0.85", linewidth=1.5 * int(count), zorder=0)
    if not are_releases:
        axes.set_xticks(places, [one.name for one in experiments])
    what = "Release angle of all" if are_releases else "Torque of all"
    unit = " (deg)" if are_releases else ""
    axes.set_xlabel(f"{what} {total} records{unit}; dashed and grey: the best {total} together")
    axes.set_ylabel("Standard error (%)" if np.all(design.values) else "Standard error")
    dress(axes)
    legend_above(figure, axes)
    return figure


def _shown(design: Design) -> FloatArray:
    """Standard errors in percent, or in the parameter's unit if its value is 0."""
    zero = design.values == 0.0
    return design.errors / np.where(zero, 1.0, 0.01 * np.abs(design.values))


def _headings(design: Design) -> list[str]:
    units = design.informations[0].units or ("",) * len(design.names)
    return [
        f"{name} (%)" if value else f"{name} ({unit})" if unit else name
        for name, value, unit in zip(design.names, design.values, units, strict=True)
    ]


def _cells(design: Design) -> list[str]:
    return [
        "not determined" if not error < (1e6 if value else math.inf) else f"{error:.2g}"
        for error, value in zip(_shown(design), design.values, strict=True)
    ]
