"""Build the programs of the benchmark with the FMU's compiler settings, and unpack the FMUs."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import fmpy

from benchmarks.errors import BenchmarkError
from fmu_build.packaging.binaries import COMPILER_FLAGS, compile_library
from fmu_build.packaging.platforms import Platform, host_platform
from fmu_build.packaging.sources import MODEL_FILE

SOURCES: Final = Path(__file__).parent
#: The C files of each program.
PROGRAMS: Final = {"joystick": ("joystick.c", "measure.c"), "fmu_loop": ("fmu_loop.c", "measure.c")}

_COUNTER: Final = """\
#include "model.h"

bool model_derivatives_itself(double time, double *y, const double *p, double *der,
                              double *root);
__attribute__((visibility("default"))) unsigned long derivative_evaluations = 0;

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    ++derivative_evaluations;
    return model_derivatives_itself(time, y, p, der, root);
}
"""


@dataclass(frozen=True, slots=True)
class UnpackedFmu:
    """An FMU on disk.

    Attributes:
        folder: where it was unpacked
        description: FMPy's model description
        library: its binary for this machine
        counting_library: built from the same sources, with a counter of derivative evaluations
    """

    folder: Path
    description: Any
    library: Path
    counting_library: Path

    def reference(self, name: str) -> int:
        """Return a variable's value reference; raises BenchmarkError if there is no such variable."""
        for variable in self.description.modelVariables:
            if variable.name == name:
                return int(variable.valueReference)
        raise BenchmarkError(f"the FMU {self.description.modelName} has no variable {name!r}")


def compile_programs(folder: Path) -> dict[str, Path]:
    """Return the executables by name; raises BenchmarkError with the compiler's output."""
    platform = _platform()
    headers = Path(fmpy.__file__).parent / "c-code"
    compiler = [sys.executable, "-m", "ziglang", "cc", "-target", platform.target, "-mcpu=baseline"]
    programs = {}
    for name, files in PROGRAMS.items():
        programs[name] = folder / name
        sources = [str(SOURCES / file) for file in files]
        arguments = [*COMPILER_FLAGS, "-isystem", str(headers), "-o", str(programs[name]), *sources]
        done = subprocess.run(
            [*compiler, *arguments, "-lm", "-ldl"], capture_output=True, text=True, check=False
        )
        if done.returncode != 0:
            raise BenchmarkError(f"the C compiler failed on {name}:\n{done.stdout}{done.stderr}".rstrip())
    return programs


def unpack(fmu: Path, folder: Path) -> UnpackedFmu:
    """Unpack an FMU into a new folder; raises BenchmarkError if the file is missing or not an FMU."""
    if not fmu.is_file():
        raise BenchmarkError(f"{fmu} is missing; `make fmu` builds it")
    target = folder / fmu.stem
    try:
        with zipfile.ZipFile(fmu) as archive:
            archive.extractall(target)
        description = fmpy.read_model_description(str(target))
    except Exception as error:  # FMPy raises bare Exception
        raise BenchmarkError(f"{fmu} is not an FMU that can be read: {error}") from error
    identifier = description.coSimulation.modelIdentifier
    platform = _platform()
    library = target / "binaries" / platform.folder("2.0") / f"{identifier}{platform.extension}"
    if not library.is_file():
        raise BenchmarkError(f"{fmu} has no binary for {platform.name}")
    counting_library = folder / f"{identifier}-counting{platform.extension}"
    counting_library.write_bytes(_compile_counting(target / "sources", identifier, platform))
    return UnpackedFmu(target, description, library, counting_library)


def _compile_counting(sources: Path, identifier: str, platform: Platform) -> bytes:
    files = {path.name: path.read_bytes() for path in sources.iterdir()}
    files[MODEL_FILE] = b"#define model_derivatives model_derivatives_itself\n" + files[MODEL_FILE]
    files["derivative_counter.c"] = _COUNTER.encode()
    return compile_library(files, identifier, platform)[0]


def _platform() -> Platform:
    platform = host_platform()
    if platform is None:
        raise BenchmarkError("FMUs cannot be built for this machine")
    return platform
