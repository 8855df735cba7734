"""Build one example, run it and compare it, in a separate process, because it may hang or crash.

    python -m benchmarks.msl.example MODEL LIBRARY REFERENCE_FOLDER

prints the `Outcome` as JSON.
"""

from __future__ import annotations

import json
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Literal

from benchmarks.msl.comparison import NEAR, TOLERANCE, largest_error, read_reference
from fmu_build import BuildError, build_fmu
from pyjoystick.fmu import Fmu
from pyjoystick.support import PyJoystickError

_RUN_TOLERANCE = 1e-8

Verdict = Literal["right", "near", "differs", "refused", "stops", "crash", "too long"]


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of an example; `detail` is the relative error, or why there is none."""

    verdict: Verdict
    detail: str
    seconds: float = 0.0
    """Build time."""


def try_example(model: str, library: Path, reference_folder: Path) -> Outcome:
    """Return the outcome of an example; errors in building or running become verdicts."""
    reference = read_reference(reference_folder)
    with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
        try:
            built = build_fmu(model, folder, library=library, fmi_types=("cs",))
        except BuildError as error:
            return Outcome("refused", str(error))
        try:
            with Fmu(built.path) as fmu:
                result = fmu.run(reference.instants, outputs=reference.signals, tolerance=_RUN_TOLERANCE)
        except PyJoystickError as error:
            return Outcome("stops", str(error), built.seconds)
    distance, signal = largest_error(reference, result)
    verdict: Verdict = "right" if distance <= TOLERANCE else "near" if distance <= NEAR else "differs"
    return Outcome(verdict, f"{distance:.0e} {signal}".strip(), built.seconds)


if __name__ == "__main__":
    model, library, reference = sys.argv[1:]
    print(json.dumps(asdict(try_example(model, Path(library), Path(reference)))))
