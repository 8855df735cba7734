"""A fit as JSON."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

from pyjoystick.identification.fitting.result import Fit, RecordFit
from pyjoystick.identification.fitting.settings_file import as_document
from pyjoystick.support import document_text


def as_json(fit: Fit, notes: Sequence[str] = ()) -> str:
    """The result with the notes on its records as JSON text, formatted by `document_text`."""
    document = {
        "trusted": fit.trusted,
        "interrupted": fit.interrupted,
        "parameters": [_parameter(fit, j) for j in range(len(fit.variables))],
        "tied": [
            {"name": one.name, "record": one.record or None, "value": one.value, "standard_error": one.error}
            for one in fit.derived
        ],
        "correlation": fit.standard_errors.correlation,
        "sum_of_squares": fit.cost,
        "degrees_of_freedom": fit.standard_errors.degrees_of_freedom,
        "criteria": None if fit.criteria is None else fit.criteria._asdict(),
        "identifiability": {
            "singular_values": fit.identifiability.singular_values,
            "condition": fit.identifiability.condition,
            "rank": fit.identifiability.rank,
            "open": list(fit.identifiability.sentences),
            "weakest": fit.identifiability.weakest,
        },
        "minima": [
            {"x": one.x, "sum_of_squares": one.cost, "searches": one.found, "converged": one.converged}
            for one in fit.minima
        ],
        "checks": [{"name": c.name, "passed": c.passed, "message": c.message} for c in fit.checks],
        "unseen": [one._asdict() for one in fit.unseen],
        "records": [_record(one) for one in fit.records],
        "noise_correlation": fit.correlation,
        "derivatives": dataclasses.asdict(fit.steps),
        "runs": fit.runs,
        "seconds": fit.seconds,
        "settings": as_document(fit.settings),
    }
    return document_text("fit", document, notes)


def _record(one: RecordFit) -> dict[str, Any]:
    return {
        "name": one.name,
        "noise": one.sigma,
        "torque_noise": one.torque_noise,
        "labels": one.labels,
        "times": one.times,
        "data": one.data,
        "fit": one.predicted,
        "fit_error": one.errors,
        "curve": None if one.curve is None else {"time": one.curve.index, **one.curve.to_dict("list")},
    }


def _parameter(fit: Fit, place: int) -> dict[str, Any]:
    variable = fit.variables[place]
    profile = fit.profiles.get(place)
    found: dict[str, Any] = {
        "name": variable.name,
        "record": None if variable.record is None else fit.records[variable.record].name,
        "unit": variable.unit,
        "value": fit.x[place],
        "standard_error": fit.standard_errors.errors[place],
        "interval": fit.intervals[place],
        "determined": not bool(fit.identifiability.undetermined[place]),
    }
    if profile is not None:
        found["profile"] = {
            "interval": profile.interval,
            "values": profile.values,
            "distances": profile.distances,
            "at_bound": profile.bounded,
            "undercut": profile.lower,
            "followed": profile.converged,
        }
    if fit.bootstrap is not None and len(fit.bootstrap.fits) > 1:
        found["bootstrap_error"] = fit.bootstrap.errors()[place]
        found["bootstrap_interval"] = fit.bootstrap.intervals(fit.settings.uncertainty.level)[place]
    return found
