"""Candidate experiments, and the information that each would give on the parameters of a fit."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import Fmu, Value
from pyjoystick.identification.fitting.problem.difference_steps import choose_steps
from pyjoystick.identification.fitting.problem.known_values import with_values
from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.identification.fitting.problem.settings import FitSettings, Noise
from pyjoystick.identification.fitting.problem.setup import make_problem
from pyjoystick.support import FloatArray, ParameterError, angle, increasing_times, positive

#: Default time from the start of a record to the release (s).
HOLD: Final = 0.25
_START: Final = "theta_start"
#: Tolerance of the FMU's integrator; tight, because differences are taken.
_TOLERANCE: Final = 1e-10


@dataclass(frozen=True, slots=True, eq=False)
class Experiment:
    """A record that could be made.

    Attributes:
        name: name in reports
        time: sample times (s), shape (n,); the motion starts at 0
        release_angle: angle from which the joystick starts at rest (rad)
        inputs: series that drive inputs of the FMU, by name, shape (n,) each; if empty, the joystick is
            held until its release at 0

    Raises:
        ParameterError: the times do not increase, or the angle is pi/2 or more
    """

    name: str
    time: FloatArray
    release_angle: float = 0.0
    inputs: Mapping[str, FloatArray] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "time", increasing_times(self.time))
        angle("release_angle", self.release_angle)

    @classmethod
    def release(cls, release_angle: float, *, rate: float, duration: float, hold: float = HOLD) -> Experiment:
        """Make a free oscillation.

        Args:
            release_angle: release angle (rad), not zero
            rate: sampling rate (Hz)
            duration: from the release to the end of the record (s)
            hold: from the start of the record to the release (s)

        Raises:
            ParameterError: a number is not above 0, or the angle is 0, or pi/2 or more
        """
        positive("rate", rate), positive("duration", duration)
        if release_angle == 0.0:
            raise ParameterError("release_angle", 0.0, "not zero: a joystick at rest there does not move")
        first, last = -math.floor(hold * rate), math.floor(duration * rate)
        time = np.arange(first, last + 1) / rate
        return cls(f"release from {math.degrees(release_angle):g} degrees", time, release_angle)


@dataclass(frozen=True, slots=True, eq=False)
class Information:
    """The Fisher information that one record of an experiment gives on the shared parameters.

    Attributes:
        experiment: the experiment
        names: the parameters, in the order of the matrix
        values: their values, in the units of the FMU, shape (n,)
        matrix: Fisher information, in the reciprocals of these units squared, shape (n, n); the record's own
            numbers, such as its release, are treated as unknown
        clean: the record without noise
        units: units of the parameters, empty for pure numbers
    """

    experiment: Experiment
    names: tuple[str, ...]
    values: FloatArray
    matrix: FloatArray
    clean: Measurement
    units: tuple[str, ...] = ()


class PlannedFit:
    """The planned fit: its free parameters, the joystick as known so far, and the noise.

    Attributes:
        settings: settings of the fit, which starts at the known values and knows the noise
        uncertainties: standard uncertainties that the settings give, by name; pass them to `best_design`,
            because they count once for the whole design and not once per record
        values: the joystick's parameters by name, in the units of the FMU
        sigma: standard deviation of the noise by output, in its unit
        fmu: the FMU of the settings
    """

    def __init__(
        self, settings: FitSettings, values: Mapping[str, Value], sigma: Mapping[str, float], fmu: Fmu
    ) -> None:
        """Check that the fit can be planned.

        Raises:
            ParameterError: peaks are compared, no parameter is shared by all records, or an output has no
                noise
        """
        if settings.comparison != "trajectory":
            raise ParameterError("comparison", settings.comparison, "'trajectory'")
        if all(one.per_record for one in settings.free):
            allowed = "a parameter that all records share"
            raise ParameterError("free", "what each record has by itself", allowed)
        noise = Noise(
            sigma={name: positive(f"noise of {name}", sigma.get(name, 0.0)) for name in settings.outputs}
        )
        settings = with_values(settings, values, replace_starts=True)
        self.uncertainties = {
            one.name: one.uncertainty for one in settings.free if one.uncertainty is not None
        }
        alone = tuple(dataclasses.replace(one, uncertainty=None) for one in settings.free)
        self.settings = dataclasses.replace(settings, free=alone, noise=noise)
        self.values = dict(values)
        self.sigma = dict(sigma)
        self.fmu = fmu

    def information(self, experiment: Experiment) -> Information:
        """Information of one record of an experiment, from the derivatives of the FMU's outputs.

        It is J^T J, where J holds the derivatives of all samples with respect to the shared parameters, in
        standard deviations of the noise, with the record's own unknowns projected out.

        Raises:
            FitError, FmuRunError: a run fails
        """
        clean = self._clean(experiment)
        settings = dataclasses.replace(self.settings_from(experiment.release_angle), tolerance=_TOLERANCE)
        problem = make_problem([clean], settings, self.fmu)
        variables = problem.variables
        x = np.array(
            [
                experiment.release_angle
                if one.name == _START
                else 0.0
                if one.of_instrument
                else float(self.values.get(one.name, one.start))
                for one in variables.free
            ]
        )
        x = np.clip(x, variables.lower, variables.upper)
        problem = dataclasses.replace(problem, steps=choose_steps(problem.model, x).steps)
        jacobian = problem.jacobian(x)
        shared = np.array([one.record is None for one in variables.free])
        own, rest = jacobian[:, ~shared], jacobian[:, shared]
        if own.size:
            lengths = np.linalg.norm(own, axis=0)
            own = own / np.where(lengths > 0.0, lengths, 1.0)
            rest = rest - own @ np.linalg.lstsq(own, rest, rcond=1e-10)[0]
        own_names, units = zip(
            *((one.name, one.unit) for one in variables.free if one.record is None), strict=True
        )
        return Information(experiment, own_names, x[shared], rest.T @ rest, clean, units)

    def settings_from(self, release_angle: float) -> FitSettings:
        """Settings for records that all start at this angle (rad), unless the angle is fitted."""
        if any(one.name == _START for one in self.settings.free):
            return self.settings
        fixed = dict(self.settings.fixed) | {_START: release_angle}
        return dataclasses.replace(self.settings, fixed=fixed)

    def _clean(self, experiment: Experiment) -> Measurement:
        """The record without noise, held at its start values until the motion starts."""
        inputs = dict(experiment.inputs)
        time = np.union1d([0.0], experiment.time[experiment.time > 0.0])
        own = {name: one for name, one in self.values.items() if name in self.fmu.description.variables}
        run = self.fmu.run(
            time,
            parameters=own | {_START: experiment.release_angle},
            inputs=pd.DataFrame(inputs, index=experiment.time) if inputs else None,
            outputs=self.settings.outputs,
            tolerance=_TOLERANCE,
        )
        at = np.searchsorted(time, np.maximum(experiment.time, 0.0))
        columns = {name: run[name].to_numpy()[at] for name in self.settings.outputs}
        return Measurement(experiment.name, experiment.time, columns | inputs)
