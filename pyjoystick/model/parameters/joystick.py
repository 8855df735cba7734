"""All parameters of one joystick, and their names as the FMU knows them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

from pyjoystick.model.parameters.damping import ConstantDamping, Damping, PowerLawDamping
from pyjoystick.model.parameters.springs import ActuatorAssembly, RestrainedSpring
from pyjoystick.support import ParameterError, UnknownParameterError, finite, not_negative, positive

_Record = TypeVar("_Record", bound=RestrainedSpring | ConstantDamping | PowerLawDamping)
_BODY = ("J", "m", "h", "g", "a", "b")
_SIDES = ("forward", "backward")
_SPRINGS = {"returnSpring": "return_spring", "balanceSpring": "balance_spring"}


@dataclass(frozen=True, slots=True, kw_only=True)
class JoystickParameters:
    """The joystick of eqs. (1)-(5): inertia and geometry (Table 2), both actuators (Table 1) and the damping.

    Attributes:
        J: moment of inertia about the pivot (kg m2), above 0
        m: mass (kg), 0 or more
        h: pivot to center of mass (m), 0 or more
        g: acceleration of gravity (m/s2); 0 switches it off, below 0 hangs the joystick upside down
        a: pivot to plunger axis (m), above 0
        b: pivot to cam surface (m), 0 or more, below a (else the contact point would pass the pivot, eq. 2a)
        forward: actuator that resists theta > 0
        backward: actuator that resists theta < 0
        damping: damping law

    Raises:
        ParameterError: a value is not finite or outside its range
    """

    J: float
    m: float
    h: float
    g: float
    a: float
    b: float
    forward: ActuatorAssembly
    backward: ActuatorAssembly
    damping: Damping

    def __post_init__(self) -> None:
        object.__setattr__(self, "J", positive("J", self.J, "kg.m2"))
        object.__setattr__(self, "m", not_negative("m", self.m, "kg"))
        object.__setattr__(self, "h", not_negative("h", self.h, "m"))
        object.__setattr__(self, "g", finite("g", self.g, "m/s2"))
        object.__setattr__(self, "a", positive("a", self.a, "m"))
        object.__setattr__(self, "b", not_negative("b", self.b, "m"))
        if self.b >= self.a:
            raise ParameterError("b", self.b, f"below a = {self.a:.9g} m")

    def to_names(self) -> dict[str, float]:
        """Every parameter (SI units) by its FMU name, such as ``forward.returnSpring.k_s``, ``damping.C``."""
        names = {name: float(getattr(self, name)) for name in _BODY}
        for side in _SIDES:
            for fmu_name, field in _SPRINGS.items():
                spring = getattr(getattr(self, side), field)
                names |= _prefixed(f"{side}.{fmu_name}", spring)
        return names | _prefixed("damping", self.damping)

    def replace(self, changes: Mapping[str, float]) -> JoystickParameters:
        """A copy with some parameters changed, given by FMU name; all are checked together.

        Args:
            changes: value (SI units) by FMU name, as in `to_names`

        Raises:
            UnknownParameterError: no parameter of this joystick with its damping law has that name
            ParameterError: a value is outside its range, or the name is ``damping.beta``, which is 1 - alpha
        """
        names: dict[str, float] = self.to_names()
        for name in changes:
            if name == "damping.beta" and isinstance(self.damping, PowerLawDamping):
                raise ParameterError(name, changes[name], "left out: it is 1 - damping.alpha")
            if name not in names:
                raise UnknownParameterError(name, names)
        return _from_names(names | dict(changes), type(self.damping))


def _prefixed(prefix: str, record: RestrainedSpring | Damping) -> dict[str, float]:
    return {f"{prefix}.{field.name}": getattr(record, field.name) for field in dataclasses.fields(record)}


def _from_names(
    names: Mapping[str, float], law: type[ConstantDamping] | type[PowerLawDamping]
) -> JoystickParameters:
    """The parameters whose `to_names` is `names`, with errors that carry the full FMU name."""
    actuators = {}
    for side in _SIDES:
        springs = {
            field: _built(RestrainedSpring, f"{side}.{fmu_name}", names)
            for fmu_name, field in _SPRINGS.items()
        }
        try:
            actuators[side] = ActuatorAssembly(**springs)
        except ParameterError as error:
            raise error.within(side) from None
    return JoystickParameters(
        J=names["J"],
        m=names["m"],
        h=names["h"],
        g=names["g"],
        a=names["a"],
        b=names["b"],
        forward=actuators["forward"],
        backward=actuators["backward"],
        damping=_built(law, "damping", names),
    )


def _built(record: type[_Record], prefix: str, names: Mapping[str, float]) -> _Record:
    try:
        return record(**{field.name: names[f"{prefix}.{field.name}"] for field in dataclasses.fields(record)})
    except ParameterError as error:
        raise error.within(prefix) from None
