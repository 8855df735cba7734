"""``pyjoystick design``."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Final

import numpy as np
import typer

from pyjoystick import fmu, identification, model, motion, runs, support
from pyjoystick.cli import joystick_choice, options, parsing
from pyjoystick.cli.console import (
    output,
    print_note,
    print_warning,
    progress_bar,
    progress_console,
    write_json,
    write_plot,
)
from pyjoystick.cli.fit import settings_of
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.support import FloatArray, check_outputs

#: Candidate release angles (deg), on both sides.
_ANGLES: Final = (1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0)
#: Part of a torque's integral that sampling may change without a warning.
_MOST_LOST: Final = 0.05
#: Most samples of an experiment.
_MOST_SAMPLES: Final = 1_000_000
EXAMPLES: Final = """
Examples:

    pyjoystick design --parameters joystick.toml --free J --plot design.png

    pyjoystick design -p joystick.toml --determine damping.C --records 6 --rate 240 --noise 0.05deg --check 30

    pyjoystick design -p joystick.toml --torque strokes.csv --torque sine.csv

A torque is a CSV file with the columns time (s) and T (N.m), as it would be applied to the joystick at rest;
its first row is the beginning of the motion.
"""


def run(
    parameters: options.Parameters = None,
    settings_file: Annotated[
        Path | None,
        typer.Option("--settings", metavar="FILE", help="TOML file with the settings of the planned fit."),
    ] = None,
    damping: options.Law = None,
    assignments: options.Set = None,
    free: Annotated[
        list[str] | None,
        typer.Option(
            "--free", metavar="NAME", help="Parameter to fit in addition to the damping; repeatable."
        ),
    ] = None,
    determine: Annotated[
        str | None,
        typer.Option(
            "--determine",
            metavar="NAME",
            help="Parameter to determine best. Default: all parameters together (D-optimal).",
        ),
    ] = None,
    records: Annotated[
        int, typer.Option("--records", "-n", metavar="N", min=1, max=100, help="Number of records.")
    ] = 4,
    angles: Annotated[
        list[str] | None,
        typer.Option(
            "--angle",
            "-a",
            metavar="ANGLE",
            help="Release angle to choose from; repeatable. Default: 1 to 20 degrees on both sides.",
        ),
    ] = None,
    torques: Annotated[
        list[Path] | None,
        typer.Option("--torque", metavar="FILE.csv", help="Driving torque to choose from; repeatable."),
    ] = None,
    rate: Annotated[float, typer.Option("--rate", metavar="HZ", help="Sampling rate.")] = 60.0,
    duration: Annotated[
        float, typer.Option("--duration", "-d", metavar="SECONDS", help="Length of a release.")
    ] = 1.5,
    noise: Annotated[
        str, typer.Option("--noise", metavar="ANGLE", help="Noise of the angle (standard deviation).")
    ] = "0.1deg",
    check: Annotated[
        int | None,
        typer.Option(
            "--check",
            metavar="SETS",
            min=2,
            help="Check the best choice with fits of this many sets of synthetic records.",
        ),
    ] = None,
    json: Annotated[Path | None, options.json("the designs and their standard errors")] = None,
    plot: Annotated[Path | None, options.plot("the standard errors over the release angle")] = None,
) -> None:
    """Find the releases or torques that determine the parameters best, before they are measured.

    The standard errors follow from the derivatives of the FMU's motion (Fisher information). Uncertainties in
    the parameter file count as prior knowledge of the fitted parameters.
    """
    check_outputs(json, plot)
    file = joystick_choice.parameter_file(parameters)
    joystick = joystick_choice.joystick_of(damping, parsing.parse_assignments(assignments, "--set"), file)
    settings = _settings(settings_file, joystick, free or (), driven=bool(torques))
    sigma = {"theta": parsing.parse_angle(noise, "--noise")} | dict(settings.noise.sigma)
    with fmu.Fmu(found_or_built(settings.fmu)) as opened:
        experiments = _experiments(angles, torques, rate, duration, settings, opened.description)
        planned = identification.PlannedFit(settings, joystick.to_names(), sigma, opened)
        with progress_console().status("computing the information of each experiment"):
            found = [planned.information(one) for one in experiments]
        # The settings override the file and are not merged with it: both may contain the same measurement.
        known = _known(file, found[0].names, joystick) | planned.uncertainties
        best = identification.best_design(found, records, determine=determine, uncertainties=known)
        rows = {f"the best {records}": best} | _others(best, planned, rate, duration)
        trial = _tried(best, planned, check)
    output().print(identification.chosen_experiments(best), markup=False)
    output().print(identification.design_table(rows), markup=False)
    if trial is not None:
        output().print(identification.trial_sentence(trial), markup=False)
    write_json(json, lambda notes: identification.design_json(rows, trial, notes))
    write_plot(plot, lambda: identification.plot_design(best))


def _settings(
    file: Path | None, joystick: model.JoystickParameters, free: Sequence[str], *, driven: bool
) -> identification.FitSettings:
    settings = settings_of(file, model.law_name(joystick.damping))
    if file is None:
        fmu = runs.fmu_with_parts(settings.fmu, joystick)
        settings = dataclasses.replace(settings, fmu=fmu)
    more = tuple(identification.Free(name) for name in free)
    settings = dataclasses.replace(settings, free=(*more, *settings.free))
    if driven and not settings.inputs:
        # As in `fit --driven`; the start is known, and J is fitted if --free names it.
        delay = identification.Free(identification.DELAY, start=0.0, minimum=-0.05, maximum=0.05)
        zero = identification.Free(identification.ZERO_OFFSET, per_record=True)
        shared = tuple(one for one in settings.free if not one.per_record)
        settings = dataclasses.replace(settings, free=(*shared, delay, zero), inputs=("T",))
    if settings.inputs and not driven:
        raise typer.BadParameter(
            f"says that {', '.join(settings.inputs)} drives the joystick: offer torques with --torque, or "
            "plan releases with settings without inputs",
            param_hint="--settings",
        )
    return settings


def _experiments(
    angles: Sequence[str] | None,
    torques: Sequence[Path] | None,
    rate: float,
    duration: float,
    settings: identification.FitSettings,
    description: fmu.FmuDescription,
) -> list[identification.Experiment]:
    """Candidate releases or torques; torques act on the joystick at rest in the middle."""
    support.positive("--rate", rate, "Hz"), support.positive("--duration", duration, "s")
    if rate * duration > _MOST_SAMPLES:
        allowed = f"at most {_MOST_SAMPLES} samples, {_MOST_SAMPLES / duration:.6g} Hz for {duration:g} s"
        raise support.ParameterError("--rate", rate, allowed)
    if not torques:
        given = [parsing.parse_angle(text, "--angle") for text in angles or ()]
        given = given or [math.radians(sign * angle) for angle in _ANGLES for sign in (-1.0, 1.0)]
        return [identification.Experiment.release(one, rate=rate, duration=duration) for one in given]
    parsing.refuse_given("is for releases: leave --torque out", {"--angle": angles})
    found = []
    for path in torques:
        table = fmu.read_inputs(path, description)
        # The joystick is at rest when the file starts, at any clock time.
        since = table.index.to_numpy(dtype=np.float64) - float(table.index[0])
        if not 0.0 < since[-1] * rate <= _MOST_SAMPLES:
            reason = f"lasts {since[-1]:g} s"
            allowed = f"at {rate:g} Hz, a torque lasts up to {_MOST_SAMPLES / rate:g} s"
            raise motion.RecordError(str(path), reason, allowed, column="time")
        for name in settings.inputs:
            advice = "check its unit"
            motion.require_plausible_load(path, name, table[name].to_numpy(), name, advice)
        time = np.arange(math.floor(since[-1] * rate) + 1) / rate
        series = {name: np.interp(time, since, table[name]) for name in settings.inputs}
        for name, sampled in series.items():
            _tell_of_lost(path, name, since, table[name].to_numpy(), np.interp(since, time, sampled), rate)
        found.append(identification.Experiment(path.stem, time, inputs=series))
    return found


def _tell_of_lost(
    path: Path, name: str, time: FloatArray, given: FloatArray, sampled: FloatArray, rate: float
) -> None:
    """Note a torque of which much lies between the samples: a record has it at the rate of the motion."""
    lost, whole = (float(np.trapezoid(np.abs(one), time)) for one in (given - sampled, given))
    if lost > _MOST_LOST * whole:
        change = f"{name} differs from the file by {100.0 * lost / whole:.2g} %"
        print_warning(f"{path}: sampled at {rate:g} Hz, {change}: choose a --rate that resolves it")


def _known(
    file: model.ParameterFile, names: Sequence[str], joystick: model.JoystickParameters
) -> dict[str, float]:
    """Standard uncertainties of the fitted parameters from the file, by FMU name."""
    law = model.law_name(joystick.damping)
    places = {one.name: one.uncertainty or 0.0 for one in model.fmu_values(file, law)}
    known = {name: places[name] for name in names if places.get(name, 0.0) > 0.0}
    if known:
        print_note(f"taken as known with the uncertainty of {file.path}: {', '.join(known)}")
    return known


def _others(
    best: identification.Design, planned: identification.PlannedFit, rate: float, duration: float
) -> dict[str, identification.Design]:
    """Alternatives with the same experiments."""
    total = int(np.sum(best.counts))
    found = {f"the same {total}, each twice": best.with_counts(2 * best.counts)}
    chosen = [one.experiment for one, count in zip(best.informations, best.counts, strict=True) if count]
    counts = best.counts[best.counts > 0]
    if not any(one.inputs for one in chosen):
        for label, changed in (
            ("the same at twice the rate", {"rate": 2.0 * rate, "duration": duration}),
            ("the same, twice as long", {"rate": rate, "duration": 2.0 * duration}),
        ):
            told = [
                planned.information(identification.Experiment.release(one.release_angle, **changed))
                for one in chosen
            ]
            found[label] = identification.Design(tuple(told), counts, best.prior)
    largest = int(np.argmax([abs(one.experiment.release_angle) for one in best.informations]))
    if best.counts[largest] != total and best.informations[largest].experiment.release_angle != 0.0:
        alone = np.zeros(len(best.counts), dtype=np.intp)
        alone[largest] = total
        found[f"{total} x {best.informations[largest].experiment.name}"] = best.with_counts(alone)
    return found


def _tried(
    best: identification.Design, planned: identification.PlannedFit, sets: int | None
) -> identification.Trial | None:
    if sets is None:
        return None
    with progress_bar() as bar:
        task = bar.add_task("fitting synthetic records", total=sets)
        return identification.try_design(
            best, planned, sets=sets, on_progress=lambda done, _: bar.update(task, completed=done)
        )
