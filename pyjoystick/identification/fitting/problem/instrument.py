"""The instrument: how a record shows a motion, with its clock, zero and scale."""

from __future__ import annotations

from typing import Final, NamedTuple

#: Time on the record's clock at which the FMU starts; before it, the record shows the start values.
RELEASE_TIME: Final = "release_time"
#: Reading of the first output where it is zero, in its unit.
ZERO_OFFSET: Final = "zero_offset"
#: Relative excess of the first output's reading.
ANGLE_SCALE: Final = "angle_scale"
#: Relative slowness of the record's clock: the motion lasts 1 + time_base times as long as shown.
TIME_BASE: Final = "time_base"
#: Lag of the outputs behind the inputs (s).
DELAY: Final = "delay"


class Instrument(NamedTuple):
    """Reading, at time t, of an output y of the FMU, which starts at the release.

    It is (1 + angle_scale)*y((1 + time_base)*(t - release_time - delay)) + zero_offset, where scale and zero
    apply to the first output only. Inputs are read at (1 + time_base)*(t - release_time).

    Attributes:
        release_time: time at which the FMU starts (s)
        zero_offset: in the unit of the first output
        angle_scale, time_base: relative
        delay: lag of the outputs behind the inputs (s)
    """

    release_time: float = 0.0
    zero_offset: float = 0.0
    angle_scale: float = 0.0
    time_base: float = 0.0
    delay: float = 0.0

    @property
    def origin(self) -> float:
        """Time on the record's clock (s) at which the outputs start to move."""
        return self.release_time + self.delay

    @property
    def clock(self) -> tuple[float, float, float]:
        """The numbers that determine at which times the FMU is sampled."""
        return self.release_time, self.time_base, self.delay


#: Names of the instrument's numbers in the settings of a fit.
INSTRUMENT: Final = Instrument._fields
#: Numbers that act through the clock; their derivatives need the output's time derivative.
CLOCK: Final = (RELEASE_TIME, TIME_BASE, DELAY)
