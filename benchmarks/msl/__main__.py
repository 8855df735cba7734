"""Command line: ``python -m benchmarks.msl``."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape

from benchmarks.msl.example import Outcome

_PARTS = (
    "Mechanics.Rotational",
    "Mechanics.Translational",
    "Blocks",
    "Electrical.Analog",
    "Thermal.HeatTransfer",
)
_PLACE = re.compile(r"^\S*\.mo(?::\d+:\d+)?: | \(model [^()]*\)")
_messages = Console(stderr=True, highlight=False, soft_wrap=True)


def main(
    library: Annotated[
        Path,
        typer.Option(metavar="DIR", exists=True, help="Folder Modelica of the library."),
    ],
    reference: Annotated[
        Path,
        typer.Option(
            metavar="DIR", exists=True, help="Folder Modelica of its reference results, of the same version."
        ),
    ],
    only: Annotated[str, typer.Option(metavar="PATTERN", help="Part of the names of examples.")] = "",
    seconds: Annotated[float, typer.Option(min=1, help="Longest time for one example.")] = 120.0,
) -> None:
    """Build examples of the Modelica Standard Library, run them and compare them with reference results.

    The examples of Mechanics.Rotational, Mechanics.Translational, Blocks, Electrical.Analog and
    Thermal.HeatTransfer that have a reference result. Each is right if every comparison signal stays
    within 1e-4 of its range, and near within 1e-3. A Markdown table is printed on standard output.
    """
    outcomes: dict[str, Outcome] = {}
    for name, folder in _examples(reference):
        if only in name:
            _messages.print(escape(name), end=" ")
            outcomes[name] = _in_a_process(f"Modelica.{name}", library.resolve(), folder, seconds)
            _messages.print(escape(f"{outcomes[name].verdict}: {outcomes[name].detail}"))
    typer.echo(_table(outcomes).replace(f"{library.resolve().parent}/", ""), nl=False)


def _examples(reference: Path) -> Iterator[tuple[str, Path]]:
    """Yield the names of the examples, without ``Modelica.``, and the folders of their reference results."""
    for part in _PARTS:
        for listing in sorted((reference / part.replace(".", "/")).rglob("comparisonSignals.txt")):
            folder = listing.parent
            if (folder / f"{folder.name}.csv").is_file():
                yield ".".join(folder.relative_to(reference).parts), folder


def _in_a_process(model: str, library: Path, folder: Path, seconds: float) -> Outcome:
    command = [sys.executable, "-m", "benchmarks.msl.example", model, str(library), str(folder)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return Outcome("too long", f"more than {seconds:g} s")
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        return Outcome("crash", f"exit code {done.returncode}: {last}")
    return Outcome(**json.loads(done.stdout.splitlines()[-1]))


def _table(outcomes: dict[str, Outcome]) -> str:
    counts = Counter(outcome.verdict for outcome in outcomes.values())
    lines = [", ".join(f"{number} {verdict}" for verdict, number in counts.most_common()), ""]
    lines += ["| example | result | largest error and its signal, or the reason |", "|---|---|---|"]
    lines += [f"| {name} | {outcome.verdict} | {_cell(outcome)} |" for name, outcome in outcomes.items()]
    return "\n".join(lines) + "\n"


def _cell(outcome: Outcome) -> str:
    """Return the error, or the reason without file positions, which are specific to a machine."""
    first = outcome.detail.splitlines()[0] if outcome.detail else ""
    return _PLACE.sub("", first).replace("|", r"\|")


app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
app.command()(main)

if __name__ == "__main__":
    app(prog_name="python -m benchmarks.msl")
