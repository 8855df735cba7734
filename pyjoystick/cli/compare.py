"""``pyjoystick compare``."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated, Final

import typer

from pyjoystick.cli import options
from pyjoystick.support import DEFAULT_TOLERANCE

EXAMPLES = """
Examples:

    pyjoystick compare
    pyjoystick compare --damping power-law --limit theta=1e-7 --limit E=1e-8
    pyjoystick compare other/Joystick.fmu --interface me -a 15deg --set damping.C=0.06
    pyjoystick compare build/fmi2/Joystick.fmu openmodelica/Joystick.fmu
    pyjoystick compare First.fmu Second.fmu --variable x --inputs driven.csv --json comparison.json
"""

_TWO_ONLY: Final = "is for two FMUs"


class InterfaceName(StrEnum):
    """The interfaces of FMI by short names."""

    ME = "me"
    CS = "cs"


def run(
    fmus: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[FMU [OTHER]]",
            help="One FMU, to compare with the reference, or two. The FMU of --damping if none is given.",
            show_default=False,
        ),
    ] = None,
    release_angle: Annotated[
        list[str] | None,
        typer.Option(
            "--release-angle",
            "-a",
            metavar="ANGLE",
            help="Angle at which joysticks are let go: -20deg or -0.35rad; a bare number is in degrees; "
            "repeatable. -20deg against the reference, and several with two FMUs.",
            show_default=False,
        ),
    ] = None,
    duration: Annotated[
        float | None,
        typer.Option(
            "--duration",
            "-d",
            metavar="SECONDS",
            help="Length of a run: 1.5 for joysticks, what the FMU proposes for others.",
            show_default=False,
        ),
    ] = None,
    damping: options.Law = None,
    parameters: options.Parameters = None,
    assignments: options.Set = None,
    fmu: options.FmuFile = None,
    limit: Annotated[
        list[str] | None,
        typer.Option(
            "--limit",
            "-l",
            metavar="NAME=VALUE",
            help="Largest difference allowed in a variable, in SI units, in place of the preset one; "
            "repeatable.",
            show_default=False,
        ),
    ] = None,
    relative_limit: Annotated[
        float | None,
        typer.Option(
            "--relative-limit",
            metavar="NUMBER",
            help="Two FMUs: largest difference of the variables without --limit in parts of their largest "
            "value, 1e-4 if not given.",
            show_default=False,
        ),
    ] = None,
    cs_limit: Annotated[
        list[str] | None,
        typer.Option(
            "--cs-limit",
            metavar="NAME=VALUE",
            help="Two FMUs: judge a variable in Co-Simulation too, by this limit; repeatable.",
            show_default=False,
        ),
    ] = None,
    interface: Annotated[
        InterfaceName | None,
        typer.Option(
            "--interface",
            help="Model Exchange, run by CVode, or Co-Simulation. If not given: cs against the reference, "
            "with two FMUs all that both have.",
            show_default=False,
        ),
    ] = None,
    variable: Annotated[
        list[str] | None,
        typer.Option(
            "--variable",
            metavar="NAME",
            help="Two FMUs: compare this variable; repeatable. All outputs that both have if not given.",
            show_default=False,
        ),
    ] = None,
    inputs: Annotated[
        Path | None,
        typer.Option(
            "--inputs",
            metavar="FILE",
            help="Two FMUs: inputs over time, CSV with a heading: time (s), names of inputs.",
            show_default=False,
        ),
    ] = None,
    output_interval: Annotated[
        float | None,
        typer.Option(
            "--output-interval",
            metavar="SECONDS",
            help="Time between two instants that are compared, in Co-Simulation the communication step: "
            "0.001 for joysticks.",
            show_default=False,
        ),
    ] = None,
    tolerance: options.Tolerance = DEFAULT_TOLERANCE,
    cvode_tolerance: Annotated[
        float, typer.Option("--cvode-tolerance", metavar="NUMBER", min=1e-13, max=1e-2, help="That of CVode.")
    ] = 1e-10,
    json: Annotated[
        Path | None,
        typer.Option("--json", metavar="FILE", help="Write everything as JSON.", show_default=False),
    ] = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Show every run, and internal variables that one FMU lacks.")
    ] = False,
) -> None:
    """Compare an FMU with the pure-Python reference, or two FMUs with each other.

    Says for every variable how far the two lie apart at most, when, and when they first pass the limit; the
    exit code is 1 where a limit is exceeded.

    Two FMUs are run through the same experiments by both interfaces: joysticks are let go at several angles
    and driven by a torque, JoystickInverse is led through sines, any other FMU is run as it proposes.
    Co-Simulation is shown without being judged, because its solver and step are each FMU's own, unless there
    is a --cs-limit.
    """
    # What compares is loaded when it is wanted, so that the other commands start quickly.
    from pyjoystick.cli import comparisons
    from pyjoystick.runs import Tolerances

    names = _names(fmus or [], fmu)
    angles = None if release_angle is None else [options.parse_angle(text) for text in release_angle]
    request = comparisons.Request(
        angles=angles,
        duration=duration,
        output_interval=output_interval,
        interface=None if interface is None else comparisons.INTERFACES[interface.value],
        limits=options.parse_assignments(limit or [], "--limit"),
        tolerances=Tolerances(tolerance, cvode_tolerance),
        json=json,
        every_run=everything,
    )
    if len(names) < 2:
        for option, value in (
            ("--relative-limit", relative_limit),
            ("--cs-limit", cs_limit),
            ("--variable", variable),
            ("--inputs", inputs),
        ):
            if value is not None:
                raise typer.BadParameter(_TWO_ONLY, param_hint=option)
        kept = comparisons.with_reference(
            names[0] if names else None, damping, parameters, assignments, request
        )
    else:
        if damping is not None:
            raise typer.BadParameter("the damping laws of given FMUs are their own", param_hint="--damping")
        between = comparisons.BetweenFmus(
            parameters=parameters,
            settings=options.parse_assignments(assignments or [], "--set"),
            relative_limit=relative_limit,
            cs_limits=options.parse_assignments(cs_limit or [], "--cs-limit"),
            variables=variable,
            inputs=inputs,
        )
        kept = comparisons.of_two(names[0], names[1], between, request)
    if not kept:
        raise typer.Exit(1)


def _names(arguments: list[str], option: str | None) -> list[str]:
    """The FMUs that are given, by arguments or by --fmu."""
    if len(arguments) > 2:
        raise typer.BadParameter(f"at most two FMUs can be compared, not {len(arguments)}")
    if option is not None and arguments:
        raise typer.BadParameter("give the FMU as an argument or by --fmu, not both", param_hint="--fmu")
    return arguments if option is None else [option]
