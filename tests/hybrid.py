"""Piecewise smooth differential equations with SciPy: integration stops and restarts at every switch."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import OdeSolution, solve_ivp

Array = NDArray[np.float64]
Mode = Any


@dataclass(frozen=True)
class Trajectory:
    """States as a function of time, and the modes between the events."""

    pieces: tuple[tuple[float, OdeSolution, Mode], ...]
    """Start time, dense solution and mode of each piece."""

    @property
    def events(self) -> Array:
        return np.array([start for start, _, _ in self.pieces[1:]])

    def __call__(self, times: Array) -> Array:
        """States at the times, shape (number of states, number of times); after the jump at an event."""
        columns = [self.pieces[k][1](t) for t, k in zip(times, self._piece_of(times), strict=True)]
        return np.array(columns).T

    def modes(self, times: Array) -> list[Mode]:
        return [self.pieces[k][2] for k in self._piece_of(times)]

    def _piece_of(self, times: Array) -> list[int]:
        starts = np.array([start for start, _, _ in self.pieces])
        return [max(int(k) - 1, 0) for k in np.searchsorted(starts, times, side="right")]


def integrate(
    derivatives: Callable[[float, Array, Mode], Any],
    start: Any,
    mode: Mode,
    guards: Callable[[float, Array, Mode], Any],
    switch: Callable[[float, Array, Mode, int], tuple[Any, Mode]],
    stop: float,
    max_step: float | None = None,
) -> Trajectory:
    """Integrates from time 0.

    `guards(t, y, mode)` are positive inside a mode; where one of them falls through zero,
    `switch(t, y, mode, number of the guard)` gives the states and the mode after the event. In a step of
    `max_step` (s), a fiftieth of the time by default, no guard may fall and rise again.
    """
    time, y = 0.0, np.asarray(start, dtype=float)
    pieces: list[tuple[float, OdeSolution, Mode]] = []
    while time < stop:
        functions = [_guard(guards, mode, k) for k in range(len(guards(time, y, mode)))]
        piece: Any = solve_ivp(
            partial(_right_hand_side, derivatives, mode),
            (time, stop),
            y,
            method="DOP853",
            events=functions,
            dense_output=True,
            rtol=1e-12,
            atol=1e-14,
            max_step=max_step or stop / 50,
        )
        assert piece.success, piece.message
        pieces.append((time, piece.sol, mode))
        if piece.status == 0:
            break
        fired = [k for k, found in enumerate(piece.t_events) if found.size]
        time, y = float(piece.t[-1]), piece.y[:, -1]
        y, mode = switch(time, y, mode, fired[0])
        y = np.asarray(y, dtype=float)
        assert len(pieces) < 500, "too many events"
    return Trajectory(tuple(pieces))


def relations(expressions: Callable[[float, Array], Any]) -> tuple[Any, Any]:
    """Guards and switch of a model whose mode is the tuple of the truth of each ``expression > 0``."""

    def guards(t: float, y: Array, mode: Mode) -> list[float]:
        return [value if holds else -value for value, holds in zip(expressions(t, y), mode, strict=True)]

    def switch(_: float, y: Array, mode: Mode, k: int) -> tuple[Array, Mode]:
        return y, tuple(not holds if i == k else holds for i, holds in enumerate(mode))

    return guards, switch


def _right_hand_side(
    derivatives: Callable[[float, Array, Mode], Any], mode: Mode, time: float, y: Array
) -> Array:
    return np.asarray(derivatives(time, y, mode), dtype=float)


def _guard(guards: Callable[[float, Array, Mode], Any], mode: Mode, k: int) -> Any:
    def value(t: float, y: Array) -> float:
        return float(guards(t, y, mode)[k])

    value.terminal = True  # type: ignore[attr-defined]
    value.direction = -1  # type: ignore[attr-defined]
    return value
