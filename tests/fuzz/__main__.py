"""``make fuzz SECONDS=60``: random FMI calls, damaged files, damaged tables of known contents, random models.

Each has the same part of the time.
The FMI calls of a seed are the same each time from an empty folder only: what was found stays in the corpus.
"""

from __future__ import annotations

import argparse
import os
import random
import sys
from pathlib import Path
from typing import Final

from tests.fuzz import fmi_calls
from tests.fuzz.models.trial import trial as try_model
from tests.fuzz.outcome import Outcome
from tests.fuzz.readers import campaign as readers
from tests.fuzz.readers.trial import trial
from tests.fuzz.tables.trial import trial as try_table
from tests.fuzz.verdicts import try_all

_TARGETS: Final = ("calls", "readers", "tables", "models")


def main() -> int:
    """Return 1 where something was found, else 0."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0, help="how long (default: %(default)g)")
    parser.add_argument(
        "--seed", type=int, default=random.randrange(2**31), help="default: another each time"
    )
    each = "so many {} instead of for a time: with a seed, the same each time"
    parser.add_argument("--calls", type=int, help=each.format("inputs of each model with random calls"))
    parser.add_argument("--files", type=int, help=each.format("damaged files"))
    parser.add_argument("--tables", type=int, help=each.format("damaged tables of known contents"))
    parser.add_argument("--models", type=int, help=each.format("random Modelica models"))
    parser.add_argument("--folder", type=Path, default=Path("build/fuzz"), help="for programs and corpora")
    parser.add_argument("--only", choices=_TARGETS, help="one of them, for all of the time")
    parser.add_argument("--case", type=int, help="repeat this one damaged file alone")
    settings = parser.parse_args()
    folder = settings.folder.absolute()
    if settings.case is not None:
        readers.fuzz_all(folder, 0.0, 0, 0, 1)
        fault = trial(settings.case, folder / "readers", folder / "faults")
        print(fault or "no fault")
        return int(fault is not None)
    print(f"seed {settings.seed}", flush=True)
    chosen = [settings.only] if settings.only else _TARGETS
    seconds = settings.seconds / len(chosen)
    processes = os.cpu_count() or 1
    outcomes: list[Outcome] = []
    if "calls" in chosen:
        try:
            outcomes += fmi_calls.fuzz_all(folder, seconds, settings.calls, settings.seed, processes)
        except fmi_calls.NoFuzzerError as error:
            print(f"random FMI calls: skipped, {error}", flush=True)
    if "readers" in chosen:
        outcomes += readers.fuzz_all(folder, seconds, settings.files, settings.seed, processes)
    for target, one, count in (
        ("tables", try_table, settings.tables),
        ("models", try_model, settings.models),
    ):
        if target in chosen:
            outcomes += try_all(target, one, seconds, count, settings.seed, processes)
    return _told(outcomes)


def _told(outcomes: list[Outcome]) -> int:
    for outcome in outcomes:
        print(
            f"{outcome.target:16} {outcome.executions:10,} inputs  {'FAULT' if outcome.fault else 'no fault'}"
        )
    print(f"{'all':16} {sum(outcome.executions for outcome in outcomes):10,} inputs")
    for outcome in outcomes:
        if outcome.fault:
            print(f"\n{outcome.target}:\n{outcome.fault}", file=sys.stderr)
    return int(any(outcome.fault for outcome in outcomes))


if __name__ == "__main__":
    sys.exit(main())
