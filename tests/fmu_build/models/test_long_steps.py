"""Relations that change more often than the integrator takes steps agree with the rest at every point."""

from __future__ import annotations

import numpy as np
import pytest

from .case import Array, Case, Values
from .runner import FmuOf


def schmitt_trigger(t: Array) -> Values:
    """Time for which it is on: half of each period, from where the sine first exceeds 0.9."""
    begin, period = np.arcsin(0.9) / 60, 2 * np.pi / 60
    periods, within = np.divmod(t - begin, period)
    is_on = (t > begin) & (within < period / 2)
    y = np.where(t < begin, 0, periods * period / 2 + np.minimum(within, period / 2))
    return {"s": np.sin(60 * t), "h": is_on, "y": y}


#: The sine is beyond 0.9 for 15 ms at a time.
CASE = Case("StateEvents.FasterThanSteps", 100.0, schmitt_trigger)


@pytest.mark.parametrize("stop_is_known", [True, False])
@pytest.mark.parametrize("step", [1e-3, 0.0137])
def test_no_change_is_lost_that_lasts_beyond_a_point(step: float, stop_is_known: bool, fmu_of: FmuOf) -> None:
    result = fmu_of(CASE).run(CASE, "CoSimulation", step, set_stop_time=stop_is_known)
    expected = schmitt_trigger(np.asarray(result["time"]))
    np.testing.assert_allclose(result["y"], expected["y"], atol=1e-7)
    np.testing.assert_allclose(result["s"], expected["s"], atol=1e-6)
    at_an_event = np.abs(np.abs(expected["s"]) - 0.9) < 1e-6
    assert ((np.asarray(result["h"]) != 0) == expected["h"])[~at_an_event].all()
