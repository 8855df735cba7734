"""One test case: a model, its run, and an independent statement of the expected result."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = Mapping[str, Array]
Signal = Callable[[Array], Array]

MODELS = Path(__file__).parent


def no_events(_: float) -> Array:
    """Event times of a model that has none."""
    return np.empty(0)


@dataclass(frozen=True)
class Case:
    """One run of a model of this folder and its oracle.

    `expected(t)` gives the values of the variables at the times t (seconds); at an event, those after it.
    `events(stop)` gives the times in [0, stop] at which the FMU must have an event: samples closer than
    `margin` to one are not compared, because both sides of a jump are right there.
    """

    model: str
    stop_time: float
    expected: Callable[[Array], Values]
    accuracy: float = 1e-7
    """Largest difference allowed in co-simulation at tolerance 1e-8."""
    me_accuracy: float = 1e-5
    """The same in model exchange with FMPy's CVode at 1e-8, whose error adds up over the run."""
    parameters: Mapping[str, float | int | bool] = field(default_factory=dict)
    inputs: Mapping[str, Signal] = field(default_factory=dict)
    events: Callable[[float], Array] = no_events
    margin: float = 1e-6
    """Seconds; in model exchange ten times `me_accuracy`, for CVode finds events as late as it is off."""
    label: str = ""
    """Tells two cases of one model apart."""

    @property
    def library(self) -> Path:
        return MODELS / (self.model.partition(".")[0] + ".mo")

    @property
    def name(self) -> str:
        return self.model + ("-" + self.label if self.label else "")

    def comparable(self, times: Array, margin: float) -> NDArray[np.bool_]:
        """Which of the times are farther than `margin` from every event."""
        events = self.events(self.stop_time)
        if events.size == 0:
            return np.ones(times.shape, dtype=bool)
        nearest = np.abs(times[:, np.newaxis] - events[np.newaxis, :]).min(axis=1)
        return np.asarray(nearest > margin)


def largest_difference(times: Array, got: Values, case: Case, margin: float) -> tuple[float, str]:
    """The largest difference between `got` and the oracle, and a text that says where it is."""
    mask = case.comparable(times, margin)
    assert mask.sum() >= 3, f"{case.name}: too few samples away from events to compare"
    expected = case.expected(times[mask])
    worst, where = 0.0, "no difference"
    for name in expected:
        difference = np.abs(np.asarray(got[name], dtype=float)[mask] - expected[name])
        k = int(np.argmax(np.where(np.isnan(difference), np.inf, difference)))
        if not difference[k] <= worst:
            worst = float(difference[k])
            found, wanted = float(np.asarray(got[name])[mask][k]), float(expected[name][k])
            where = f"{case.name}: {name}({times[mask][k]:.9g}) is {found!r}, must be {wanted!r}"
    return worst, where
