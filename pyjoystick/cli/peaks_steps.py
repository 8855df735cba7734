"""The steps of ``pyjoystick peaks``: read records, estimate the damping, find the bias, print and draw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from pyjoystick.cli.console import messages, output, print_note
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.identification import (
    constant_bias,
    damping_report,
    estimate_damping,
    line_bias,
    releases_report,
)
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, JoystickParameters
from pyjoystick.motion import MeasuredPeaks, Side, measured_peaks, read_repeats
from pyjoystick.runs import SimulatedReleases, fmu_of_damping


def estimate_and_show(
    paths: Sequence[Path],
    joystick: JoystickParameters,
    *,
    columns: Mapping[str, str],
    units: Mapping[str, str],
    released: Side | None,
    plot: Path | None,
) -> None:
    """Estimate the damping of a joystick from the records of some files."""
    records = read_repeats(paths, columns=columns, units=units, released=released)
    for record in records:
        for note in record.notes:
            print_note(f"{record.name}: {note}")
    releases = [measured_peaks(record) for record in records]
    estimate = estimate_damping(releases, joystick.J)
    for law in (NOMINAL, NOMINAL_POWER_LAW):
        found_or_built(fmu_of_damping(law.damping))
    with SimulatedReleases() as simulate, messages().status("simulating"):
        constants = constant_bias(estimate, joystick, _mean_angle(releases), simulate)
        lines = line_bias(estimate, joystick, _mean_angle(releases), simulate)
    console = output()
    console.print(releases_report(releases))
    console.print()
    console.print(damping_report(estimate, constants, lines))
    if plot is not None:
        from pyjoystick.identification import plot_damping_estimate
        from pyjoystick.support import save_figure

        save_figure(plot_damping_estimate(estimate, constant=constants["both"].corrected), plot)
        print_note(f"wrote {plot}")


def _mean_angle(releases: Sequence[MeasuredPeaks]) -> float:
    return float(np.mean([release.release_angle for release in releases]))
