"""The SciPy oracles' integration with event location, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fmu_build.models.oracles.state_events import bounce_times, bouncing
from tests.hybrid import Array, integrate, relations


def test_a_bouncing_ball() -> None:
    run = integrate(
        lambda t, y, mode: [y[1], -9.81],
        [1.0, 0.0],
        0,
        # The floor counts only on the way down: at the bounce itself the height is zero to rounding.
        lambda t, y, mode: [y[0] if y[1] < 0 else 1.0],
        lambda t, y, mode, k: ([0.0, -0.7 * y[1]], mode + 1),
        1.5,
    )
    times = np.linspace(0.0, 1.5, 77)
    h, v = bouncing(times, 1.0, 9.81, 0.7)
    np.testing.assert_allclose(run.events, bounce_times(1.0, 9.81, 0.7, 1.5), atol=1e-12)
    np.testing.assert_allclose(run(times), [h, v], atol=1e-11)
    assert run.modes(np.array([0.0, 1.5])) == [0, len(run.events)]


def test_relations_switch_both_ways() -> None:
    """The integral of a sine cut off at one half, and where it is cut off."""

    def expressions(t: float, _: Array) -> list[float]:
        return [np.sin(t) - 0.5]

    guards, switch = relations(expressions)
    run = integrate(lambda t, y, mode: [0.5 if mode[0] else np.sin(t)], [0.0], (False,), guards, switch, 3.0)
    angle = np.pi / 6
    assert run.events == pytest.approx([angle, np.pi - angle], abs=1e-12)
    assert run.modes(np.array([0.1, 1.0, 2.9])) == [(False,), (True,), (False,)]
    total = 1 - np.cos(angle) + 0.5 * (np.pi - 2 * angle) + np.cos(np.pi - angle) - np.cos(3.0)
    assert run(np.array([3.0]))[0, 0] == pytest.approx(total, abs=1e-12)
