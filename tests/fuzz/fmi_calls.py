"""libFuzzer over random FMI calls of both versions, with AddressSanitizer and UndefinedBehaviorSanitizer.

A target is one model, written by hand or generated, with the runtime of one version of FMI. The corpus of a
target stays in its folder, so that the next run goes on from there.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from importlib import resources
from pathlib import Path

from fmu_build.packaging.sources import FMI_HEADERS, include_arguments, runtime_files
from fmu_build.support.request import FmiVersion
from tests.fmu_build.runtime.library import MODELS, TOKEN
from tests.fuzz.generated import generated
from tests.fuzz.outcome import Outcome

HERE = Path(__file__).parent
ALLOCATIONS = MODELS.parent / "allocations.c"
VERSIONS: tuple[FmiVersion, ...] = ("2.0", "3.0")
# Events of state and time, inputs of all types, clocks, algebraic loops, crowds of events, dry friction.
NAMES = ("joystick", "ball", "lag", "loop", "sampler", "slide", "windows")
# Generated C: derivatives that jump at events, modes of friction, a sampled controller.
GENERATED_NAMES = ("sensitivities", "friction", "sampled")
FLAGS = (
    *("-std=c11", "-O1", "-g", "-Wall", "-Wextra", "-Wpedantic", "-Werror"),
    *("-fsanitize=fuzzer,address,undefined", "-fno-sanitize-recover=undefined"),
    # A stiff step is given up after so many steps of the integrator: a fuzzer makes many.
    "-DPATIENCE=2000",
)
#: Seconds that one input may take before it counts as a hang; some hundred times what the slowest takes.
HANG = 20
_EXECUTIONS = re.compile(r"stat::number_of_executed_units:\s+(\d+)")


class NoFuzzerError(Exception):
    """This machine has no compiler with libFuzzer."""


def compiler() -> str:
    """Return clang's path; raise `NoFuzzerError` where there is none, or one without libFuzzer."""
    clang = shutil.which("clang")
    if clang is None:
        raise NoFuzzerError("needs clang")
    name = subprocess.check_output([clang, "-print-runtime-dir"], text=True).strip()
    if not any(Path(name).glob("*fuzzer*")):
        raise NoFuzzerError("clang comes without libFuzzer (Debian: libclang-rt-dev)")
    return clang


def build(folder: Path, model: str, version: FmiVersion) -> Path:
    """Compile one target into the folder; raise `CalledProcessError` where it does not compile."""
    target = folder / f"fmi{version[0]}_{model}"
    work = target.with_suffix(".build")
    work.mkdir(parents=True, exist_ok=True)
    (work / "token.h").write_text(f'#define MODEL_TOKEN "{TOKEN}"\n', "utf-8")
    standard = work / "standard"
    standard.mkdir(exist_ok=True)
    for name in FMI_HEADERS[version]:
        (standard / name).write_bytes((resources.files("fmpy") / "c-code" / name).read_bytes())
    runtime = [file for file in runtime_files(version) if file.suffix == ".c"]
    source, flags = MODELS / f"{model}.c", [*FLAGS]
    if model in GENERATED_NAMES:
        source = work / f"{model}.c"
        source.write_text(generated(model).c_source, "utf-8")
        flags += [f"-DMAX_REFERENCE={len(generated(model).description.variables)}"]
    sources = [*runtime, source, ALLOCATIONS, HERE / f"fmi{version[0]}_calls.c"]
    headers = [*include_arguments(), f"-I{work}", f"-I{MODELS}", "-isystem", str(standard)]
    counted = ["-include", str(ALLOCATIONS.with_suffix(".h"))]
    command = [compiler(), *flags, *headers, *counted, *map(str, sources), "-lm", "-o", str(target)]
    subprocess.run(command, check=True)
    return target


def fuzz(target: Path, limits: list[str], seed: int) -> Outcome:
    """Run one target within limits such as ``-runs=1000`` or ``-max_total_time=10``."""
    corpus = target.with_suffix(".corpus")
    corpus.mkdir(exist_ok=True)
    options = [
        f"-seed={seed}",
        f"-timeout={HANG}",
        "-max_len=512",
        "-print_final_stats=1",
        "-close_fd_mask=1",
    ]
    command = [str(target), *options, *limits, f"-artifact_prefix={target}-", str(corpus)]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    executions = _EXECUTIONS.search(done.stderr)
    fault = "" if done.returncode == 0 else done.stderr[-4000:]
    return Outcome(target.name, int(executions[1]) if executions else 0, fault)


def fuzz_all(folder: Path, seconds: float, calls: int | None, seed: int, processes: int) -> list[Outcome]:
    """Share the seconds of so many processes among all targets, or try so many inputs of each."""
    for model in GENERATED_NAMES:
        generated(model)  # here, for rumoca's sessions belong to the thread that made them
    names = [(model, version) for model in (*NAMES, *GENERATED_NAMES) for version in VERSIONS]
    each = max(1, round(seconds * processes / len(names)))
    limit = f"-max_total_time={each}" if calls is None else f"-runs={calls}"
    with ThreadPoolExecutor(processes) as pool:
        targets = list(pool.map(lambda name: build(folder, *name), names))
        return list(pool.map(lambda target: fuzz(target, [limit], seed), targets))
