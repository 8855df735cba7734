"""``make fuzz SECONDS=60``: fuzz for so long, and print what was run and what was found."""

from __future__ import annotations

import argparse
import os
import random
import sys
from pathlib import Path

from tests.fuzz import fmi_calls


def main() -> int:
    """Return 1 where something was found, else 0."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0, help="how long (default: %(default)g)")
    parser.add_argument(
        "--seed", type=int, default=random.randrange(2**31), help="default: another each time"
    )
    parser.add_argument("--folder", type=Path, default=Path("build/fuzz"), help="for programs and corpora")
    settings = parser.parse_args()
    print(f"seed {settings.seed}")
    try:
        outcomes = fmi_calls.fuzz_all(
            settings.folder.absolute(), settings.seconds, settings.seed, os.cpu_count() or 1
        )
    except fmi_calls.NoFuzzerError as error:
        print(f"FMI calls: skipped, {error}")
        return 0
    for outcome in outcomes:
        print(
            f"{outcome.target:16} {outcome.executions:10,} inputs  {'FAULT' if outcome.fault else 'no fault'}"
        )
    print(f"{'FMI calls':16} {sum(outcome.executions for outcome in outcomes):10,} inputs")
    for outcome in outcomes:
        if outcome.fault:
            print(f"\n{outcome.target}:\n{outcome.fault}", file=sys.stderr)
    return int(any(outcome.fault for outcome in outcomes))


if __name__ == "__main__":
    sys.exit(main())
