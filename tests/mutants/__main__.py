"""Change one operator, constant or statement at a time, at random, and see whether the tests notice.

``python -m tests.mutants fmu_build/codegen --count 20 --seed 7`` works on a copy of the project: the checkout
stays as it is. The exit code is 0 if no mutant survived, else 1.
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
#: What a copy of the project does without; the environment and what was built are linked to.
_LEFT: Final = (".git", ".venv", "build", "dist", "results", "__pycache__", ".*_cache", ".hypothesis")
#: Tests of places that none of the same name mirrors.
_ELSEWHERE: Final = {"fmu_build/runtime": ("tests/fmu_build/runtime", "tests/fmu_build/models")}


def main() -> int:
    """Return 1 where a mutant survived, else 0."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("place", help="file or folder with .py and .c files, such as fmu_build/codegen")
    parser.add_argument("--count", type=int, default=10, help="mutants (default: %(default)s)")
    parser.add_argument(
        "--seed", type=int, default=random.randrange(2**31), help="default: another each time"
    )
    parser.add_argument("--seconds", type=float, default=180.0, help="for the tests of one (default: 180)")
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
    """The tests of a place: of a module its own file, else its folder; ``tests/`` has the same tree."""
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
    # Another size or time, so that no bytecode of the original is taken for that of the mutant.
    target.write_text(text[: change.at] + change.after + text[change.at + len(change.before) :], "utf-8")
    try:
        return _outcome(copy, tests, seconds)
    finally:
        target.write_text(text, "utf-8")


def _outcome(copy: Path, tests: list[str], seconds: float) -> str:
    """``survived`` where all tests pass, ``killed`` where one fails, ``timeout`` where they take too long."""
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
                # With all that the tests have started, which would go on without them.
                os.killpg(process.pid, signal.SIGKILL)


if __name__ == "__main__":
    sys.exit(main())
