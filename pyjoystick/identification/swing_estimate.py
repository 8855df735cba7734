"""Rough estimates of moment of inertia and damping from the swings of releases, without a start value.

Springs and weight determine the potential energy of the joystick. If only J is unknown, the time from peak to
peak determines it: without damping, the period is proportional to the square root of J. The energy lost from
the first peak to the last, apart from dry friction, is C times the integral of omega^2, which also follows
from the energy.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from pyjoystick.identification.fitting.problem.measurement import Measurement
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.model import (
    JoystickParameters,
    NoOscillationError,
    contact_travel,
    energy,
    undamped_oscillation,
)
from pyjoystick.motion import Record, find_swings
from pyjoystick.support import FloatArray, ParameterError

#: Peaks below this part of the largest are ignored: they are short compared with the sampling interval, and
#: shifted by an offset of the zero.
_SMALLEST: Final = 0.2
_MOST_PEAKS: Final = 9
#: Lower limit of C, as a part of the C that would explain the loss of energy without dry friction.
_VISCOUS: Final = 0.05
#: A start value that differs by less than this factor leads to the same minimum, and is kept.
_NEAR: Final = 3.0
#: Relative difference between the J of a joystick and its estimate from which on there is a note.
_DOUBTFUL: Final = 0.25
_POINTS: Final = 400


@dataclass(frozen=True, slots=True)
class SwingEstimate:
    """Rough estimates from the swings of releases, accurate to about 10 %: J (kg m2) and C (N m s/rad)."""

    J: float
    C: float


def swing_estimate(
    joystick: JoystickParameters, records: Sequence[Record | Measurement], *, inertia: float | None = None
) -> SwingEstimate | None:
    """Estimate J and C from releases, given the springs, the weight and the dry friction of a joystick.

    Args:
        joystick: the joystick; its J and its damping are not used
        records: releases; other records have no swings and are ignored
        inertia: J (kg m2) if it is known; only C is then estimated

    Returns:
        the estimates; None if no record shows two swings of this joystick after its release, if the springs
            do not make it oscillate, or if the swings lose no energy
    """
    seen = [found for found in map(_peaks, records) if found is not None]
    try:
        times = [_times(joystick, heights) for _, heights in seen]
    except (NoOscillationError, ParameterError):
        return None
    if not seen:
        return None
    lasted = sum(float(np.sum(time[2:] - time[:-2])) for time, _ in seen)
    if inertia is None:
        inertia = joystick.J * (lasted / sum(times)) ** 2
    swung = dataclasses.replace(joystick, J=inertia)
    lost = sum(float(np.diff(energy(swung, heights[[-1, 0]], 0.0))[0]) for _, heights in seen)
    squares = sum(_squares(swung, heights) for _, heights in seen)
    rubbed = sum(_rubbed(joystick, heights) for _, heights in seen)
    if not (lost > 0.0 and squares > 0.0):
        return None
    return SwingEstimate(inertia, max(lost - rubbed, _VISCOUS * lost) / squares)


def inertia_doubts(joystick: JoystickParameters, records: Sequence[Record]) -> tuple[str, ...]:
    """Return a note if releases contradict the J of a joystick, to which the C from peaks is proportional."""
    found = swing_estimate(joystick, records)
    if found is None or abs(joystick.J / found.J - 1.0) < _DOUBTFUL:
        return ()
    return (
        f"with these springs, the periods of the swings require J = {found.J:.3g} kg m2, but the joystick "
        f"has {joystick.J:.3g}; the C from peaks is proportional to J: are these J and springs its own?",
    )


def with_estimated_starts(
    settings: FitSettings, joystick: JoystickParameters, records: Sequence[Record | Measurement]
) -> FitSettings:
    """Replace start values of J and C that are far from the estimates of `swing_estimate` by these estimates.

    A search that starts from the J or C of another joystick, whose motion has a different number of swings or
    none, may end in a minimum at which nothing fits.

    Args:
        settings: settings that start from the values of the joystick; start values that count as measured are
            kept
        joystick: joystick with the values of all parameters that are not fitted
        records: releases; for other records, the settings are returned unchanged
    """
    names = [one.name for one in settings.free if one.uncertainty is None and not one.per_record]
    if settings.inputs or not {"J", "damping.C"} & set(names):
        return settings
    known = None if "J" in names else joystick.J
    found = swing_estimate(joystick, records, inertia=known)
    if found is None:
        return settings
    values = joystick.to_names()
    far = {
        name: value
        for name, value in (("J", found.J), ("damping.C", found.C))
        if name in names and name in values and not 1.0 / _NEAR < values[name] / value < _NEAR
    }
    free = tuple(one.starting_at(far[one.name]) if one.name in far else one for one in settings.free)
    return dataclasses.replace(settings, free=free)


def _peaks(record: Record | Measurement) -> tuple[FloatArray, FloatArray] | None:
    """Return times (s) and heights (rad) of the peaks after the release; None for fewer than three."""
    theta = record.theta if isinstance(record, Record) else None
    largest = 0.0 if theta is None else float(np.max(np.abs(theta)))
    if theta is None or largest == 0.0:
        return None
    swings = find_swings(theta, _SMALLEST * largest)[1 : _MOST_PEAKS + 1]
    # The record may end, or the joystick come to rest, within the last of them.
    places = [one.extreme for one in swings if one.last + 1 < len(theta)]
    if len(places) < 3:
        return None
    return record.time[places], theta[places]


def _times(joystick: JoystickParameters, heights: FloatArray) -> float:
    """Sum the times (s) from each peak to the next but one, without damping: periods of the peaks between."""
    return sum(undamped_oscillation(joystick, float(height)).period for height in heights[1:-1])


def _squares(joystick: JoystickParameters, heights: FloatArray) -> float:
    """Integrate omega^2 (rad^2/s) from the first peak to the last."""
    total = 0.0
    for start, end in pairwise(heights):
        # The loss is distributed evenly over the path, which is accurate enough for a start value.
        theta = np.linspace(start, end, _POINTS)
        ends = energy(joystick, np.array([start, end]), 0.0)
        whole = np.linspace(ends[0], ends[1], _POINTS)
        kinetic = np.maximum(whole - energy(joystick, theta, 0.0), 0.0)
        total += float(np.trapezoid(np.sqrt(2.0 * kinetic / joystick.J), dx=abs(end - start) / (_POINTS - 1)))
    return total


def _rubbed(joystick: JoystickParameters, heights: FloatArray) -> float:
    """Return the energy (J) lost to dry friction from the first peak to the last."""
    friction = joystick.to_names()
    angle = float(np.sum(np.abs(np.diff(heights))))
    travel = float(np.sum([contact_travel(joystick, one) for one in heights]))
    ends = float(np.sum([contact_travel(joystick, one) for one in heights[[0, -1]]]))
    pivot, plunger = friction.get("friction.T_c", 0.0), friction.get("friction.F_c", 0.0)
    return pivot * angle + plunger * max(2.0 * travel - ends, 0.0)
