"""The motion that the options of ``pyjoystick torque`` describe."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import typer

from pyjoystick.cli.options import parse_angle
from pyjoystick.support import ParameterError

if TYPE_CHECKING:
    from pyjoystick.forced_motion import ForwardAndReturn, Shape

_ANGLE = "15deg"
_STROKE_TIME = 0.15
#: Options by the attributes of `ForwardAndReturn`.
_OPTIONS = {
    "amplitude": "--angle",
    "rise": "--stroke-time",
    "fall": "--return-time",
    "dwell": "--dwell",
    "shape": "--shape",
    "flat": "--flat",
}


@dataclass(frozen=True, slots=True)
class MotionOptions:
    """What was given; None stands for what was not."""

    angle: str | None
    stroke_time: float | None
    return_time: float | None
    dwell: float | None
    shape: str | None
    flat: float | None

    def motion(self) -> ForwardAndReturn:
        """The motion; what was not given is as the help says.

        Raises:
            BadParameter: a value is not allowed
        """
        from pyjoystick.forced_motion import ForwardAndReturn

        if self.flat is not None and self.shape != "trapezoid":
            raise typer.BadParameter("is for --shape trapezoid", param_hint="--flat")
        given = {"dwell": self.dwell, "flat": self.flat}
        try:
            return ForwardAndReturn(
                amplitude=parse_angle(_ANGLE if self.angle is None else self.angle, "--angle"),
                rise=_STROKE_TIME if self.stroke_time is None else self.stroke_time,
                fall=self.return_time,
                shape=cast("Shape", "minimum-jerk" if self.shape is None else self.shape),
                **{name: value for name, value in given.items() if value is not None},
            )
        except ParameterError as error:
            text = f"{error.value} must be {error.allowed}"
            raise typer.BadParameter(text, param_hint=_OPTIONS[error.field]) from None

    def refuse_all(self) -> None:
        """Raise BadParameter if any was given beside a measured motion."""
        values = (self.angle, self.stroke_time, self.return_time, self.dwell, self.shape, self.flat)
        refuse_given(
            "is for a motion in closed form, and MOTION.csv is a measured one",
            dict(zip(_OPTIONS.values(), values, strict=True)),
        )


def refuse_given(reason: str, values: Mapping[str, object]) -> None:
    """Raise BadParameter with the reason for the first option that was given.

    Args:
        reason: why it may not be
        values: by option; None for what was not given
    """
    for option, value in values.items():
        if value is not None:
            raise typer.BadParameter(reason, param_hint=option)
