"""Time limits of a trial: one that hangs is ended and is a fault; a long FMU run gets Ctrl-C."""

from __future__ import annotations

import contextlib
import signal
from collections.abc import Iterator
from types import FrameType
from typing import Final

from pyjoystick.fmu.runner import Runner
from pyjoystick.fmu.stepping.program import POINT, RUN
from pyjoystick.identification.fitting.problem.forward_model import ForwardModel

#: So much longer may it take by the clock, on a machine with much else to do.
_CROWD: Final = 10.0
#: After this long, again and again: how a run goes on, how something ends after Ctrl-C (s).
_MOMENT: Final = 1.0
#: So often is asked.
_QUESTIONS: Final = 5


class HangError(BaseException):
    """Nothing came of a trial in time; no ``except Exception`` keeps it."""


class Patience:
    """What is done with a trial that takes long.

    A torque of 5e8 N.m turns the joystick hundreds of thousands of times a second: such a run takes half a
    minute, and is right. It has to go on from sample to sample, and to end at Ctrl-C. So has a fit of damaged
    records, which takes thousands of runs, from run to run.
    """

    def __init__(self) -> None:
        self.interrupted = False
        self._asked = 0
        self._reached: tuple[int, int] | None = None

    @contextlib.contextmanager
    def limited(self, seconds: float) -> Iterator[None]:
        """Raise in what takes longer than so many seconds of the processor.

        Raises:
            KeyboardInterrupt: a run of an FMU or a fit takes long, and goes on
            HangError: anything else takes long, or does not end at Ctrl-C
        """
        limits = {
            (signal.SIGPROF, signal.ITIMER_PROF): seconds,
            (signal.SIGALRM, signal.ITIMER_REAL): seconds * _CROWD,
        }
        before = {}
        for (number, timer), limit in limits.items():
            before[number] = signal.signal(number, self._end)
            signal.setitimer(timer, limit, _MOMENT)
        try:
            yield
        finally:
            for number, timer in limits:
                signal.setitimer(timer, 0.0)
                signal.signal(number, before[number])

    def _end(self, _: int, frame: FrameType | None) -> None:
        self._asked += 1
        reached = _reached(frame)
        if self._asked > _QUESTIONS or (reached is None and not self.interrupted):
            raise HangError
        if not self.interrupted and self._reached not in (None, reached):
            self.interrupted, self._asked = True, 0
            raise KeyboardInterrupt
        self._reached = reached


def _reached(frame: FrameType | None) -> tuple[int, int] | None:
    """Run and point of the run of an FMU that is under way; between two of a fit, how many it has made."""
    fits: list[ForwardModel] = []
    while frame is not None:
        runner = frame.f_locals.get("self")
        if isinstance(runner, Runner):
            place = runner._workspace.place
            return int(place[RUN]), int(place[POINT])
        fits += [one for one in frame.f_locals.values() if isinstance(one, ForwardModel)]
        frame = frame.f_back
    return (fits[0].runs, -1) if fits else None
