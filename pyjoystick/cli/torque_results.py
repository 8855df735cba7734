"""Computation and output of ``pyjoystick torque``."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyjoystick import forced_motion, laboratory, model
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.joystick_choice import joystick_of

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion of either kind.

    Attributes:
        title: description for the report
        description: description for the JSON file
        shown: samples for the table and the figure
        measured_by: returns the samples for the numbers, given a joystick
        notes: remarks on a measured motion
    """

    title: str
    description: Mapping[str, object]
    shown: forced_motion.Samples
    measured_by: Callable[[model.JoystickParameters], forced_motion.Samples]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Result:
    """The torque with one damping law.

    Attributes:
        measures: peaks, work, shares and so on
        table: torque over time
        difference: largest difference between FMU and plain Python, relative to the largest value of the
            torque or part
    """

    measures: forced_motion.TorqueMeasures
    table: pd.DataFrame
    difference: float


def in_closed_form(motion: forced_motion.ForwardAndReturn, interval: float) -> Motion:
    """Make a motion in closed form; raises ParameterError for the interval."""
    degrees = math.degrees(motion.amplitude)
    title = (
        f"{degrees:.6g} deg in {motion.rise:g} s, {motion.dwell:g} s there, "
        f"back in {motion.return_time:g} s, {motion.shape}"
    )
    description = {"kind": "closed form", **asdict(motion), "fall": motion.return_time}
    shown = forced_motion.Samples.evenly(motion, interval)
    return Motion(title, description, shown, lambda joystick: forced_motion.Samples.of(joystick, motion))


def from_file(
    path: Path, chain: laboratory.Chain, columns: Mapping[str, str], units: Mapping[str, str]
) -> Motion:
    """Read a measured motion; raises RecordError, SeriesError."""
    found = forced_motion.read_motion(path, chain=chain, columns=columns, units=units)
    samples = found.samples
    how = f"angle filtered at {chain.low_pass.cutoff:g} Hz and differentiated" if found.differentiated else ""
    notes = tuple(f"{path}: {note}" for note in (*found.notes, how) if note)
    description = {"kind": "measured", "file": str(path), "differentiated": found.differentiated}
    return Motion(f"{path.name}, {samples.duration:.6g} s", description, samples, samples.refined, notes)


def joysticks_of(
    file: model.ParameterFile, damping: model.LawName | None, changes: Mapping[str, float]
) -> dict[model.LawName, model.JoystickParameters]:
    """Joysticks by damping law, that of the chosen law first.

    Without a choice these are all laws of the file or, if a parameter of the damping is changed, only the law
    chosen in the file.
    """
    first = joystick_of(damping, dict(changes), file)
    found = {model.law_name(first.damping): first}
    if damping is None and not any(name.startswith("damping.") for name in changes):
        found |= {law: file.with_law(law).replace(changes) for law in file.laws if law not in found}
    return found


def arm_of(file: model.ParameterFile, given: float | None) -> float:
    """Distance from the pivot to the hand (m): the given one, or else that of the file, or of Table 2."""
    if given is not None:
        return given
    return model.PIVOT_TO_TOP if file.pivot_to_top is None else file.pivot_to_top


def compute(
    motion: Motion, joysticks: Mapping[model.LawName, model.JoystickParameters], arm: float
) -> dict[model.LawName, Result]:
    """Compute the torque for every law with the inverse FMUs.

    Raises:
        ParameterError, FmuRunError: a value is not allowed
    """
    found = {}
    for law, joystick in joysticks.items():
        fmu = found_or_built(forced_motion.inverse_fmu(joystick.damping))
        samples = motion.measured_by(joystick)
        torque = forced_motion.torque_by_fmu(joystick, samples, fmu=fmu)
        found[law] = Result(
            forced_motion.measure(joystick, samples, torque, pivot_to_handle=arm),
            forced_motion.torque_by_fmu(joystick, motion.shown, fmu=fmu, pivot_to_handle=arm),
            _difference(torque, forced_motion.torque_by_reference(joystick, samples)),
        )
    return found


def text(motion: Motion, results: Mapping[model.LawName, Result]) -> str:
    """The report."""
    largest = max(result.difference for result in results.values())
    report = forced_motion.measures_report({law: result.measures for law, result in results.items()})
    return (
        f"Torque for {motion.title}\n\n{report}\n\n"
        f"Computed with the inverse FMUs; plain Python differs by at most {largest:.0e} of the largest value."
    )


def as_json(
    motion: Motion,
    joysticks: Mapping[model.LawName, model.JoystickParameters],
    results: Mapping[model.LawName, Result],
    notes: Sequence[str],
) -> str:
    """All results as JSON, in SI units."""
    return forced_motion.torque_json(
        motion.description,
        joysticks,
        {law: result.measures for law, result in results.items()},
        {law: result.difference for law, result in results.items()},
        notes,
    )


def _difference(found: pd.DataFrame, expected: pd.DataFrame) -> float:
    """Largest difference of the torque or a part of it, relative to the largest value of that part."""
    parts = [(found[name].to_numpy(), expected[name].to_numpy()) for name in forced_motion.TORQUES]
    return max(
        float(np.max(np.abs(one - other)) / np.max(np.abs(other))) if np.any(other) else 0.0
        for one, other in parts
    )
