"""``python -m tests.fuzz.readers --seconds 60``: damaged files for every reader; ``--case N`` repeats one."""

from __future__ import annotations

import argparse
import os
import random
import sys
from pathlib import Path

from tests.fuzz.readers.campaign import fuzz_all
from tests.fuzz.readers.trial import trial


def main() -> int:
    """Return 1 where something was found, else 0."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz.readers", description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0, help="how long (default: %(default)g)")
    parser.add_argument(
        "--seed", type=int, default=random.randrange(2**31), help="default: another each time"
    )
    parser.add_argument("--case", type=int, help="repeat this case alone")
    parser.add_argument("--folder", type=Path, default=Path("build/fuzz"), help="for corpus and faults")
    settings = parser.parse_args()
    folder = settings.folder.absolute()
    if settings.case is not None:
        fuzz_all(folder, 0.0, 0, 1)
        fault = trial(settings.case, folder / "readers", folder / "faults")
        print(fault or "no fault")
        return int(fault is not None)
    print(f"seed {settings.seed}")
    (outcome,) = fuzz_all(folder, settings.seconds, settings.seed, os.cpu_count() or 1)
    print(f"{outcome.target}: {outcome.executions:,} inputs, {'FAULT' if outcome.fault else 'no fault'}")
    print(outcome.fault, file=sys.stderr)
    return int(bool(outcome.fault))


if __name__ == "__main__":
    sys.exit(main())
