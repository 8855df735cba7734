"""The fitted motion of a record on a fine time grid, and how changes of it show in the record."""

from __future__ import annotations

from typing import Final

import numpy as np

from pyjoystick.identification.fitting.problem.instrument import Instrument
from pyjoystick.identification.fitting.problem.trajectory_prediction import TrajectoryPredictor
from pyjoystick.support import FloatArray

#: Size of trial moments (N m): small, so that the motion responds linearly; 1e-3 is too large.
_MOMENT: Final = 2e-5
#: Change of the time base: small for the same reason, and far above the error of a run.
_TIME_BASE: Final = 1e-5
#: Time step of the fine grid (s), and the largest number of steps.
_STEP: Final = 1e-3
_MOST_STEPS: Final = 20_000


class FittedMotion:
    """The fitted motion of one record on a fine time grid.

    Attributes:
        predictor: predictor of the record
        row: parameters at the minimum, shape (varied,)
        instrument: instrument of the record
        late: sample times after the origin of the motion (s), shape (n,)
        step: step of the fine grid (s)
        time: fine grid and sample times after the origin, which comes first (s), shape (m,)
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
        """Values of an FMU variable along the motion, shape (m,)."""
        return self._values[:, self._names.index(name)]

    def shown(self, values: FloatArray) -> FloatArray:
        """Convert changes of the outputs along the motion to those in the record, shape (n,)."""
        own = values[self._places, : len(self.predictor.outputs)].copy()
        own[:, 0] *= 1.0 + self.instrument.angle_scale
        return np.concatenate(list(own.T))

    def first(self) -> FloatArray:
        """Values of the first output along the motion, shape (m,)."""
        return self._values[:, 0]

    def only_first(self, change: FloatArray) -> FloatArray:
        """Convert a change of the first output alone to that in the record, shape (n,)."""
        values = np.zeros((len(change), len(self.predictor.outputs)))
        values[:, 0] = change
        return self.shown(values)

    def with_moment(self, shape: FloatArray) -> FloatArray:
        """Derivative of the record, shape (n,), with respect to the size of a moment of shape (m,)."""
        size = _MOMENT / max(float(np.max(np.abs(shape))), 1e-300)
        return self._changed(added=("T", size * shape)) / size

    def curvature(self, moment: FloatArray) -> FloatArray:
        """Mean change of the record by a moment of shape (m,) and by its opposite, shape (n,)."""
        return 0.5 * (self._changed(added=("T", moment)) + self._changed(added=("T", -moment)))

    def with_parameter(self, name: str, change: float) -> FloatArray:
        """Derivative of the record by an FMU parameter, from a difference of this size; shape (n,)."""
        return self._changed(moved=(name, change)) / change

    def with_time_base(self) -> FloatArray:
        """Derivative of the record by the time base of its clock, on which its inputs are too; shape (n,)."""
        slower = self.instrument._replace(time_base=self.instrument.time_base + _TIME_BASE)
        outputs = self.predictor.outputs
        found = self.predictor.motion.variables(
            self.row, outputs, self.predictor.motion.plan(slower, self._late, outputs)
        )
        return self.shown(found - self._values[:, : len(outputs)]) / _TIME_BASE

    def _changed(
        self, added: tuple[str, FloatArray] | None = None, moved: tuple[str, float] | None = None
    ) -> FloatArray:
        """Change of the record when one thing in the run is changed, shape (n,)."""
        outputs = self.predictor.outputs
        motion = self.predictor.motion
        plan = motion.plan(self.instrument, self._late, outputs, added=added, moved=moved)
        found = motion.variables(self.row, outputs, plan)
        return self.shown(found - self._values[:, : len(outputs)])
