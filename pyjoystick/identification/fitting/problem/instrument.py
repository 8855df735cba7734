"""How a record shows a motion: its clock, its zero and its scale."""

from __future__ import annotations

from typing import Final, NamedTuple

#: The instant of a record's clock at which the FMU starts; until then the record shows the start values.
RELEASE_TIME: Final = "release_time"
#: What the first output shows where it is zero, in its unit.
ZERO_OFFSET: Final = "zero_offset"
#: By what part the first output is shown too large.
ANGLE_SCALE: Final = "angle_scale"
#: By what part the record's clock runs slow: the motion lasts 1 + time_base as long as it shows.
TIME_BASE: Final = "time_base"
#: By how much the outputs lag behind the inputs (s).
DELAY: Final = "delay"


class Instrument(NamedTuple):
    """What a record shows of an output y of the FMU, which starts at the release, at the instant t.

    (1 + angle_scale)*y((1 + time_base)*(t - release_time - delay)) + zero_offset; scale and zero are those of
    the first output. Inputs are read at (1 + time_base)*(t - release_time).

    Attributes:
        release_time: instant at which the FMU starts (s)
        zero_offset: in the unit of the first output
        angle_scale, time_base: relative
        delay: of the outputs behind the inputs (s)
    """

    release_time: float = 0.0
    zero_offset: float = 0.0
    angle_scale: float = 0.0
    time_base: float = 0.0
    delay: float = 0.0

    @property
    def origin(self) -> float:
        """The instant of the record (s) at which the outputs begin to move."""
        return self.release_time + self.delay

    @property
    def clock(self) -> tuple[float, float, float]:
        """What decides at which instants the FMU is to be sampled."""
        return self.release_time, self.time_base, self.delay


#: The names of its numbers, as settings of a fit have them.
INSTRUMENT: Final = Instrument._fields
#: Those that act through the clock: their derivatives need that of the output.
CLOCK: Final = (RELEASE_TIME, TIME_BASE, DELAY)
