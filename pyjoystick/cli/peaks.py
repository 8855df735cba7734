"""``pyjoystick peaks``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

from pyjoystick import identification, model, motion, runs, support
from pyjoystick.cli import joystick_choice, options, parsing
from pyjoystick.cli.console import output, print_warnings, progress_console, write, write_json, write_plot
from pyjoystick.cli.fmus import found_or_built

EXAMPLES: Final = """
Examples:

    pyjoystick peaks trial1.csv trial2.csv trial3.csv trial4.csv
    pyjoystick peaks trial*.csv --column theta=AngleX --unit theta=deg --unit time=s
    pyjoystick peaks trial1.csv --released backward --set J=0.012 --json peaks.json --plot peaks.png
"""


def run(
    records: options.Records,
    columns: options.Columns = None,
    units: options.Units = None,
    released: options.Released = None,
    parameters: options.Parameters = None,
    assignments: options.Set = None,
    csv: Annotated[Path | None, options.csv("the peaks and the C of each")] = None,
    json: Annotated[Path | None, options.json("the estimates and their biases")] = None,
    plot: Annotated[Path | None, options.plot("C over the peaks")] = None,
) -> None:
    """Estimate the damping from the peaks of free oscillations (eqs. 9 and 10), and its bias."""
    support.check_outputs(csv, json, plot)
    changes = parsing.parse_assignments(assignments, "--set")
    joystick = joystick_choice.joystick_of(None, changes, joystick_choice.parameter_file(parameters))
    headings = parsing.parse_headings(columns, units)
    read = motion.read_repeats(
        records, columns=headings["columns"], units=headings["units"], released=released
    )
    for record in read:
        print_warnings(record.name, record.notes)
    print_warnings("J", identification.inertia_doubts(joystick, read))
    releases = [motion.measured_peaks(record) for record in read]
    estimate = identification.estimate_damping(releases, joystick.J)
    for law in (model.NOMINAL, model.NOMINAL_POWER_LAW):
        found_or_built(runs.fmu_of_joystick(law))
    with runs.SimulatedReleases() as simulate, progress_console().status("simulating"):
        constants, lines = identification.biases(estimate, joystick, releases, simulate)
    console = output()
    console.print(identification.releases_report(releases))
    console.print()
    console.print(identification.damping_report(estimate, constants, lines))
    found = releases, estimate, constants, lines
    write(csv, lambda path: support.write_text(path, identification.damping_csv(estimate)))
    write_json(json, lambda notes: identification.damping_json(*found, notes))
    constant = constants["both"].corrected
    write_plot(plot, lambda: identification.plot_damping_estimate(estimate, constant=constant))
