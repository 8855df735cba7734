"""Whether fmi3DoStep ended inside of a step."""

from __future__ import annotations

import numpy as np

from pyjoystick.fmu.stepping.kernel import stopped_short


def test_a_clock_of_fixed_steps_may_lag_by_rounding() -> None:
    """With a limit of 1e-9 of the step, it stopped short at 11.619 s."""
    times = np.arange(20_001) * 0.001
    clock = 0.0
    for begin, length in zip(times[:-1].tolist(), np.diff(times).tolist(), strict=True):
        clock += 0.001
        assert not stopped_short(clock, begin, length)


def test_a_real_part_of_the_step_may_not_be_missed() -> None:
    assert stopped_short(0.0209, 0.02, 0.001)
    assert not stopped_short(0.02, 0.02, 0.001)
    assert not stopped_short(0.021, 0.02, 0.001)
