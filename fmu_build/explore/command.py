"""The command ``python -m fmu_build explore``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.console import Console
from rich.markup import escape

from fmu_build.compilers import build
from fmu_build.explore.page import explore_page
from fmu_build.explore.settings import Settings, read_settings
from fmu_build.packaging.archive import replacing
from fmu_build.support.errors import BuildError
from fmu_build.support.plain_help import PlainCommand
from fmu_build.support.request import BuildRequest
from fmu_build.support.temporary import temporary_folder

_EXAMPLE = """
Examples:

    python -m fmu_build explore PreloadedSprings.Joystick.Joystick -o joystick.html

    python -m fmu_build explore Ball.fmu --settings ball.toml -o ball.html
"""
_messages = Console(stderr=True, highlight=False, emoji=False, soft_wrap=True)


def _main(
    model: Annotated[
        str, typer.Argument(metavar="FMU_OR_MODEL", help="An .fmu file, or a qualified Modelica class name.")
    ],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="HTML file to write.")],
    settings: Annotated[
        Path | None,
        typer.Option(metavar="FILE.toml", help="What the page shows: the [explore] table of this file."),
    ] = None,
    library: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="PATH",
            help="Modelica file or package folder with the model, or that it uses, repeatable; "
            "default: PreloadedSprings.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Write a page in which a model runs live: sliders for its parameters, plots, tables, presets.

    The page is one HTML file. It needs no network and no server, only a browser. The model in it is the C
    code of the FMU, compiled to WebAssembly.
    """
    if output.suffix not in (".html", ".htm"):
        _fail(f"cannot write {output}: the name must end in .html")
    try:
        chosen = read_settings(settings) if settings else Settings()
        with temporary_folder() as folder:
            fmu = Path(model) if model.endswith(".fmu") else _built(model, folder, library or ())
            page = explore_page(fmu, chosen)
        with replacing(output, page.encode()):
            pass
    except BuildError as error:
        _fail(str(error))
    typer.echo(output)


def _built(model: str, folder: Path, libraries: Sequence[Path]) -> Path:
    request = BuildRequest(
        model,
        folder,
        further=libraries,
        fmi_types=("cs",),
        platforms=("wasm32",),
        on_stage=lambda stage: _messages.print(escape(stage)),
    )
    return build("rumoca", request).path


def _fail(message: str) -> NoReturn:
    _messages.print(f"[bold red]error:[/bold red] {escape(message)}")
    raise typer.Exit(1)


app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode="markdown")
app.command(cls=PlainCommand, epilog=_EXAMPLE)(_main)
