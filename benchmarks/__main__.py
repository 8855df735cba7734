"""Command line: ``python -m benchmarks``."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape

from benchmarks import cluster
from benchmarks.build import UnpackedFmu, compile_programs, unpack
from benchmarks.c_programs import fmu_loop, hand_written
from benchmarks.contender import Contender, as_accurate
from benchmarks.errors import BenchmarkError
from benchmarks.measurement import Row, measure
from benchmarks.python_runs import fmpy_run, reference_run
from benchmarks.report import as_json, as_markdown, machine
from benchmarks.task import LAWS, MODELS, TOLERANCE, Law
from fmu_build import BuildError, build_fmu

_LONG_STEPS = 15
_messages = Console(stderr=True, highlight=False, soft_wrap=True)


def main(
    fmus: Annotated[
        Path, typer.Option(metavar="DIR", help="Folder with the FMUs; those that are missing are built.")
    ] = Path("build/fmi2"),
    rounds: Annotated[int, typer.Option(min=2, help="How often every run is timed.")] = 15,
    json: Annotated[bool, typer.Option("--json", help="Print JSON in place of tables.")] = False,
) -> None:
    """Time the joystick's free oscillation on the FMU against a C program written by hand, and other ways.

    Both damping laws; 1.5 s from -20 degrees with 901 samples. The tables are printed on standard output.
    """
    try:
        with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
            results = _measure_all(fmus, Path(folder), rounds)
        on_cluster = "" if json else _on_cluster(fmus)
    except (BenchmarkError, BuildError) as error:
        _messages.print(f"[bold red]error:[/bold red] {escape(str(error))}")
        raise typer.Exit(1) from None
    if json:
        typer.echo(as_json(results))
    else:
        typer.echo(f"{machine()}\n\n{as_markdown(results)}\n{on_cluster}", nl=False)


def _on_cluster(fmus: Path) -> str:
    _messages.print("timing a Dask cluster")
    return cluster.as_markdown(fmus)


def _measure_all(fmus: Path, folder: Path, rounds: int) -> dict[Law, list[Row]]:
    _messages.print("compiling the programs")
    programs = compile_programs(folder)
    results = {}
    for law in LAWS:
        path = fmus / f"{MODELS[law]}.fmu"
        if not path.exists():
            _messages.print(f"building {escape(str(path))}")
            build_fmu(f"PreloadedSprings.Joystick.{MODELS[law]}", fmus)
        _messages.print(f"{law}: looking for tolerances of equal accuracy")
        contenders = _contenders(law, unpack(path, folder), programs, folder)
        with _messages.status(f"{law}: timing") as status:
            done = 0

            def show_round(law: Law = law) -> None:
                nonlocal done
                done += 1
                status.update(f"{law}: round {done} of {rounds}")

            results[law] = measure(contenders, rounds, show_round)
    return results


def _contenders(law: Law, fmu: UnpackedFmu, programs: dict[str, Path], folder: Path) -> list[Contender]:
    """The yardstick, the FMU in C, then the others.

    The yardstick and CVode get the tolerance at which they are as accurate as the FMU.
    """
    loop = fmu_loop(programs["fmu_loop"], fmu, law, TOLERANCE, folder)
    target = loop.error()
    by_hand = as_accurate(
        lambda tolerance: hand_written(programs["joystick"], law, tolerance, folder), target, 1e-7, 1.25
    )
    cvode = as_accurate(lambda tolerance: fmpy_run(fmu, law, "ModelExchange", tolerance), target, 1e-9, 2.0)
    return [
        by_hand,
        loop,
        fmu_loop(programs["fmu_loop"], fmu, law, TOLERANCE, folder, steps=_LONG_STEPS),
        fmpy_run(fmu, law, "CoSimulation", TOLERANCE),
        cvode,
        reference_run(law),
    ]


if __name__ == "__main__":
    typer.run(main)
