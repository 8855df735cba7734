"""Sorting of records and parameters by content, so that the given order has no effect.

Rounding errors of sums depend on the order, and a search along a flat valley amplifies them.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np

from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.identification.fitting.result import Fit


def ordered_records(records: Sequence[Measurement]) -> list[Measurement]:
    """Sort the records by their samples; equal ones are interchangeable."""

    def content(record: Measurement) -> tuple[bytes, ...]:
        series = (record.columns[name].tobytes() for name in sorted(record.columns))
        return record.time.tobytes(), *series

    return sorted(records, key=content)


def ordered_settings(settings: FitSettings) -> FitSettings:
    """Sort the free parameters of the settings by name."""
    return dataclasses.replace(settings, free=tuple(sorted(settings.free, key=lambda one: one.name)))


def as_given(found: Fit, settings: FitSettings, names: Sequence[str]) -> Fit:
    """Restore the given order of variables and records in a fit.

    Args:
        found: fit in the order of `ordered_records` and `ordered_settings`
        settings: as given
        names: names of the records, as given
    """
    records = [one.name for one in found.records]
    free = [one.name for one in settings.free]
    number = [names.index(name) for name in records]
    variables = [
        one if one.record is None else dataclasses.replace(one, record=number[one.record])
        for one in found.variables
    ]
    places = sorted(
        range(len(variables)), key=lambda j: (free.index(variables[j].name), variables[j].record or 0)
    )
    errors, steps, drawn = found.standard_errors, found.steps, found.bootstrap
    both = np.ix_(places, places)
    tied = list(settings.ties)
    return dataclasses.replace(
        found,
        settings=settings,
        variables=tuple(variables[j] for j in places),
        x=found.x[places],
        standard_errors=dataclasses.replace(
            errors,
            errors=errors.errors[places],
            covariance=errors.covariance[both],
            correlation=errors.correlation[both],
        ),
        intervals=found.intervals[places],
        derived=tuple(
            dataclasses.replace(one, slope=one.slope[places])
            for one in sorted(
                found.derived,
                key=lambda one: (names.index(one.record) if one.record else 0, tied.index(one.name)),
            )
        ),
        minima=tuple(dataclasses.replace(one, x=one.x[places]) for one in found.minima),
        identifiability=dataclasses.replace(
            found.identifiability, undetermined=found.identifiability.undetermined[places]
        ),
        records=tuple(found.records[records.index(name)] for name in names),
        steps=dataclasses.replace(steps, steps=steps.steps[places], errors=steps.errors[places]),
        profiles={
            place: dataclasses.replace(found.profiles[j], variable=place)
            for place, j in enumerate(places)
            if j in found.profiles
        },
        bootstrap=drawn and dataclasses.replace(drawn, fits=drawn.fits[:, places]),
    )
