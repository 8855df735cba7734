"""The command line: ``pyjoystick`` or ``python -m pyjoystick``.

Each command is a module of the same name with the function `run` and the text `EXAMPLES`. It is imported only
when the command is invoked or its help requested, which keeps the list of commands fast. Commands import
rooms rather than names (``from pyjoystick import runs``, then ``runs.free_oscillation``): a room loads a name
on first use, so that the help of a command needs no numerical packages.
"""

from __future__ import annotations

import errno
from collections.abc import Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any, Final

import typer
from typer.core import TyperCommand

from fmu_build.support.plain_help import PlainCommand, PlainGroup, ignore_impossible_width
from fmu_build.support.standard_output import closed_output_fails, lost_output
from pyjoystick import support
from pyjoystick.cli.console import compilation_announced, print_error, print_traceback, warnings_printed
from pyjoystick.cli.invocation import invocation
from pyjoystick.support import PyJoystickError

__all__ = ["app", "main"]

#: The commands in the order of the work: project, measurements, simulation, output.
_COMMANDS: Final = {
    "new": "Start a project: a folder for a laboratory's files.",
    "run": "Build the joystick of a project from its files.",
    "info": "Show the interfaces, platforms and variables of an FMU.",
    "parameters": "Check, change and print a parameter file.",
    "check": "List everything wrong in TOML files.",
    "import": "Make records and parameters from laboratory files.",
    "peaks": "Estimate the damping from the peaks of free oscillations.",
    "fit": "Fit parameters to measured motion, with uncertainties.",
    "design": "Find the measurements that determine parameters best.",
    "budget": "Show how much each measured quantity adds to the errors.",
    "free-oscillation": "Release the joystick from rest and print its peaks.",
    "torque": "Compute the torque that a motion requires (eq. 13).",
    "response": "Find the response to a sinusoidal torque.",
    "vibration": "Find how far the handle moves when its base shakes.",
    "sweep": "Run an FMU for many values of its parameters.",
    "compare": "Compare an FMU with the reference or another FMU.",
    "fmu": "Copy FMUs of this package for other tools.",
    "export": "Write a joystick as FMUs of its own.",
    "ssp": "Write a system of coupled FMUs as one SSP file.",
    "explore": "Write a web page in which the joystick runs live.",
    "report": "Write a report on a joystick as one HTML file.",
}
_IMPORTS: Final = {
    "record": "Make a record from a table of time and angle.",
    "markers": "Make a record of the angle from motion capture.",
    "accelerometer": "Compare an accelerometer with the differentiated angle.",
    "load-curve": "Fit the springs of one side to a load-deflection curve.",
    "swing": "Find the moment of inertia from the period as a pendulum.",
    "parts": "Compute mass, center of mass and inertia from parts.",
}


class _InOrder(PlainGroup):
    """Lists the commands in the order above; Typer would list groups last."""

    def list_commands(self, ctx: object) -> list[str]:
        return list(_COMMANDS)


class _Command(PlainCommand):
    """A command whose options do not accept the name of another option as a value."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Reject ``--base B1 -o x``, which Click reads as the values B1 and -o, and a missing --output."""
        taken = {
            name: one.nargs for one in self.params if not getattr(one, "is_flag", True) for name in one.opts
        }
        known = {name for one in self.params for name in (*one.opts, *one.secondary_opts)}
        words = args[: args.index("--")] if "--" in args else args
        for i, name in enumerate(words):
            if swallowed := known.intersection(words[i + 1 : i + 1 + taken.get(name, 0)]):
                count = "a value" if taken[name] == 1 else f"{taken[name]} values"
                raise typer.BadParameter(f"needs {count} before {min(swallowed)}", param_hint=name)
        return super().parse_args(ctx, args)


class LazyCommand(TyperCommand):
    """A command in the list of a group; its module is loaded on demand."""

    prefix = ""

    def load(self) -> Any:
        """Load the command."""
        assert self.name is not None
        module = import_module(f"pyjoystick.cli.{self.prefix}{self.name.replace('-', '_')}")
        program = _program()
        program.command(self.name, cls=_Command, epilog=module.EXAMPLES)(module.run)
        return typer.main.get_command(program)

    def make_context(self, info_name: str | None, args: list[str], parent: Any = None, **extra: Any) -> Any:
        """Context of the loaded command, with its arguments parsed."""
        return self.load().make_context(info_name, args, parent, **extra)


class LazyImport(LazyCommand):
    """A command of ``pyjoystick import``."""

    prefix = "import_"


def _program(*, completion: bool = False, **settings: Any) -> typer.Typer:
    return typer.Typer(
        add_completion=completion,
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode="markdown",
        **settings,
    )


def _list(program: typer.Typer, commands: Mapping[str, str], kind: type[LazyCommand]) -> None:
    for name, summary in commands.items():
        if name != "import":
            program.command(name, cls=kind, help=summary)(lambda: None)


app = _program(
    cls=_InOrder,
    completion=True,
    help="Simulate, fit and compare joysticks with opposing restrained preloaded springs, using FMUs.",
    epilog="`pyjoystick COMMAND --help` shows the options of a command, with examples.",
)
_list(app, _COMMANDS, LazyCommand)
_imports = _program(cls=PlainGroup)
_list(_imports, _IMPORTS, LazyImport)
app.add_typer(_imports, name="import", help=_COMMANDS["import"])


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 0 done, 1 failed or a limit exceeded, 2 wrong usage.

    Args:
        arguments: without the program name; by default those of this process
    """
    invocation.begin()
    ignore_impossible_width()
    try:
        Path.cwd()
    except OSError as error:
        return _failed(f"the current folder cannot be used: {error.strerror}")
    try:
        with closed_output_fails():
            app(args=None if arguments is None else list(arguments), prog_name="pyjoystick")
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    except PyJoystickError as error:
        return _failed(str(error))
    except Exception as error:  # a bug must not end in a traceback
        if isinstance(error, OSError) and (reason := lost_output(error) or _too_long(error)):
            return _failed(reason)
        hint = "" if invocation.debug else " (pyjoystick --debug COMMAND shows where)"
        return _failed(f"internal error: {type(error).__name__}: {error}{hint}")
    return 0


def _too_long(error: OSError) -> str:
    """Message for a path that no file can have, which any look at it raises; else empty."""
    is_too_long = error.errno == errno.ENAMETOOLONG and error.filename is not None
    return f"cannot use the path {error.filename}: {error.strerror}" if is_too_long else ""


def _failed(message: str) -> int:
    print_error(message)
    if invocation.debug:
        print_traceback()
    return 1


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"pyjoystick {support.version_of('pyjoystick')}")
        raise typer.Exit


@app.callback()
def _options(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Show the version.")
    ] = False,
    debug: Annotated[bool, typer.Option("--debug", help="Show a traceback when an error occurs.")] = False,
    implausible: Annotated[
        bool,
        typer.Option("--implausible", help="Accept implausible parameter values."),
    ] = False,
    quiet: Annotated[
        bool,
        typer.Option("--quiet", "-q", help="Show only results, warnings and errors: no progress, no notes."),
    ] = False,
    verbose: Annotated[
        int,
        typer.Option(
            "--verbose",
            "-v",
            count=True,
            show_default=False,
            help="Log the files and values used, and how, to standard error; -vv logs all runs.",
        ),
    ] = 0,
) -> None:
    if quiet and verbose:
        raise typer.BadParameter("use --quiet or --verbose, not both")
    invocation.debug, invocation.implausible, invocation.quiet = debug, implausible, quiet
    context.with_resource(warnings_printed())
    if verbose:
        from pyjoystick.cli.logs import log_shown  # load it for --verbose only

        invocation.verbose = True
        context.with_resource(log_shown(everything=verbose > 1))
    else:
        context.with_resource(compilation_announced())
    support.remove_abandoned()
