"""Mutation trials: change one operator, constant or statement at a time, at random, and run the tests.

``python -m tests.mutants fmu_build/codegen --count 20 --seed 7`` works on a copy of the project; the checkout
is not modified. The exit code is 0 if no mutant survived, 1 if one did, 2 if the tests fail without a change.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import Final

from tests.mutants.changes import Change, changes

ROOT: Final = Path(__file__).parents[2]
#: Files that are not copied with the project; the environment is linked, and the build copied separately.
_LEFT: Final = (".git", ".venv", "build", "dist", "results", "__pycache__", ".*_cache", ".hypothesis")
#: Tests of folders that have no tests folder of the same name.
_ELSEWHERE: Final = {"fmu_build/runtime": ("tests/fmu_build/runtime", "tests/fmu_build/models")}


def main() -> int:
    """Run the trials; return 1 if a mutant survived, 2 if the tests fail without a change, else 0."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("place", help="file or folder with .py and .c files, such as fmu_build/codegen")
    parser.add_argument("--count", type=int, default=10, help="number of mutants (default: %(default)s)")
    parser.add_argument(
        "--seed", type=int, default=random.randrange(2**31), help="default: a new one each time"
    )
    parser.add_argument(
        "--seconds",
        type=float,
        default=180.0,
        help="time limit for one mutant (default: 180); the run without a change has ten times as long",
    )
    parser.add_argument("--tests", nargs="+", metavar="PATH", help="default: the tests that mirror the place")
    settings = parser.parse_args()
    place = (ROOT / settings.place).resolve()
    files = sorted({place} if place.is_file() else {*place.rglob("*.py"), *place.rglob("*.c")})
    choice = random.Random(settings.seed)
    found = [(file, change) for file in files for change in changes(file)]
    if not found:
        parser.error(f"{settings.place}: no .py or .c file with anything to change")
    print(f"seed {settings.seed}: {settings.count} of {len(found)} mutants", flush=True)
    with tempfile.TemporaryDirectory(prefix="mutants-") as name:
        copy = _copied(Path(name) / "project")
        tests = settings.tests or _mirror(place)
        if _outcome(copy, tests, 10 * settings.seconds) != "survived":
            print(f"the tests fail without any change: {' '.join(tests)}", file=sys.stderr)
            return 2
        outcomes: Counter[str] = Counter()
        for number, (file, change) in enumerate(choice.sample(found, min(settings.count, len(found))), 1):
            outcome = _tried(copy, file.relative_to(ROOT), change, tests, settings.seconds)
            outcomes[outcome] += 1
            line = f"{file.relative_to(ROOT)}:{change.line}"
            print(f"{number:3} {outcome:9} {line}: {change.before!r} -> {change.after!r}", flush=True)
    print(", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items())))
    return int(outcomes["survived"] > 0)


def _copied(copy: Path) -> Path:
    shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(*_LEFT), symlinks=True)
    (copy / ".venv").symlink_to(ROOT / ".venv")
    if (ROOT / "build").is_dir():
        # A copy of its own: tests that build anew must not write into the checkout.
        shutil.copytree(
            ROOT / "build", copy / "build", ignore=shutil.ignore_patterns("fuzz", "docs", "doctrees")
        )
    return copy


def _mirror(place: Path) -> list[str]:
    """Return the tests of a place: a module's own file, else the folder; ``tests/`` has the same tree."""
    inside = place.relative_to(ROOT)
    for start, tests in _ELSEWHERE.items():
        if inside.is_relative_to(start):
            return [*tests]
    own = ROOT / "tests" / inside.parent / f"test_{inside.stem}.py"
    if place.is_file() and own.is_file():
        return [own.relative_to(ROOT).as_posix()]
    folder = ROOT / "tests" / (inside.parent if place.is_file() else inside)
    while not any(folder.rglob("test_*.py")):
        folder = folder.parent
    return [folder.relative_to(ROOT).as_posix()]


def _tried(copy: Path, file: Path, change: Change, tests: list[str], seconds: float) -> str:
    target = copy / file
    text = target.read_text("utf-8")
    # The new size or time prevents Python from using the bytecode of the original for the mutant.
    target.write_text(text[: change.at] + change.after + text[change.at + len(change.before) :], "utf-8")
    try:
        return _outcome(copy, tests, seconds)
    finally:
        target.write_text(text, "utf-8")


def _outcome(copy: Path, tests: list[str], seconds: float) -> str:
    """Return ``survived`` if all tests pass, ``killed`` if one fails, ``timeout`` if they take too long."""
    command = [sys.executable, "-B", "-m", "pytest", "-q", "-x", "-n", "0", "-p", "no:cacheprovider", *tests]
    environment = os.environ | {"PYTHONPATH": str(copy), "OPENBLAS_NUM_THREADS": "1"}
    with subprocess.Popen(
        command,
        cwd=copy,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    ) as process:
        try:
            return "survived" if process.wait(seconds) == 0 else "killed"
        except subprocess.TimeoutExpired:
            return "timeout"
        finally:
            if process.poll() is None:
                # Including all processes that the tests have started, which would otherwise continue.
                os.killpg(process.pid, signal.SIGKILL)


if __name__ == "__main__":
    sys.exit(main())
