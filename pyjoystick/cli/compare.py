"""``pyjoystick compare``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Annotated, Final, Literal

import typer
from rich.markup import escape

from pyjoystick import fmu, model, runs, support
from pyjoystick.cli import joystick_choice, options, parsing
from pyjoystick.cli.comparison_tables import print_comparison, print_differences, solver_text
from pyjoystick.cli.console import output, progress_console, write_json
from pyjoystick.cli.fmus import found_or_built, opened
from pyjoystick.cli.plausibility import require_plausible
from pyjoystick.support import check_outputs

EXAMPLES: Final = """
Examples:

    pyjoystick compare
    pyjoystick compare --damping power-law --limit theta=1e-7 --limit E=1e-8
    pyjoystick compare other/Joystick.fmu --interface me -a 15deg --set damping.C=0.06
    pyjoystick compare build/fmi2/Joystick.fmu openmodelica/Joystick.fmu
    pyjoystick compare First.fmu Second.fmu --variable x --inputs driven.csv --json comparison.json
"""

_INTERFACES: Final[Mapping[str, fmu.Interface]] = {"me": "ModelExchange", "cs": "CoSimulation"}


@dataclass(frozen=True, slots=True)
class _Request:
    """Options of both forms of the command; None stands for a default that depends on the FMUs.

    Attributes:
        angles: release angles (rad)
        duration, output_interval: of each run (s)
        interface: interface for running the FMUs
        limits: limits by name of the variable, as they are written
        tolerances: tolerances of the integrators
        json: file for all results
        every_run: show all runs, not only the worst one of each variable
    """

    angles: Sequence[float] | None
    duration: float | None
    output_interval: float | None
    interface: fmu.Interface | None
    limits: Mapping[str, str]
    tolerances: runs.Tolerances
    json: Path | None
    every_run: bool


@dataclass(frozen=True, slots=True)
class _BetweenFmus:
    """Further options of the form for two FMUs.

    Attributes:
        parameters: a parameter file for both
        settings: parameters and inputs of both by name, as they are written; they override the file
        relative_limit: limit of variables without their own; None for the default
        cs_limits: limits in Co-Simulation, as `limits` of the request
        variables: variables to compare; None for the outputs
        inputs: a CSV file
    """

    parameters: Path | None
    settings: Mapping[str, str]
    relative_limit: float | None
    cs_limits: Mapping[str, str]
    variables: Sequence[str] | None
    inputs: Path | None


def run(
    fmus: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="FMU",
            help="One FMU to compare with the reference, or two FMUs. Default: the FMU of --damping.",
        ),
    ] = None,
    release_angle: Annotated[
        list[str] | None,
        typer.Option(
            "--release-angle",
            "-a",
            metavar="ANGLE",
            help="Release angle of joysticks: -20deg or -0.35rad; a bare number is in degrees; repeatable. "
            "Default: -20deg with the reference, several angles with two FMUs.",
        ),
    ] = None,
    duration: Annotated[
        float | None,
        typer.Option(
            "--duration",
            "-d",
            metavar="SECONDS",
            help="Length of a run. Default: 1.5 for joysticks, else the FMU's default experiment.",
        ),
    ] = None,
    damping: options.Law = None,
    parameters: options.Parameters = None,
    assignments: options.Set = None,
    fmu_file: options.FmuFile = None,
    limit: Annotated[
        list[str] | None,
        typer.Option(
            "--limit",
            "-l",
            metavar="NAME=VALUE",
            help="Largest allowed difference of a variable, in its unit or with one; repeatable.",
        ),
    ] = None,
    relative_limit: Annotated[
        float | None,
        typer.Option(
            "--relative-limit",
            metavar="NUMBER",
            help="Two FMUs: largest allowed difference of variables without --limit, relative to their "
            "largest value. Default: 1e-4.",
        ),
    ] = None,
    cs_limit: Annotated[
        list[str] | None,
        typer.Option(
            "--cs-limit",
            metavar="NAME=VALUE",
            help="Two FMUs: apply this limit to a variable in Co-Simulation as well; repeatable.",
        ),
    ] = None,
    interface: Annotated[
        Literal["me", "cs"] | None,
        typer.Option(
            "--interface",
            help="Model Exchange (with CVode) or Co-Simulation. Default: cs with the reference, all common "
            "interfaces with two FMUs.",
        ),
    ] = None,
    variable: Annotated[
        list[str] | None,
        typer.Option(
            "--variable",
            metavar="NAME",
            help="Two FMUs: compare this variable; repeatable. Default: all common outputs.",
        ),
    ] = None,
    inputs: Annotated[
        Path | None,
        typer.Option(
            "--inputs",
            metavar="FILE",
            help="Two FMUs: CSV file of inputs over time; headings: time (s) and names of inputs.",
        ),
    ] = None,
    output_interval: Annotated[
        float | None,
        typer.Option(
            "--output-interval",
            metavar="SECONDS",
            help="Time between compared instants, in Co-Simulation the communication step. Default: 0.001 "
            "for joysticks.",
        ),
    ] = None,
    tolerance: options.Tolerance = support.DEFAULT_TOLERANCE,
    cvode_tolerance: Annotated[
        float,
        typer.Option("--cvode-tolerance", metavar="NUMBER", min=1e-13, max=1e-2, help="Tolerance of CVode."),
    ] = 1e-10,
    json: Annotated[Path | None, options.json("all results")] = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Show every run, and internal variables of only one FMU.")
    ] = False,
) -> None:
    """Compare an FMU with the pure-Python reference, or two FMUs with each other.

    The output shows the largest difference of each variable, when it occurs, and when the limit is first
    exceeded. The exit code is 1 if a limit is exceeded.

    Two FMUs run through the same experiments with both interfaces: joysticks are released at several angles
    and driven by a torque, JoystickInverse follows sines, and any other FMU runs its default experiment.
    Without --cs-limit, Co-Simulation is shown but not judged, because each FMU has its own solver and step.
    """
    names = _names(fmus or [], fmu_file)
    request = _Request(
        angles=None if release_angle is None else [parsing.parse_angle(text) for text in release_angle],
        duration=duration,
        output_interval=output_interval,
        interface=None if interface is None else _INTERFACES[interface],
        limits=parsing.parse_amounts(limit, "--limit"),
        tolerances=runs.Tolerances(tolerance, cvode_tolerance),
        json=json,
        every_run=everything,
    )
    check_outputs(json)
    if len(names) < 2:
        for_two = {
            "--relative-limit": relative_limit,
            "--cs-limit": cs_limit,
            "--variable": variable,
            "--inputs": inputs,
        }
        parsing.refuse_given("is for two FMUs", for_two)
        name = names[0] if names else None
        with opened(damping, name, assignments, parameters) as (one, joystick):
            kept = _with_reference(one.description, joystick, request)
    else:
        parsing.refuse_given("given FMUs have their own damping laws", {"--damping": damping})
        between = _BetweenFmus(
            parameters=parameters,
            settings=parsing.parse_amounts(assignments, "--set"),
            relative_limit=relative_limit,
            cs_limits=parsing.parse_amounts(cs_limit, "--cs-limit"),
            variables=variable,
            inputs=inputs,
        )
        kept = _of_two(names[0], names[1], between, request)
    if not kept:
        raise typer.Exit(1)


def _with_reference(
    description: fmu.FmuDescription, joystick: model.JoystickParameters, request: _Request
) -> bool:
    """Compare an FMU with the reference and print the result; False if a limit is exceeded."""
    interface = request.interface or "CoSimulation"
    angles = request.angles or [parsing.parse_angle(options.DEFAULT_RELEASE_ANGLE)]
    duration = support.DEFAULT_DURATION if request.duration is None else request.duration
    step = support.DEFAULT_OUTPUT_INTERVAL if request.output_interval is None else request.output_interval
    with progress_console().status("") as status:
        found = runs.compare_with_reference(
            description.path,
            joystick,
            angles,
            duration=duration,
            output_interval=step,
            interface=interface,
            limits=parsing.numbers_of(request.limits),
            tolerances=request.tolerances,
            on_run=status.update,
        )
    releases = ", ".join(run.experiment for run in found)
    console = output()
    console.print(
        f"{escape(description.path.name)} against the reference: free oscillation from {releases}, "
        f"{duration:g} s, {solver_text(interface, request.tolerances)}"
    )
    print_differences(console, found, every_run=request.every_run)
    _write_json([description], found, request)
    return all(run.within_limits for run in found)


def _of_two(first: str, second: str, between: _BetweenFmus, request: _Request) -> bool:
    """Compare two FMUs and print the result; False if a limit is exceeded."""
    paths = found_or_built(first), found_or_built(second)
    descriptions = [fmu.read_description(path) for path in paths]
    # Names of the joystick's quantities may mean others in an FMU from elsewhere: its own units decide.
    convert = partial(runs.amount_for, fmus=descriptions)
    settings = parsing.numbers_of(between.settings, convert)
    if "theta_start" in descriptions[0].variables:
        require_plausible(
            {name: one for name, one in settings.items() if runs.has_si_unit(descriptions[0], name)}
        )
    experiments = runs.experiments_for(
        *descriptions,
        release_angles=request.angles,
        duration=request.duration,
        output_interval=request.output_interval,
        settings={**_joystick(between, descriptions), **settings},
        inputs=None if between.inputs is None else fmu.read_inputs(between.inputs, descriptions[0]),
    )
    limits = runs.Limits(
        absolute=parsing.numbers_of(request.limits, convert),
        co_simulation=parsing.numbers_of(between.cs_limits, convert),
    )
    if between.relative_limit is not None:
        limits = replace(limits, relative=between.relative_limit)
    with progress_console().status("") as status:
        comparison = runs.compare_fmus(
            *paths,
            experiments=experiments,
            interfaces=None if request.interface is None else [request.interface],
            variables=between.variables,
            limits=limits,
            tolerances=request.tolerances,
            on_run=status.update,
        )
    print_comparison(output(), comparison, request.every_run)
    _write_json([comparison.first, comparison.second], comparison.runs, request, comparison.declarations)
    return comparison.within_limits


def _joystick(between: _BetweenFmus, descriptions: Sequence[fmu.FmuDescription]) -> Mapping[str, float]:
    """Values of the parameter file, with the damping law of the first FMU."""
    if between.parameters is None:
        return {}
    law, *_ = [runs.law_of_fmu(one) for one in descriptions]  # each must have the units of the file
    joystick = joystick_choice.parameter_file(between.parameters).with_law(law)
    return model.values_for(joystick, descriptions[0].variables)


def _write_json(
    fmus: Sequence[fmu.FmuDescription],
    found: Sequence[runs.RunComparison],
    request: _Request,
    declarations: runs.Declarations | None = None,
) -> None:
    write_json(
        request.json,
        lambda notes: runs.as_json(fmus, found, request.tolerances, declarations=declarations, notes=notes),
    )


def _names(arguments: list[str], option: str | None) -> list[str]:
    """The FMUs given as arguments or by --fmu."""
    if len(arguments) > 2:
        raise typer.BadParameter(f"at most two FMUs can be compared, not {len(arguments)}")
    if option is not None and arguments:
        raise typer.BadParameter("give the FMU as an argument or by --fmu, not both", param_hint="--fmu")
    return arguments if option is None else [option]
