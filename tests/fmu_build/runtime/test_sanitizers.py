"""Tests of the runtime and generated models, compiled to watch memory, undefined behaviour and threads."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from importlib import resources
from pathlib import Path

import pytest

from fmu_build.packaging.sources import MODULE_FACE, RUNTIME
from tests.fmu_build.runtime.library import TOKEN, Workshop
from tests.fuzz.generated import GENERATED, generated

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
FUZZ = ROOT / "tests" / "fuzz"
# Everything but the tables of calls, whose hundreds of cases take the same few paths, and what measures the
# memory of the process.
# Single tests that are left out: the one that is compiled in its own way below, and one of millions of steps
# such as others take, too.
LEFT_OUT = "not c_threads and not many_steps"
TESTS = (
    "test_blocks.py",
    "test_derivatives.py",
    "test_fmi3_cosimulation.py",
    "test_fmi3_states.py",
    "test_inputs.py",
    "test_integration.py",
    "test_joystick.py",
    "test_units.py",
    "test_life_cycle.py",
    "test_memory.py",
    "test_model_exchange.py",
    "test_repaired_states.py",
    "test_saved_states.py",
    "test_state_events.py",
    "test_time_events.py",
    "test_variables.py",
    "conformance/test_bad_calls.py",
)


# A stiff step is given up after so many steps of the integrator: random calls make many.
PROGRAM_FLAGS = ("-g", "-DPATIENCE=2000", "-fno-sanitize-recover=all")
#: Time and rows of the runs of generated models, and how many random inputs each is given.
STOP_TIME, ROWS, INPUTS = 2.0, 101, 1000
LETTERS = {"Real": "r", "Integer": "i", "Enumeration": "i", "Boolean": "b"}


def _gcc(*libraries: str) -> tuple[str, list[str]]:
    """gcc, and where it has these libraries; skips the test where it has not."""
    gcc = shutil.which("gcc")
    if gcc is None or sys.platform != "linux":
        pytest.skip("needs gcc on Linux, whose sanitizers are shared libraries")
    found = [
        subprocess.check_output([gcc, f"-print-file-name={name}"], text=True).strip() for name in libraries
    ]
    missing = [name for name in found if not Path(name).is_absolute()]
    if missing:
        pytest.skip(f"gcc comes without {', '.join(missing)}")
    return gcc, found


def test_memory_and_undefined_behaviour() -> None:
    """AddressSanitizer and UndefinedBehaviorSanitizer end the process at the first fault."""
    gcc, preloaded = _gcc("libasan.so", "libubsan.so", "libstdc++.so")
    environment = os.environ | {
        "RUNTIME_TEST_COMPILER": f"{gcc} -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=undefined",
        # In front of Python, which is not made with them; C++ extensions throw through AddressSanitizer.
        "LD_PRELOAD": " ".join(preloaded),
        "ASAN_OPTIONS": "detect_leaks=0",  # Python has its own idea of them; test_memory.py counts ours
    }
    # Without capturing, for the sanitizers write to the process's own standard error as they end it.
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-s", "-p", "no:cacheprovider", "-p", "no:xdist"]
    done = subprocess.run(
        [*command, "-k", LEFT_OUT, *(str(HERE / name) for name in TESTS)],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    assert done.returncode == 0, (done.stdout + done.stderr)[-6000:]


def _sanitizer(name: str) -> list[str]:
    """A compiler with this sanitizer, and its flag; skips the test where there is none."""
    if name != "memory":
        gcc, _ = _gcc("libasan.so", "libubsan.so")
        return [gcc, f"-fsanitize={name}"]
    clang = shutil.which("clang")
    if clang is None or sys.platform != "linux":
        pytest.skip("needs clang on Linux")
    folder = Path(subprocess.check_output([clang, "-print-runtime-dir"], text=True).strip())
    if not any(folder.glob("*msan*")):
        pytest.skip("clang comes without MemorySanitizer (Debian: libclang-rt-dev)")
    return [clang, f"-fsanitize={name}"]


def _said(program: Path, *arguments: str) -> str:
    """What a program says if it fails."""
    done = subprocess.run(
        [program, *arguments], capture_output=True, text=True, errors="replace", check=False
    )
    return (
        "" if done.returncode == 0 else f"exit code {done.returncode}\n{(done.stdout + done.stderr)[-4000:]}"
    )


@pytest.mark.parametrize(
    ("sanitizer", "names"),
    [("address,undefined", GENERATED), ("memory", ("sensitivities", "friction", "loops"))],
    ids=["address and undefined behaviour", "memory that was never set"],
)
def test_generated_models(tmp_path: Path, sanitizer: str, names: tuple[str, ...]) -> None:
    """Whole runs through the face of WebAssembly modules, and random calls."""
    workshop = Workshop(tmp_path, compiler=[*_sanitizer(sanitizer), *PROGRAM_FLAGS])
    faults = {}
    for name in names:
        model = generated(name)
        source = tmp_path / f"{name}.c"
        source.write_text(model.c_source, "utf-8")
        face = [HERE / "module_face.c", *sorted((RUNTIME / MODULE_FACE).glob("*.c"))]
        run = workshop.program(f"{name}_face", source, *face)
        calls = workshop.program(f"{name}_calls", source, FUZZ / "fmi2_calls.c", FUZZ / "standalone.c")
        variables = [
            f"{'u' if one.causality == 'input' else LETTERS[one.type]}{reference}"
            for reference, one in enumerate(model.description.variables)
        ]
        said = _said(run, str(STOP_TIME), str(ROWS), *variables) + _said(calls, "1", str(INPUTS))
        if said:
            faults[name] = said
    assert faults == {}


def test_threads(tmp_path: Path) -> None:
    """ThreadSanitizer over instances that are at work in threads of their own."""
    gcc, _ = _gcc("libtsan.so")
    flags = ("-O1", "-g", "-fsanitize=thread")
    library = tmp_path / "library"
    library.mkdir()
    path = Workshop(library, "3.0", [gcc, *flags]).path("joystick")
    program, headers = tmp_path / "threads", resources.files("fmpy") / "c-code"
    command = [gcc, "-std=c11", *flags, "-isystem", str(headers), str(HERE / "threads.c"), "-o", str(program)]
    subprocess.run([*command, "-lpthread", "-ldl"], check=True)
    done = subprocess.run([program, path, TOKEN], capture_output=True, text=True, check=False)
    assert done.returncode == 0, (done.stdout + done.stderr)[-6000:]
