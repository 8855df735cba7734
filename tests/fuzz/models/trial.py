"""One trial: build and run a random model, and compare its variables with the expected values."""

from __future__ import annotations

import math
import tempfile
import traceback
from itertools import pairwise
from pathlib import Path
from random import Random
from typing import Any, Final, Literal

from fmu_build import build_fmu
from fmu_build.support.errors import UnsupportedModelError
from pyjoystick.fmu import Fmu, run_model_exchange
from tests.fuzz.models.dynamics import END
from tests.fuzz.models.program import Program, random_program
from tests.fuzz.verdicts import Verdict

#: What rounding and cancellation may leave, of the size of the value.
_ROUNDING: Final = 1e-9
#: What the integrators may leave at a tolerance of 1e-9, of the size of the value: states move by up to 3/s.
_STATES: Final = {"Co-Simulation": 1e-6, "Model Exchange": 1e-5}
_TOLERANCE: Final = 1e-9


def trial(case: int) -> Verdict:
    """Carry out the trial of this number."""
    program = random_program(case)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "package.mo").write_text(program.text, "utf-8")
        try:
            version: Literal["2.0", "3.0"] = "2.0" if case % 2 else "3.0"
            built = build_fmu("R.M", folder, library=folder / "package.mo", fmi_version=version)
            wrong = _compared(program, built.path, Random(case))
        except UnsupportedModelError as error:
            return Verdict(case, "refused", str(error))
        except Exception:
            return Verdict(case, "fault", f"{program.text}\n{traceback.format_exc()}")
    return Verdict(case, "fault", f"{program.text}\n{wrong}") if wrong else Verdict(case, "right")


def _compared(program: Program, path: Path, random: Random) -> str:
    """What is wrong, or nothing."""
    end = END * random.uniform(0.9, 1.0)
    times = [end * i / 7 for i in range(8)]
    with Fmu(path) as fmu:
        # What the compiler had to evaluate, such as the size of an array, is a constant.
        known = fmu.description.variables
        settable = {n: v for n, v in program.parameters.items() if known[n].causality == "parameter"}
        for parameters in ({}, settable):
            expected = program.meaning.values(parameters, times)
            table = fmu.run(times, parameters=parameters, outputs=program.observed, tolerance=_TOLERANCE)
            wrong = _differences(program, expected, table, "Co-Simulation", parameters)
            wrong = wrong or _repeated(program, fmu, times, parameters, {} if parameters else settable, table)
            if wrong:
                return wrong
    table = run_model_exchange(
        path, times, parameters=settable, outputs=program.observed, tolerance=_TOLERANCE
    )
    return _differences(program, expected, table, "Model Exchange", parameters)


def _repeated(
    program: Program, fmu: Fmu, times: list[float], parameters: Any, others: Any, table: Any
) -> str:
    """What is wrong with a run after a reset, or after a restored state: they must give the same bits."""
    settings = {"parameters": parameters, "outputs": program.observed, "tolerance": _TOLERANCE}
    # One with other parameters in between, of which nothing may stay.
    fmu.run(times[:3], parameters=others, outputs=program.observed)
    again = fmu.run(times, **settings)
    if not again.equals(table):
        return f"Co-Simulation with {parameters}: another run after a reset\n{again.compare(table)}"
    half = len(times) // 2
    # No time is more than twice the one before: the points of the steps are exactly those of the run.
    with fmu.start(times[0], stop_time=times[-1], **settings) as live:
        for before, now in pairwise(times[: half + 1]):
            live.step(now - before)
        saved = live.save()
        for attempt in ("a run", "a restored state"):
            for number in range(half, len(times) - 1):
                live.step(times[number + 1] - times[number])
                for name in program.observed:
                    found, first = float(live.outputs[name]), float(table[name].iloc[number + 1])
                    if found != first:
                        where = f"{name} at {times[number + 1]}"
                        return f"{attempt} by steps with {parameters}: {where} is {found!r}, not {first!r}"
            live.restore(saved)
    return ""


def _differences(
    program: Program, expected: list[dict[str, Any]], table: Any, kind: str, parameters: Any
) -> str:
    bound = _STATES[kind] if program.moves else _ROUNDING
    for (_, row), values in zip(table.iterrows(), expected, strict=True):
        for name in program.observed:
            right, found = float(_value(values, name)), float(row[name])
            if not math.isclose(right, found, rel_tol=bound, abs_tol=bound * 10):
                return (
                    f"{kind} with {parameters}: {name} at {values['time']} is {found!r}, should be {right!r}"
                )
    return ""


def _value(values: dict[str, Any], name: str) -> Any:
    if name in values:
        return values[name]
    array, _, index = name.rstrip("]").partition("[")
    return values[array][int(index) - 1]
