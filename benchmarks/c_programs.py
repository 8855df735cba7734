"""The contenders in C: the hand-written program, and the bare loop around the FMU."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from benchmarks.build import UnpackedFmu
from benchmarks.contender import Contender
from benchmarks.errors import BenchmarkError
from benchmarks.task import INTERVALS, RELEASE, Law
from pyjoystick.support import FloatArray

#: Number of batches, of one run each, so that interruptions by other programs affect few of them.
_BATCHES: Final = 100


@dataclass(frozen=True, slots=True)
class _Program:
    """A program's command line, split where release, batches, runs and the rest are inserted."""

    before_release: Sequence[str]
    after_release: Sequence[str]
    after_runs: Sequence[str]
    samples_file: Path

    def run(self, release: float, batches: int) -> tuple[dict[str, float], FloatArray]:
        """Return its line of results, and theta (rad) at the samples."""
        counts = (str(batches), "1")
        command = [*self.before_release, f"{release:.17g}", *self.after_release, *counts, *self.after_runs]
        done = subprocess.run([*command, str(self.samples_file)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise BenchmarkError(f"{Path(command[0]).name} failed: {done.stderr.strip()}")
        return json.loads(done.stdout), np.loadtxt(self.samples_file)[:, 0]


def hand_written(program: Path, law: Law, tolerance: float, folder: Path) -> Contender:
    """The program joystick.c."""
    samples_file = folder / "joystick.txt"
    command = _Program((str(program), law, f"{tolerance:.17g}"), (), (), samples_file)
    return _contender("hand-written C", law, tolerance, command, command)


def fmu_loop(
    program: Path, fmu: UnpackedFmu, law: Law, tolerance: float, folder: Path, *, steps: int = INTERVALS
) -> Contender:
    """The program fmu_loop.c with `steps` communication steps a run."""
    names = ("theta_start", "theta", "omega", "alpha")
    references = tuple(str(fmu.reference(name)) for name in names)
    resources = (fmu.folder / "resources").as_uri()

    def command(library: Path) -> _Program:
        before = (str(program), str(library), fmu.description.guid, resources, f"{tolerance:.17g}")
        return _Program(before, (str(steps),), references, folder / f"fmu_loop-{steps}.txt")

    name = "FMU (CS), bare C loop"
    if steps != INTERVALS:
        name += f", {steps} communication steps"
    return _contender(name, law, tolerance, command(fmu.library), command(fmu.counting_library))


def _contender(name: str, law: Law, tolerance: float, program: _Program, counting: _Program) -> Contender:
    counted, checked = counting.run(RELEASE, 1)

    def seconds() -> float:
        result, _ = program.run(RELEASE, _BATCHES)
        if (result["theta_final"], result["theta_max"]) != (checked[-1], checked.max()):
            raise BenchmarkError(f"{name}: the timed runs gave other results than the checked ones")
        return result["seconds"]

    return Contender(
        name=name,
        law=law,
        tolerance=tolerance,
        theta=lambda release: program.run(release, 1)[1],
        seconds=seconds,
        evaluations=int(counted["evaluations"]),
    )
