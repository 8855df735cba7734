"""Response times: processor time of whole commands, what they import, and the compiled loop.

    python -m benchmarks.latency

Each command runs in a separate process, alternating with one that only imports FMPy and pandas and draws
three plots with Matplotlib: what these packages alone need. Imports are measured by ``python -X importtime``,
each module without its own imports. The compiled loop is compared with a one-line function compiled by Numba.
"""

from __future__ import annotations

import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Final

import typer

from benchmarks.report import machine
from pyjoystick.support import TextTable

COMMANDS: Final = {
    "--help": ["--help"],
    "fit --help": ["fit", "--help"],
    "info Joystick": ["info", "Joystick"],
    "free-oscillation": ["free-oscillation"],
    "free-oscillation --plot": ["free-oscillation", "--plot", "run.png"],
}
#: A table and a figure without this project.
_PACKAGES_ALONE: Final = """
import fmpy, numpy, pandas
from matplotlib.figure import Figure
figure = Figure(layout="constrained")
times = numpy.linspace(0.0, 1.5, 1501)
for axes in figure.subplots(3, sharex=True):
    axes.plot(times, numpy.sin(20.0 * times))
figure.savefig("packages.png", dpi=200)
"""
_PACKAGES_SHOWN: Final = 4
_LINE: Final = re.compile(r"import time:\s+(?P<own>\d+) \|\s+\d+ \| +(?P<module>\S+)")
#: Prints the CPU seconds of a batch, including those of loading or compiling the loop.
_LOOP: Final = """
import time
from benchmarks.batches import REDUCTIONS, prepared, random_joysticks
from pyjoystick.fmu import Fmu, find_fmu
with Fmu(find_fmu("Joystick")) as fmu:
    plan = prepared(fmu)
    table = random_joysticks(200)
    begun = time.process_time()
    plan.run_batch(table, threads=1, reductions=REDUCTIONS)
    print(time.process_time() - begun)
"""

#: Prints the CPU seconds of importing Numba and calling a compiled function, which is then on disk.
_NUMBA_ALONE: Final = """
import time
import numpy, pandas
begun = time.process_time()
from numba import njit
@njit("f8(f8)", cache=True)
def increased(number):
    return number + 1.0
increased(1.0)
print(time.process_time() - begun)
"""


def main(rounds: Annotated[int, typer.Option(min=1, help="How often each command is run.")] = 9) -> None:
    """Time the commands and the compiled loop; print Markdown."""
    with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
        typer.echo(f"{machine()}\n\n{commands_table(Path(folder), rounds)}\n\n{loop_table(Path(folder))}")


def commands_table(folder: Path, rounds: int) -> str:
    """A row for each command, from `rounds` rounds in an empty folder."""
    ways = {name: _program(words) for name, words in COMMANDS.items()}
    alone = "packages alone"
    times = _in_turns({alone: ["-c", _PACKAGES_ALONE], **ways}, folder, rounds)
    rows = []
    for name in ways:
        ratio = statistics.median(a / b for a, b in zip(times[name], times[alone], strict=True))
        packages = imported(ways[name], folder).most_common(_PACKAGES_SHOWN)
        most = ", ".join(f"{package} {microseconds / 1e3:.0f}" for package, microseconds in packages)
        rows.append([f"`{name}`", f"{statistics.median(times[name]):.2f}", f"{ratio:.2f}", most])
    rows.append([alone, f"{statistics.median(times[alone]):.2f}", "1", ""])
    header = ["command", "CPU (s)", f"times {alone}", "most of the imports (ms)"]
    return TextTable(header, rows).markdown()


def loop_table(folder: Path) -> str:
    """200 runs by the plain loop, and by the compiled one in a first and in a second process; Numba alone."""
    compiled = {"NUMBA_CACHE_DIR": str(folder / "numba")}
    ways: dict[str, dict[str, str]] = {
        "plain loop": {"PYJOYSTICK_PLAIN_LOOP": "1"},
        "compiled, first process": compiled,
        "compiled, second process": compiled,
    }
    rows = [[name, f"{float(_output(['-c', _LOOP], variables)):.2f}"] for name, variables in ways.items()]
    # Numba keeps on disk only what comes from a file.
    script = folder / "numba_alone.py"
    script.write_text(_NUMBA_ALONE)
    _output([str(script)], compiled)
    rows.append(["Numba alone, second process", f"{float(_output([str(script)], compiled)):.2f}"])
    return TextTable(["200 runs", "CPU (s)"], rows).markdown()


def imported(program: Sequence[str], folder: Path) -> Counter[str]:
    """Return the load time (microseconds) of each package's modules, excluding what they import."""
    done = subprocess.run(
        [sys.executable, "-X", "importtime", *program],
        cwd=folder,
        check=True,
        capture_output=True,
        text=True,
        env=_environment(),
    )
    packages: Counter[str] = Counter()
    for match in _LINE.finditer(done.stderr):
        packages[match["module"].split(".")[0]] += int(match["own"])
    return packages


def _program(words: Sequence[str]) -> list[str]:
    return ["-m", "pyjoystick", *words]


def _in_turns(ways: Mapping[str, Sequence[str]], folder: Path, rounds: int) -> dict[str, list[float]]:
    """Return the CPU seconds of each program per round, after a warm-up round."""
    times: dict[str, list[float]] = {name: [] for name in ways}
    for count in range(rounds + 1):
        for name, program in ways.items():
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run(
                [sys.executable, *program], cwd=folder, check=True, capture_output=True, env=_environment()
            )
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            if count:
                times[name].append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return times


def _output(program: Sequence[str], variables: Mapping[str, str]) -> str:
    command = [sys.executable, *program]
    env = {**_environment(), **variables}
    return subprocess.run(command, check=True, capture_output=True, text=True, env=env).stdout


def _environment() -> dict[str, str]:
    """Return the environment, but with bytecode, which installed programs have."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


if __name__ == "__main__":
    typer.run(main)
