"""Model selection: information criteria, and prediction of records left out."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from pyjoystick.fmu import Fmu
from pyjoystick.identification.fitting.fit import fit
from pyjoystick.identification.fitting.problem.instrument import INSTRUMENT
from pyjoystick.identification.fitting.problem.measurement import Measurement, measurements
from pyjoystick.identification.fitting.problem.settings import FitSettings, Uncertainty
from pyjoystick.identification.fitting.result import Fit
from pyjoystick.motion import Record
from pyjoystick.support import ParameterError, TextTable


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """One of several models of the same records.

    Attributes:
        name: name of the model
        fit: its fit to all records
        prediction_error: root mean square error for samples of records left out, in the unit of the output;
            NaN if there was only one record
    """

    name: str
    fit: Fit
    prediction_error: float


def compare_models(
    records: Iterable[Record | Measurement],
    models: Mapping[str, FitSettings],
    *,
    on_progress: Callable[[str, int, int], None] | None = None,
) -> tuple[Candidate, ...]:
    """Fit several models to the same records, and leave each record out in turn.

    The shared parameters are fitted to the other records; of the record left out, only its own numbers, such
    as the release, are fitted, so that its residuals are prediction errors.

    Args:
        records: measured records
        models: settings by name; all compare trajectories of the same output
        on_progress: called with the model, the number of finished fits and of all fits

    Raises:
        ParameterError: there is no model, or the models compare different things
        FitError: and other errors, as `fit` does
    """
    measured = measurements(records)
    if not models or len({(one.comparison, one.outputs) for one in models.values()}) != 1:
        raise ParameterError("models", ", ".join(models), "one or more that compare the same outputs")
    if any(one.comparison != "trajectory" or len(one.outputs) != 1 for one in models.values()):
        raise ParameterError("models", ", ".join(models), "on the trajectory of one output")
    found = []
    for name, settings in models.items():
        with Fmu(settings.fmu) as fmu:
            whole = fit(measured, settings, fmu=fmu)
            errors = []
            for left_out in range(len(measured) if len(measured) > 1 else 0):
                if on_progress is not None:
                    on_progress(name, left_out, len(measured))
                errors.append(_prediction_error(measured, left_out, settings, whole, fmu))
        mean_square = float(np.mean(np.square(errors))) if errors else math.nan
        found.append(Candidate(name, whole, math.sqrt(mean_square)))
    return tuple(found)


def _prediction_error(
    records: Sequence[Measurement], left_out: int, settings: FitSettings, whole: Fit, fmu: Fmu
) -> float:
    """Root mean square residual of one record, with shared parameters from the others."""
    # A single search, from the result of the fit to all records.
    once = dataclasses.replace(settings.search, starts=1, stages=(), exchanges=())
    quick = dataclasses.replace(settings, search=once, uncertainty=Uncertainty(profiles=()))
    begun = tuple(
        dataclasses.replace(one, start=whole.value(one.name)) if not one.per_record else one
        for one in quick.free
    )
    others = [record for k, record in enumerate(records) if k != left_out]
    trained = fit(others, dataclasses.replace(quick, free=begun), fmu=fmu)
    own = tuple(one for one in quick.free if one.per_record)
    if not own:
        raise ParameterError("free", "no parameter of its own for each record", "one or more per_record")
    if any(one.record for one in trained.derived):
        raise ParameterError(
            "ties", ", ".join(quick.ties), "between shared parameters where models are compared"
        )
    known = {*fmu.description.variables, *INSTRUMENT}
    shared = {name: value for name, value in trained.shared().items() if name in known}
    fixed = {**quick.fixed, **shared, **{one.name: one.value for one in trained.derived}}
    noise = quick.noise if quick.noise.sigma else dataclasses.replace(quick.noise, per_record=False)
    alone = dataclasses.replace(quick, free=own, fixed=fixed, ties={}, noise=noise)
    predicted = fit([records[left_out]], alone, fmu=fmu).records[0]
    return float(np.sqrt(np.mean(predicted.residuals() ** 2)))


def comparison_table(candidates: Sequence[Candidate]) -> str:
    """Table of AICc, BIC and prediction error of each model in Markdown; criteria relative to the best."""
    rows = []
    criteria = [one.fit.criteria for one in candidates]
    best_aicc = min(one.aicc for one in criteria if one is not None)
    best_bic = min(one.bic for one in criteria if one is not None)
    for candidate, one in zip(candidates, criteria, strict=True):
        if one is not None:
            residuals = np.concatenate([record.residuals() for record in candidate.fit.records])
            rows.append(
                [
                    candidate.name,
                    str(one.parameters),
                    f"{one.aicc - best_aicc:.1f}",
                    f"{one.bic - best_bic:.1f}",
                    f"{np.sqrt(np.mean(residuals**2)):.4g}",
                    f"{candidate.prediction_error:.4g}",
                ]
            )
    header = [
        "model",
        "parameters",
        "AICc above best",
        "BIC above best",
        "rms of fit",
        "rms of records left out",
    ]
    return TextTable(header, rows).markdown()
