"""Command line: ``python -m fmu_build MODEL... --output DIR`` and ``python -m fmu_build explore``."""

from __future__ import annotations

import signal
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Literal, NoReturn

import typer
from rich.console import Console
from rich.markup import escape

from fmu_build import BuildError, FmiVersion, build_fmu, compiler_names
from fmu_build.explore import command as explore
from fmu_build.packaging.platforms import ALL, PLATFORM_NAMES, select_platforms
from fmu_build.support.plain_help import PlainCommand, ignore_impossible_width
from fmu_build.support.request import SensitivityRequest
from fmu_build.support.standard_output import closed_output_fails, lost_output

_EXAMPLE = """
Example:

    python -m fmu_build PreloadedSprings.Joystick.Joystick --output build/fmi2

`python -m fmu_build explore --help`: a page in which a model runs live.
"""
_FMI_VERSIONS: dict[str, FmiVersion] = {"2": "2.0", "3": "3.0", "2.0": "2.0", "3.0": "3.0"}
#: Exit codes after Ctrl-C and after SIGTERM, as of a program that the signal ended.
_INTERRUPTED = 130
_TERMINATED = 143
ignore_impossible_width()  # which consoles read
_messages = Console(stderr=True, highlight=False, emoji=False, soft_wrap=True)


def _known_compiler(name: str) -> str:
    if name not in compiler_names():
        raise typer.BadParameter(f"{name!r} is not one of {', '.join(compiler_names())}")
    return name


def _known_version(name: str) -> str:
    if name not in _FMI_VERSIONS:
        raise typer.BadParameter(f"{name!r} is not one of {', '.join(_FMI_VERSIONS)}")
    return name


def _known_platforms(names: list[str]) -> list[str]:
    try:
        select_platforms(names or [ALL])
    except BuildError as error:
        raise typer.BadParameter(str(error)) from error
    return names


def _known_sensitivity(text: str | None) -> str | None:
    try:
        if text is not None:
            SensitivityRequest.parse(text)
    except BuildError as error:
        raise typer.BadParameter(str(error)) from error
    return text


def _settings(texts: Iterable[str]) -> dict[str, str]:
    settings = {}
    for text in texts:
        name, separator, value = text.partition("=")
        if not name or not separator:
            raise typer.BadParameter(f"{text!r} is not of the form NAME=VALUE")
        settings[name] = value
    return settings


def main(
    models: Annotated[
        list[str],
        typer.Argument(metavar="MODEL", help="Qualified Modelica class names.", show_default=False),
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="DIR", help="Folder that receives the .fmu files.")
    ],
    compiler: Annotated[
        str,
        typer.Option(
            callback=_known_compiler,
            metavar="NAME",
            help=f"Modelica compiler: {', '.join(compiler_names())}.",
        ),
    ] = "rumoca",
    library: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="PATH",
            help="Modelica file or package folder with the models, or that they use, repeatable; libraries "
            "beside these and in MODELICAPATH are found by name. Default: PreloadedSprings.",
            show_default=False,
        ),
    ] = None,
    platform: Annotated[
        list[str] | None,
        typer.Option(
            callback=lambda names: _known_platforms(names or []),
            metavar="NAME",
            help=f"Platform to build for, repeatable: {', '.join(PLATFORM_NAMES)}, or its name in FMI 2; "
            "default: this machine's. wasm32 adds a WebAssembly module to the others.",
            show_default=False,
        ),
    ] = None,
    fmi_version: Annotated[
        str,
        typer.Option(
            "--fmi",
            "--fmi-version",
            callback=_known_version,
            metavar="2|3",
            help="Version of the FMI standard, 2.0 or 3.0, if the compiler supports it.",
        ),
    ] = "2",
    fmi_type: Annotated[
        Literal["me", "cs", "both"],
        typer.Option(help="Model Exchange, Co-Simulation or both in one FMU."),
    ] = "both",
    option: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=VALUE",
            help="Setting of the chosen compiler, repeatable. For openmodelica: omc=PATH, "
            "port-file=FILE, docker=IMAGE, timeout=SECONDS, cs-solver=cvode|euler.",
            show_default=False,
        ),
    ] = None,
    sensitivity: Annotated[
        str | None,
        typer.Option(
            callback=_known_sensitivity,
            metavar="VARIABLES:PARAMETERS",
            help="Derivatives that the FMU computes along its runs, exact through events, such as "
            "theta,omega:J,damping.C; `all` means every output, or every parameter. With rumoca.",
            show_default=False,
        ),
    ] = None,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Show what the compilers print.")] = False,
) -> None:
    """Build FMUs from Modelica models.

    The paths of the finished FMUs are printed on standard output, everything else on standard error.
    """
    settings = _settings(option or ())
    for model in models:
        try:
            result = build_fmu(
                model,
                output,
                compiler=compiler,
                library=library,
                fmi_version=_FMI_VERSIONS[fmi_version],
                fmi_types=("me", "cs") if fmi_type == "both" else (fmi_type,),
                platforms=platform or (),
                options=settings,
                sensitivity=sensitivity,
                on_stage=_Progress(model),
            )
        except BuildError as error:
            _fail(str(error))
        except Exception as error:  # a fault of this program: still no traceback
            if verbose:
                _messages.print_exception()
            hint = "" if verbose else " (--verbose shows where)"
            _fail(f"{model}: internal error: {type(error).__name__}: {error}{hint}")
        if verbose:
            _messages.print(escape(result.log.rstrip()), style="dim")
        _messages.print(f"{escape(model)}: done in {result.seconds:.1f} s")
        typer.echo(result.path)


class _Progress:
    """Prints each stage of one model's build when it begins."""

    def __init__(self, model: str) -> None:
        self.model = model
        self.start = time.perf_counter()

    def __call__(self, stage: str) -> None:
        seconds = time.perf_counter() - self.start
        _messages.print(f"[dim]{seconds:5.1f} s[/dim]  {escape(self.model)}: {escape(stage)}")


def _fail(message: str) -> NoReturn:
    _print_error(message)
    raise typer.Exit(1)


def _print_error(message: str) -> None:
    _messages.print(f"[bold red]error:[/bold red] {escape(message)}")


app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode="markdown")
app.command(cls=PlainCommand, epilog=_EXAMPLE)(main)


def _run() -> int:
    """Run the command line and return its exit code.

    SIGTERM does what Ctrl-C does, also where that is ignored: temporary folders are deleted, and tools that
    were started are ended.
    """
    terminated = False

    def terminate(*_: object) -> None:
        nonlocal terminated
        terminated = True
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, terminate)
    try:
        with closed_output_fails():
            if sys.argv[1:2] == ["explore"]:
                explore.app(sys.argv[2:], prog_name="python -m fmu_build explore")
            else:
                app(prog_name="python -m fmu_build")
    except SystemExit as end:
        if terminated and end.code == _INTERRUPTED:
            return _TERMINATED
        raise
    except OSError as error:
        if not (lost := lost_output(error)):
            raise
        _print_error(lost)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(_run())
