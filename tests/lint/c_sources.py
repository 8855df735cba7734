"""Compiles the runtime, the generated joystick models and the benchmarks with every warning an error.

``python -m tests.lint.c_sources``: with the C compiler that pip installs, and with gcc where it is there.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import fmpy
import rumoca

from fmu_build.codegen import ModelSource, generate
from fmu_build.compilers.library import default_library, entry_file
from fmu_build.packaging.sources import RUNTIME, include_arguments
from pyjoystick.fmu import MODELS

STRICT = ("-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O2", "-c")
BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


def main() -> int:
    """Returns the number of compilers that complained."""
    compilers = {"zig cc": [sys.executable, "-m", "ziglang", "cc"]}
    if gcc := shutil.which("gcc"):
        compilers["gcc"] = [gcc]
    with tempfile.TemporaryDirectory() as folder:
        files = [*sorted(RUNTIME.rglob("*.c")), *sorted(BENCHMARKS.glob("*.c")), *_generated(Path(folder))]
        standard = Path(fmpy.__file__).parent / "c-code"
        headers = [*include_arguments(), f"-I{folder}", "-isystem", str(standard)]
        return sum(
            _complains(name, [*command, *STRICT, *headers], files) for name, command in compilers.items()
        )


def _generated(folder: Path) -> list[Path]:
    (folder / "token.h").write_text('#define MODEL_TOKEN "{}"\n')
    files = []
    for name, model in MODELS.items():
        session = rumoca.Session()
        loaded = session.load(str(entry_file(default_library())), model=model)
        files.append(folder / f"{name}.c")
        files[-1].write_text(generate(ModelSource(session, loaded)).c_source)
    return files


def _complains(name: str, command: list[str], files: list[Path]) -> bool:
    def is_good(file: Path) -> bool:
        # One file at a time: zig's driver links what it is given together, whatever the options say.
        return subprocess.run([*command, str(file)], cwd=objects, check=False).returncode == 0

    with tempfile.TemporaryDirectory() as objects, ThreadPoolExecutor(os.cpu_count()) as pool:
        bad = [file.name for file, good in zip(files, pool.map(is_good, files), strict=True) if not good]
    print(f"{name}: {len(files)} files, {len(bad)} with warnings {' '.join(bad)}".rstrip())
    return bool(bad)


if __name__ == "__main__":
    sys.exit(main())
