"""The command line: ``pyjoystick`` or ``python -m pyjoystick``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Final

import typer
from typer.core import TyperGroup

from pyjoystick.cli import (
    budget,
    compare,
    fit,
    free_oscillation,
    imports,
    info,
    parameters,
    peaks,
    report,
    ssp,
    sweep,
    torque,
)
from pyjoystick.cli.console import print_error, print_traceback
from pyjoystick.support import PyJoystickError, version_of

__all__ = ["app", "main"]

#: The commands as one comes to need them: the joystick, what was measured, what is simulated, what is judged.
_ORDER: Final = (
    "info",
    "parameters",
    "import",
    "peaks",
    "fit",
    "budget",
    "free-oscillation",
    "torque",
    "sweep",
    "compare",
    "ssp",
    "report",
)


class _InOrder(TyperGroup):
    """The commands in the order above, any others after them."""

    def list_commands(self, ctx: object) -> list[str]:
        return sorted(self.commands, key=lambda name: (*_ORDER, name).index(name))


app = typer.Typer(
    cls=_InOrder,
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    help="Simulate joysticks with opposing restrained preloaded springs by their FMUs.",
    epilog="`pyjoystick COMMAND --help` shows the options of a command, with examples.",
)
app.command("free-oscillation", epilog=free_oscillation.EXAMPLES)(free_oscillation.run)
app.command("budget", epilog=budget.EXAMPLES)(budget.run)
app.command("compare", epilog=compare.EXAMPLES)(compare.run)
app.command("info", epilog=info.EXAMPLES)(info.run)
app.command("fit", epilog=fit.EXAMPLES)(fit.run)
app.add_typer(imports.app, name="import")
app.command("parameters", epilog=parameters.EXAMPLES)(parameters.run)
app.command("peaks", epilog=peaks.EXAMPLES)(peaks.run)
app.command("report", epilog=report.EXAMPLES)(report.run)
app.command("ssp", epilog=ssp.EXAMPLES)(ssp.run)
app.command("sweep", epilog=sweep.EXAMPLES)(sweep.run)
app.command("torque", epilog=torque.EXAMPLES)(torque.run)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 0 done, 1 failed or a limit exceeded, 2 wrong usage.

    Args:
        arguments: without the name of the program; those of this process where not given
    """
    _state.debug = False
    try:
        app(args=None if arguments is None else list(arguments), prog_name="pyjoystick")
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    except PyJoystickError as error:
        return _failed(str(error))
    except Exception as error:  # a fault of this program must not end in a traceback
        hint = "" if _state.debug else " (pyjoystick --debug COMMAND shows where)"
        return _failed(f"internal error: {type(error).__name__}: {error}{hint}")
    return 0


def _failed(message: str) -> int:
    print_error(message)
    if _state.debug:
        print_traceback()
    return 1


class _State:
    """What the options before the command say."""

    debug = False


_state = _State()


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"pyjoystick {version_of('pyjoystick')}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Show the version.")
    ] = False,
    debug: Annotated[bool, typer.Option("--debug", help="Show where an error comes from.")] = False,
) -> None:
    _state.debug = debug
