"""The runtime's tests with sanitizers for memory, undefined behaviour and threads."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from importlib import resources
from pathlib import Path

import pytest

from tests.fmu_build.runtime.library import TOKEN, Workshop

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
# Everything but the tables of calls, whose hundreds of cases take the same few paths, and what measures the
# memory of the process.
TESTS = (
    "test_blocks.py",
    "test_derivatives.py",
    "test_fmi3_cosimulation.py",
    "test_fmi3_states.py",
    "test_inputs.py",
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
        [*command, "-k", "not c_threads", *(str(HERE / name) for name in TESTS)],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    assert done.returncode == 0, (done.stdout + done.stderr)[-6000:]


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
