"""What ``pyjoystick torque`` computes and how it is shown."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.options import DampingLaw, joystick_of
from pyjoystick.forced_motion import (
    TORQUES,
    ForwardAndReturn,
    Samples,
    TorqueMeasures,
    inverse_fmu,
    measure,
    measures_report,
    plot_torque,
    read_motion,
    torque_by_fmu,
    torque_by_reference,
    torque_table,
)
from pyjoystick.laboratory import Chain
from pyjoystick.model import PIVOT_TO_TOP, InverseTorque, JoystickParameters, LawName, ParameterFile, law_name
from pyjoystick.support import save_figure, versions


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion of either kind.

    Attributes:
        title: what it is, for people
        description: the same for programs
        shown: its samples for table and figure
        measured_by: its samples for the numbers, for a joystick
        notes: what is to be told of it
    """

    title: str
    description: Mapping[str, object]
    shown: Samples
    measured_by: Callable[[JoystickParameters], Samples]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Result:
    """The torque for one damping law.

    Attributes:
        measures: its numbers
        table: over time
        difference: between FMU and plain Python, in parts of the largest value of the torque or the part
    """

    measures: TorqueMeasures
    table: pd.DataFrame
    difference: float


def in_closed_form(motion: ForwardAndReturn, interval: float) -> Motion:
    """A motion that the options describe; raises ParameterError for the interval."""
    degrees = math.degrees(motion.amplitude)
    title = (
        f"{degrees:.6g} deg in {motion.rise:g} s, {motion.dwell:g} s there, "
        f"back in {motion.return_time:g} s, {motion.shape}"
    )
    description = {"kind": "closed form", **asdict(motion), "fall": motion.return_time}
    shown = Samples.evenly(motion, interval)
    return Motion(title, description, shown, lambda joystick: Samples.of(joystick, motion))


def from_file(path: Path, chain: Chain, columns: Mapping[str, str], units: Mapping[str, str]) -> Motion:
    """A measured motion; raises RecordError, SeriesError."""
    found = read_motion(path, chain=chain, columns=columns, units=units)
    samples = found.samples
    how = f"angle filtered at {chain.low_pass.cutoff:g} Hz and differentiated" if found.differentiated else ""
    notes = tuple(f"{path}: {note}" for note in (*found.notes, how) if note)
    description = {"kind": "measured", "file": str(path), "differentiated": found.differentiated}
    return Motion(f"{path.name}, {samples.duration:.6g} s", description, samples, lambda _: samples, notes)


def joysticks_of(
    file: ParameterFile, damping: DampingLaw | None, changes: Mapping[str, float]
) -> dict[LawName, JoystickParameters]:
    """The joysticks to compute with, that of the chosen law first.

    Without a choice both laws of the file count, unless a parameter of the damping is changed: then its own.
    """
    first = joystick_of(damping, dict(changes), file)
    found = {law_name(first.damping): first}
    if damping is None and not any(name.startswith("damping.") for name in changes):
        found |= {law: file.with_law(law).replace(changes) for law in file.laws if law not in found}
    return found


def arm_of(file: ParameterFile, given: float | None) -> float:
    """From the pivot to the hand (m): as given, as in the file, or Table 2's."""
    if given is not None:
        return given
    return PIVOT_TO_TOP if file.pivot_to_top is None else file.pivot_to_top


def compute(
    motion: Motion, joysticks: Mapping[LawName, JoystickParameters], arm: float
) -> dict[LawName, Result]:
    """The torque by the inverse FMUs, for every law.

    Raises:
        ParameterError, FmuRunError: a value is not allowed
    """
    found = {}
    for law, joystick in joysticks.items():
        fmu = found_or_built(inverse_fmu(joystick.damping))
        samples = motion.measured_by(joystick)
        torque = torque_by_fmu(joystick, samples, fmu=fmu)
        found[law] = Result(
            measure(joystick, samples, torque, pivot_to_handle=arm),
            torque_table(motion.shown, torque_by_fmu(joystick, motion.shown, fmu=fmu), pivot_to_handle=arm),
            _difference(torque, torque_by_reference(joystick, samples)),
        )
    return found


def text(motion: Motion, results: Mapping[LawName, Result]) -> str:
    """The report."""
    largest = max(result.difference for result in results.values())
    report = measures_report({law: result.measures for law, result in results.items()})
    return (
        f"Torque for {motion.title}\n\n{report}\n\n"
        f"By the inverse FMUs; plain Python differs by {largest:.0e} of the largest value at most."
    )


def as_json(motion: Motion, results: Mapping[LawName, Result]) -> str:
    """Everything in full, SI units."""
    content: dict[str, Any] = {
        "motion": dict(motion.description),
        "laws": {law: _measures(result) for law, result in results.items()},
        "made_with": dict(versions()),
    }
    return json.dumps(content, indent=2, allow_nan=False) + "\n"


def draw(results: Mapping[LawName, Result], path: Path) -> None:
    """Draw all laws into one figure; raises OutputFileError."""
    save_figure(plot_torque({law: result.table for law, result in results.items()}), path)


def _measures(result: Result) -> dict[str, Any]:
    measures = result.measures
    derived = {
        "work": measures.work,
        "loss": measures.loss,
        "peak_force": measures.peak_force,
        "difference_to_plain_python": result.difference,
    }
    return asdict(measures) | derived


def _difference(found: InverseTorque, expected: InverseTorque) -> float:
    parts = [(getattr(found, name), getattr(expected, name)) for name in TORQUES]
    return max(
        float(np.max(np.abs(one - other)) / np.max(np.abs(other))) if np.any(other) else 0.0
        for one, other in parts
    )
