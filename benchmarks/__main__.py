"""Command line: ``python -m benchmarks``."""

from __future__ import annotations

import itertools
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape

from benchmarks import cluster
from benchmarks.batches import BatchRow, measure_batches
from benchmarks.build import UnpackedFmu, compile_programs, unpack
from benchmarks.c_programs import fmu_loop, hand_written
from benchmarks.contender import Contender, as_accurate
from benchmarks.errors import BenchmarkError
from benchmarks.measurement import Row, measure
from benchmarks.python_runs import compiled_run, fmpy_run, reference_run, scipy_run
from benchmarks.report import as_json, as_markdown, machine
from benchmarks.task import LAWS, MODELS, TOLERANCE, Law
from fmu_build import BuildError, build_fmu
from pyjoystick.fmu import Fmu

_LONG_STEPS = 15
_messages = Console(stderr=True, highlight=False, soft_wrap=True)


def main(
    fmus: Annotated[
        Path, typer.Option(metavar="DIR", help="Folder with the FMUs; those that are missing are built.")
    ] = Path("build/fmi2"),
    rounds: Annotated[int, typer.Option(min=2, help="How often every run is timed.")] = 15,
    json: Annotated[bool, typer.Option("--json", help="Print JSON in place of tables.")] = False,
) -> None:
    """Time the joystick's free oscillation in the FMU, a hand-written C program and other methods.

    Both damping laws; 1.5 s from -20 degrees with 901 samples. Then batches of such runs on one and two
    threads, and on a Dask cluster. The tables are printed on standard output.
    """
    try:
        with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
            results = _measure_all(fmus, Path(folder), rounds)
            batches = _measure_batches(fmus, rounds)
        on_cluster = "" if json else _on_cluster(fmus)
    except (BenchmarkError, BuildError) as error:
        _messages.print(f"[bold red]error:[/bold red] {escape(str(error))}")
        raise typer.Exit(1) from None
    if json:
        typer.echo(as_json(results, batches))
    else:
        typer.echo(f"{machine()}\n\n{as_markdown(results, batches)}\n{on_cluster}", nl=False)


def _on_cluster(fmus: Path) -> str:
    _messages.print("timing a Dask cluster")
    return cluster.as_markdown(fmus)


def _measure_all(fmus: Path, folder: Path, rounds: int) -> dict[Law, list[Row]]:
    _messages.print("compiling the programs")
    programs = compile_programs(folder)
    results = {}
    for law in LAWS:
        path = _found_or_built(fmus, MODELS[law])
        _messages.print(f"{law}: looking for tolerances of equal accuracy")
        with Fmu(path) as fmu:
            contenders = _contenders(law, unpack(path, folder), fmu, programs, folder)
            with _rounds(law, rounds) as show_round:
                results[law] = measure(contenders, rounds, show_round)
    return results


def _measure_batches(fmus: Path, rounds: int) -> list[BatchRow]:
    with _rounds("batches", rounds) as show_round:
        return measure_batches(_found_or_built(fmus, MODELS["constant"]), rounds, show_round)


def _found_or_built(fmus: Path, model: str) -> Path:
    path = fmus / f"{model}.fmu"
    if not path.exists():
        _messages.print(f"building {escape(str(path))}")
        build_fmu(f"PreloadedSprings.Joystick.{model}", fmus)
    return path


@contextmanager
def _rounds(what: str, rounds: int) -> Iterator[Callable[[], None]]:
    """Show the progress of the timing; yields a function to call after every round."""
    with _messages.status(f"{what}: timing") as status:
        done = itertools.count(1)
        yield lambda: status.update(f"{what}: round {next(done)} of {rounds}")


def _contenders(
    law: Law, unpacked: UnpackedFmu, fmu: Fmu, programs: dict[str, Path], folder: Path
) -> list[Contender]:
    """Return the yardstick, the FMU in C, the FMU in the compiled loop from Python, then the others.

    The tolerances of the yardstick, CVode and SciPy are chosen to make them as accurate as the FMU.
    """
    loop = fmu_loop(programs["fmu_loop"], unpacked, law, TOLERANCE, folder)
    target = loop.error()
    by_hand = as_accurate(
        lambda tolerance: hand_written(programs["joystick"], law, tolerance, folder), target, 1e-7, 1.25
    )
    cvode = as_accurate(
        lambda tolerance: fmpy_run(unpacked, law, "ModelExchange", tolerance), target, 1e-9, 2.0
    )
    return [
        by_hand,
        loop,
        compiled_run(fmu, law, TOLERANCE),
        fmu_loop(programs["fmu_loop"], unpacked, law, TOLERANCE, folder, steps=_LONG_STEPS),
        fmpy_run(unpacked, law, "CoSimulation", TOLERANCE),
        cvode,
        as_accurate(lambda tolerance: scipy_run(law, tolerance), target, 1e-8, 2.0),
        reference_run(law),
    ]


if __name__ == "__main__":
    typer.run(main)
