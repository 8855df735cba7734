"""The two forms of ``pyjoystick compare``: with the reference, and of two FMUs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import pandas as pd
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from pyjoystick.cli.console import messages, output, print_note
from pyjoystick.cli.difference_table import print_differences
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.options import DEFAULT_RELEASE_ANGLE, DampingLaw, law_of, parameter_file, parse_angle
from pyjoystick.cli.setup import opened
from pyjoystick.fmu import FmuDescription, Interface, read_description
from pyjoystick.motion import read_csv_file
from pyjoystick.runs import (
    Declarations,
    FmuComparison,
    Limits,
    RunComparison,
    Tolerances,
    as_json,
    compare_fmus,
    compare_with_reference,
    experiments_for,
)
from pyjoystick.support import DEFAULT_DURATION, DEFAULT_OUTPUT_INTERVAL, check_outputs, versions, write_text

#: Interfaces by their short names.
INTERFACES: Final[Mapping[str, Interface]] = {"me": "ModelExchange", "cs": "CoSimulation"}
_TITLES: Final[Mapping[Interface, str]] = {"ModelExchange": "Model Exchange", "CoSimulation": "Co-Simulation"}


@dataclass(frozen=True, slots=True)
class Request:
    """What both forms of the command understand; None stands for what suits the FMUs.

    Attributes:
        angles: of release (rad)
        duration, output_interval: of each run (s)
        interface: how the FMUs are run
        limits: by name of the variable
        tolerances: of the integrators
        json: where to write everything
        every_run: show all runs instead of the worst one of each variable
    """

    angles: Sequence[float] | None
    duration: float | None
    output_interval: float | None
    interface: Interface | None
    limits: Mapping[str, float]
    tolerances: Tolerances
    json: Path | None
    every_run: bool


@dataclass(frozen=True, slots=True)
class BetweenFmus:
    """What the form for two FMUs understands besides.

    Attributes:
        parameters: a parameter file for both
        settings: parameters and inputs of both by name, which go before the file
        relative_limit: of the variables without a limit of their own; None for the preset one
        cs_limits: what is judged in Co-Simulation
        variables: what is compared; None for the outputs
        inputs: a CSV file
    """

    parameters: Path | None
    settings: Mapping[str, float]
    relative_limit: float | None
    cs_limits: Mapping[str, float]
    variables: Sequence[str] | None
    inputs: Path | None


def with_reference(
    name: str | None,
    damping: DampingLaw | None,
    parameters: Path | None,
    assignments: list[str] | None,
    request: Request,
) -> bool:
    """Compare an FMU with the reference and print what came of it; False where a limit is exceeded."""
    check_outputs(request.json)
    interface = request.interface or "CoSimulation"
    angles = [parse_angle(DEFAULT_RELEASE_ANGLE)] if request.angles is None else request.angles
    duration = DEFAULT_DURATION if request.duration is None else request.duration
    step = DEFAULT_OUTPUT_INTERVAL if request.output_interval is None else request.output_interval
    with opened(damping, name, assignments, parameters) as (fmu, joystick), messages().status("") as status:
        description = fmu.description
        runs = compare_with_reference(
            description.path,
            joystick,
            angles,
            duration=duration,
            output_interval=step,
            interface=interface,
            limits=request.limits,
            tolerances=request.tolerances,
            on_run=status.update,
        )
    releases = ", ".join(run.experiment for run in runs)
    console = output()
    console.print(
        f"{escape(description.path.name)} against the reference: free oscillation from {releases}, "
        f"{duration:g} s, {_solver(interface, request.tolerances)}"
    )
    print_differences(console, runs, every_run=request.every_run)
    _write_json([description], runs, request)
    return all(run.within_limits for run in runs)


def of_two(first: str, second: str, between: BetweenFmus, request: Request) -> bool:
    """Compare two FMUs and print what came of it; False where a limit is exceeded."""
    check_outputs(request.json)
    paths = found_or_built(first), found_or_built(second)
    descriptions = [read_description(path) for path in paths]
    experiments = experiments_for(
        *descriptions,
        release_angles=request.angles,
        duration=request.duration,
        output_interval=request.output_interval,
        settings={**_joystick(between, descriptions[0]), **between.settings},
        inputs=None if between.inputs is None else _read_inputs(between.inputs),
    )
    limits = Limits(absolute=request.limits, co_simulation=between.cs_limits)
    if between.relative_limit is not None:
        limits = Limits(request.limits, between.relative_limit, between.cs_limits)
    with messages().status("") as status:
        comparison = compare_fmus(
            *paths,
            experiments=experiments,
            interfaces=None if request.interface is None else [request.interface],
            variables=between.variables,
            limits=limits,
            tolerances=request.tolerances,
            on_run=status.update,
        )
    _print_comparison(output(), comparison, request.every_run)
    _write_json([comparison.first, comparison.second], comparison.runs, request, comparison.declarations)
    return comparison.within_limits


def _joystick(between: BetweenFmus, fmu: FmuDescription) -> Mapping[str, float]:
    """What the parameter file sets, with the damping law of the FMU."""
    if between.parameters is None:
        return {}
    return parameter_file(between.parameters).with_law(law_of(fmu).value).to_names()


def _print_comparison(console: Console, comparison: FmuComparison, every_run: bool) -> None:
    facts = Table.grid(padding=(0, 2))
    for label, fmu in (("first", comparison.first), ("second", comparison.second)):
        facts.add_row(f"[dim]{label}[/dim]", escape(str(fmu.path)), escape(fmu.model_name), _made_by(fmu))
    for column in facts.columns:
        column.overflow = "fold"
    console.print(facts)
    _print_declarations(console, comparison.declarations, every_run)
    for interface in dict.fromkeys(run.interface for run in comparison.runs):
        runs = [run for run in comparison.runs if run.interface == interface]
        labels = "; ".join(run.experiment for run in runs)
        solver = _solver(interface, comparison.tolerances)
        console.print(f"\n[bold]{_TITLES[interface]}[/bold], {solver}: {escape(labels)}")
        if interface == "CoSimulation" and not any(run.judged for run in runs):
            console.print("shown, not judged: the solver and its step are each FMU's own (--cs-limit judges)")
        print_differences(console, runs, every_run=every_run)


def _print_declarations(console: Console, declarations: Declarations, every_variable: bool) -> None:
    groups = [
        ("only in the first", declarations.only_first),
        ("only in the second", declarations.only_second),
    ]
    internal = declarations.internal_only_first, declarations.internal_only_second
    if every_variable:
        groups += zip(("internal, only in the first", "internal, only in the second"), internal, strict=True)
    for title, names in groups:
        if names:
            console.print(f"{title}: {escape(', '.join(names))}")
    if not every_variable and any(internal):
        first, second = map(len, internal)
        console.print(
            f"internal variables of one alone: {first} of the first, {second} of the second (--all)"
        )
    if declarations.differences:
        table = Table("declared otherwise", "", "first", "second", box=None)
        for one in declarations.differences:
            cells = (one.variable, one.attribute, one.first or "none", one.second or "none")
            table.add_row(*map(escape, cells))
        console.print(table)


def _made_by(fmu: FmuDescription) -> str:
    return escape(f"made by {fmu.generation_tool}" if fmu.generation_tool else "")


def _solver(interface: Interface, tolerances: Tolerances) -> str:
    if interface == "ModelExchange":
        return f"CVode at tolerance {tolerances.model_exchange:g}"
    return f"tolerance {tolerances.co_simulation:g}"


def _write_json(
    fmus: Sequence[FmuDescription],
    runs: Sequence[RunComparison],
    request: Request,
    declarations: Declarations | None = None,
) -> None:
    if request.json is not None:
        text = as_json(fmus, runs, request.tolerances, declarations=declarations, versions=versions())
        write_text(request.json, text)
        print_note(f"wrote {request.json}")


def _read_inputs(path: Path) -> pd.DataFrame:
    """A table of inputs over time from a CSV file: its first column is the time, whatever its name."""
    file = read_csv_file(path)
    time, *columns = file.headings
    table = pd.DataFrame({heading.name: file.numbers(heading) for heading in columns})
    return table.set_index(pd.Index(file.numbers(time), name="time"))
