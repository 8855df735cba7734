"""The programs under test: the commands, and readers that no command reaches."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick import Fmu, laboratory, motion, runs
from pyjoystick.cli import main

#: Carries something out in the present folder.
Drive = Callable[[], None]


@dataclass(frozen=True)
class Subject:
    """Files of the corpus, one of which is damaged, and what is then done with them.

    Attributes:
        name: what is done
        damaged: a file, or one of several by a pattern
        others: what else is needed
        drive: does it; whatever it raises but errors of the project is a fault
    """

    name: str
    damaged: str
    others: tuple[str, ...]
    drive: Drive


class CommandError(Exception):
    """A command ended in a way in which none may end."""


class InterruptedCommandError(CommandError):
    """A command said that it was interrupted."""


def _command(*arguments: str) -> Drive:
    def drive() -> None:
        code = main(arguments)
        if code == 130:
            raise InterruptedCommandError("exit code 130")
        if code not in (0, 1, 2, 3):
            raise CommandError(f"exit code {code}")

    return drive


def _commands() -> Iterator[tuple[str, str, str]]:
    """Damaged file, what else is needed, and the command line."""
    markers = "--top TOP --base BASE1 BASE2 -o out.csv --motion moved.csv"
    yield "synthetic_trial_1.c3d", "", f"import markers synthetic_trial_1.c3d {markers} --radius 0.266"
    yield "synthetic_trial_3.csv", "", f"import markers synthetic_trial_3.csv {markers}"
    yield "plain.csv", "", f"import markers plain.csv {markers} --middle"
    yield "synthetic_forward.csv", "", "import load-curve synthetic_forward.csv --side forward -p out.toml"
    yield "synthetic_parts.csv", "", "import parts synthetic_parts.csv -p out.toml"
    yield "synthetic_swing.csv", "joystick.toml", "import swing synthetic_swing.csv -p joystick.toml"
    accelerometer = "--angle trial_1.csv --distance 0.25 -o out.csv"
    sampled = "--samples-per-second 600 --unit m/s2"
    for file, more in (("synthetic_acceleration_1.csv", ""), ("acceleration.npy", sampled)):
        yield file, "trial_1.csv", f"import accelerometer {file} {accelerometer} {more}"
    yield (
        "trial_1.csv",
        "acceleration.npy",
        f"import accelerometer acceleration.npy {accelerometer} {sampled}",
    )
    yield "trial_1.csv", "trial_2.csv joystick.toml", "peaks trial_1.csv trial_2.csv -p joystick.toml"
    yield (
        "trial_1.csv",
        "trial_2.csv joystick.toml",
        "budget trial_1.csv trial_2.csv -p joystick.toml --uncertainty m=1e-3",
    )
    yield "joystick.toml", "", "parameters -p joystick.toml --set m=0.9 -o out.toml"
    yield "joystick.toml", "", "free-oscillation -p joystick.toml -d 0.3"
    yield "motion.csv", "", "torque motion.csv --csv out.csv --json out.json"
    for file in ("fit.toml", "trial_1.csv"):
        others = "trial_1.csv trial_2.csv joystick.toml Joystick.fmu fit.toml"
        yield file, others, "fit trial_1.csv trial_2.csv --settings fit.toml"
    for file in ("driven.csv", "joystick.toml"):
        yield file, "driven.csv joystick.toml", "fit driven.csv --driven -p joystick.toml"
    for file in ("push.csv", "joystick.toml"):
        yield (
            file,
            "push.csv joystick.toml",
            "design -p joystick.toml --free J --torque push.csv --rate 100",
        )
    for line in ("run project --plan", "check project/laboratory.toml"):
        yield "project/laboratory.toml", "", line
    yield "sweep.toml", "Joystick.fmu", "sweep sweep.toml -o out.csv --threads 1"
    for file in ("done.csv", "done.parquet"):
        yield file, "sweep.toml Joystick.fmu", f"sweep sweep.toml -o {file} --threads 1 --indices indices.csv"
    yield (
        "half.csv.parts/*",
        "sweep.toml Joystick.fmu half.csv.parts",
        "sweep sweep.toml -o half.csv --threads 1",
    )
    for name in ("Joystick", "Echo", "Awkward"):
        yield f"{name}.fmu", "", f"info {name}.fmu --all"
    for form in ("csv", "xlsx", "ods", "mat", "parquet"):
        units = "--unit time=s --unit theta=rad" if form == "mat" else ""
        yield f"log.{form}", "", f"import record log.{form} --output out.csv {units}"
    for file in ("joystick.toml", "fit.toml", "sweep.toml"):
        yield file, "Joystick.fmu", f"check {file}"
    yield "inputs.csv", "Joystick.fmu", "compare Joystick.fmu Joystick.fmu --inputs inputs.csv --interface cs"


def _read_and_run_ssp() -> None:
    system = runs.read_ssp("joystick.ssp", "unpacked")
    if system.stop_time < 10.0:
        runs.run_coupled(system, step=0.05)


def _run_fmu() -> None:
    with Fmu("Joystick.fmu") as fmu:
        fmu.run(np.linspace(0.0, 0.05, 6))


def _run_foreign(file: str) -> None:
    """In a process of its own, as what no one has said that this project made."""
    with Fmu(file, time_limit=5.0) as fmu:
        fmu.run(np.linspace(0.0, 0.05, 6))
        with fmu.start() as run:
            run.step(0.01)


def _readers() -> Iterator[Subject]:
    yield Subject("read_ssp", "joystick.ssp", (), _read_and_run_ssp)
    yield Subject("Fmu.run", "Joystick.fmu", (), _run_fmu)
    for name in ("Echo.fmu", "Awkward.fmu"):
        yield Subject(f"Fmu.run of {name}", name, (), lambda name=name: _run_foreign(name))
    yield Subject("read_record", "trial_1.csv", (), lambda: motion.read_record("trial_1.csv") and None)
    for name in ("synthetic_trial_1.c3d", "synthetic_trial_3.csv", "plain.csv"):
        yield Subject("read_markers", name, (), lambda name=name: laboratory.read_markers(name) and None)
    for name in ("done.csv", "done.parquet"):
        yield Subject("read_sweep", name, (), lambda name=name: runs.read_sweep(name) is None)


SUBJECTS: Final = (
    *(
        Subject(f"pyjoystick {line}", damaged, tuple(others.split()), _command(*line.split()))
        for damaged, others, line in _commands()
    ),
    *_readers(),
)
