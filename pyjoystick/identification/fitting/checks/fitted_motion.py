"""The motion that was fitted to a record, at fine steps, and its changes as the record shows them."""

from __future__ import annotations

from typing import Final

import numpy as np

from pyjoystick.identification.fitting.problem.instrument import Instrument
from pyjoystick.identification.fitting.problem.trajectory_prediction import TrajectoryPredictor
from pyjoystick.support import FloatArray

#: Size of a moment that is tried (N m): small, so that the motion changes in proportion. 1e-3 is too much.
_MOMENT: Final = 2e-5
#: The motion is followed in steps of this (s), but in no more of them than this.
_STEP: Final = 1e-3
_MOST_STEPS: Final = 20_000


class FittedMotion:
    """The fitted motion of one record at fine steps.

    Attributes:
        predictor: of the record
        row: parameters at the minimum, shape (varied,)
        instrument: of the record
        late: times of the samples after the origin of the motion (s), shape (n,)
        step: between the fine steps (s)
        time: times of the fine steps and of the samples after the origin, which is first (s), shape (m,)
    """

    def __init__(self, predictor: TrajectoryPredictor, row: FloatArray, instrument: Instrument) -> None:
        self.predictor, self.row, self.instrument = predictor, row, instrument
        self.late = predictor.record.time - instrument.origin
        end = float(self.late[-1])
        self.step = max(_STEP, end / _MOST_STEPS)
        own = self.late[self.late > 0.0]
        self._late = np.union1d(np.arange(1, int(end / self.step) + 1) * self.step, own)
        self._places = np.concatenate(
            (np.zeros(len(self.late) - len(own), dtype=np.intp), 1 + np.searchsorted(self._late, own))
        )
        self.time = np.concatenate(([0.0], self._late))
        wanted = [name for name in ("theta", "omega", "M_s", "f_x") if name in predictor.motion.known]
        self._names = tuple(dict.fromkeys((*predictor.outputs, *wanted)))
        plan = predictor.motion.plan(instrument, self._late, self._names)
        self._values = predictor.motion.variables(row, self._names, plan)

    def has(self, *names: str) -> bool:
        """Whether the FMU has these variables."""
        return set(names) <= set(self._names)

    def series(self, name: str) -> FloatArray:
        """A variable of the FMU along the motion, shape (m,)."""
        return self._values[:, self._names.index(name)]

    def shown(self, values: FloatArray) -> FloatArray:
        """Changes of the outputs along the motion, as the record shows them, shape (n,)."""
        own = values[self._places, : len(self.predictor.outputs)].copy()
        own[:, 0] *= 1.0 + self.instrument.angle_scale
        return np.concatenate(list(own.T))

    def first(self) -> FloatArray:
        """The first output along the motion, shape (m,)."""
        return self._values[:, 0]

    def only_first(self, change: FloatArray) -> FloatArray:
        """A change of the first output alone, as the record shows it, shape (n,)."""
        values = np.zeros((len(change), len(self.predictor.outputs)))
        values[:, 0] = change
        return self.shown(values)

    def with_moment(self, shape: FloatArray) -> FloatArray:
        """Derivative with respect to the size of a moment along the motion, shape (m,); shape (n,)."""
        size = _MOMENT / max(float(np.max(np.abs(shape))), 1e-300)
        return self._changed(added=("T", size * shape)) / size

    def with_parameter(self, name: str, change: float) -> FloatArray:
        """Derivative with respect to a parameter of the FMU, by this change of it, shape (n,)."""
        return self._changed(moved=(name, change)) / change

    def _changed(
        self, added: tuple[str, FloatArray] | None = None, moved: tuple[str, float] | None = None
    ) -> FloatArray:
        """By how much the record shows another motion where something is changed, shape (n,)."""
        outputs = self.predictor.outputs
        motion = self.predictor.motion
        plan = motion.plan(self.instrument, self._late, outputs, added=added, moved=moved)
        found = motion.variables(self.row, outputs, plan)
        return self.shown(found - self._values[:, : len(outputs)])
