"""Check of a design by simulation: fits of synthetic records."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy import stats

from pyjoystick.identification.design.choice import Design
from pyjoystick.identification.design.experiment import PlannedFit
from pyjoystick.identification.fitting.fit import fit
from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.support import FloatArray, ParameterError, whole_number


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """Results of fits to synthetic sets of records.

    Attributes:
        names: the parameters
        found: their fitted values, in the units of the FMU, shape (sets, parameters)
        ratios: root mean square deviation from the true values divided by the predicted standard error,
            shape (parameters,); close to 1 if the prediction is right
    """

    names: tuple[str, ...]
    found: FloatArray
    ratios: FloatArray

    @property
    def sets(self) -> int:
        """Number of sets."""
        return len(self.found)

    @property
    def bounds(self) -> tuple[float, float]:
        """Limits that contain 95 % of the ratios if the prediction is right, for this number of sets."""
        low, high = (float(stats.chi2.ppf(tail, self.sets)) / self.sets for tail in (0.025, 0.975))
        return math.sqrt(low), math.sqrt(high)


def try_design(
    design: Design,
    planned: PlannedFit,
    *,
    sets: int,
    seed: int = 0,
    on_progress: Callable[[int, int], None] | None = None,
) -> Trial:
    """Fit synthetic records with normal noise, and compare the scatter with the prediction of the design.

    Prior knowledge enters neither the fits nor the prediction.

    Args:
        design: the experiments, from `best_design`
        planned: the fit that they were chosen for
        sets: number of sets of records
        seed: seed of the noise
        on_progress: called with the number of finished sets and the number of all sets

    Raises:
        ParameterError: fewer than two sets, or several release angles, which the fit does not find
        FitError, FmuRunError: a fit cannot be set up, or a run fails
    """
    whole_number("sets", sets, 2)
    design = Design(design.informations, design.counts, np.zeros_like(design.prior))
    angles = {
        one.experiment.release_angle
        for one, count in zip(design.informations, design.counts, strict=True)
        if count
    }
    settings = planned.settings_from(min(angles))
    if settings is not planned.settings and len(angles) > 1:
        raise ParameterError("theta_start", "not fitted", "free, because the releases have several angles")
    random = np.random.default_rng(seed)
    found = []
    for done in range(sets):
        records = [
            _noisy(one.clean, f"{one.experiment.name}, {repeat + 1}", planned.sigma, random)
            for one, count in zip(design.informations, design.counts, strict=True)
            for repeat in range(count)
        ]
        result = fit(records, settings, fmu=planned.fmu)
        found.append([result.value(name) for name in design.names])
        if on_progress is not None:
            on_progress(done + 1, sets)
    deviations = (np.array(found) - design.values) / design.errors
    return Trial(design.names, np.array(found), np.sqrt(np.mean(deviations**2, axis=0)))


def _noisy(
    clean: Measurement, name: str, sigma: Mapping[str, float], random: np.random.Generator
) -> Measurement:
    columns = {
        column: series + (random.normal(0.0, sigma[column], len(series)) if column in sigma else 0.0)
        for column, series in clean.columns.items()
    }
    return Measurement(name, clean.time, columns)


def trial_sentence(trial: Trial) -> str:
    """The ratios as a sentence, with the range expected by chance."""
    ratios = ", ".join(f"{name} {ratio:.2f}" for name, ratio in zip(trial.names, trial.ratios, strict=True))
    low, high = trial.bounds
    return (
        f"scatter of {trial.sets} fitted synthetic sets over the predicted standard errors: {ratios} "
        f"({low:.2f} to {high:.2f} is chance)"
    )
