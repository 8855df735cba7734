"""All parameters of one joystick with either damping law, dry friction and stops, and their FMU names."""

from __future__ import annotations

import dataclasses
from collections.abc import Container, Mapping
from dataclasses import dataclass
from typing import Final, TypeVar

from pyjoystick.model.parameters.springs import ActuatorAssembly, RestrainedSpring
from pyjoystick.model.parameters.stops import Stops
from pyjoystick.support import ParameterError, UnknownParameterError, finite, not_negative, positive


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstantDamping:
    """A constant damping coefficient.

    Attributes:
        C: damping coefficient (N m s/rad), 0 or more

    Raises:
        ParameterError: C is not finite or negative
    """

    C: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "C", not_negative("C", self.C, "N.m.s/rad"))


@dataclass(frozen=True, slots=True, kw_only=True)
class PowerLawDamping:
    """Eq. (11): C = alpha*A*|theta|^n + beta*B*|omega|^m, beta = 1 - alpha; A, n chosen by the sign of theta.

    Near zero |theta| and |omega| are rounded off to sqrt(theta^2 + eps_theta^2) and
    sqrt(omega^2 + eps_omega^2), because the exponents may be negative. theta in rad, omega in rad/s.

    Attributes:
        alpha: weight of the displacement term, 0 to 1
        A_pos, n_pos: coefficient (N m s/rad) and exponent for theta >= 0
        A_neg, n_neg: coefficient (N m s/rad) and exponent for theta < 0
        B, m: coefficient (N m s/rad) and exponent of the velocity term
        eps_theta: rounding-off angle (rad), above 0
        eps_omega: rounding-off angular velocity (rad/s), above 0

    Raises:
        ParameterError: a value is not finite or outside its range
    """

    alpha: float
    A_pos: float
    n_pos: float
    A_neg: float
    n_neg: float
    B: float
    m: float
    eps_theta: float = 1e-4
    eps_omega: float = 1e-3

    def __post_init__(self) -> None:
        alpha = not_negative("alpha", self.alpha)
        if alpha > 1.0:
            raise ParameterError("alpha", self.alpha, "between 0 and 1")
        object.__setattr__(self, "alpha", alpha)
        for name in ("A_pos", "A_neg", "B"):
            object.__setattr__(self, name, not_negative(name, getattr(self, name), "N.m.s/rad"))
        for name in ("n_pos", "n_neg", "m"):
            object.__setattr__(self, name, finite(name, getattr(self, name)))
        object.__setattr__(self, "eps_theta", positive("eps_theta", self.eps_theta, "rad"))
        object.__setattr__(self, "eps_omega", positive("eps_omega", self.eps_omega, "rad/s"))

    @property
    def beta(self) -> float:
        """Weight of the velocity term: 1 - alpha."""
        return 1.0 - self.alpha


Damping = ConstantDamping | PowerLawDamping


@dataclass(frozen=True, slots=True, kw_only=True)
class Friction:
    """Dry friction of the pivot and of the plunger in contact; none where all are 0.

    While the joystick slides, the friction moment against its motion is
    T_c + (T_s - T_c)*exp(-(omega/omega_s)^2) + F_c*|dx/dtheta|: Coulomb's law, Stribeck's where T_s is above
    T_c. While it sticks, the moment balances all others, as long as max(T_c, T_s) + F_c*|dx/dtheta| can.
    The plunger rubs where its return spring is engaged, not within the clearance.

    Attributes:
        T_c: Coulomb friction moment at the pivot (N m), 0 or more
        F_c: Coulomb friction force along the plunger (N), 0 or more
        T_s: static friction moment at the pivot (N m), at least T_c; 0 stands for T_c
        omega_s: Stribeck velocity (rad/s), 0 or more; above 0 where T_s is above T_c

    Raises:
        ParameterError: a value is not finite or outside its range
    """

    T_c: float = 0.0
    F_c: float = 0.0
    T_s: float = 0.0
    omega_s: float = 0.0

    def __post_init__(self) -> None:
        for name, unit in (("T_c", "N.m"), ("F_c", "N"), ("T_s", "N.m"), ("omega_s", "rad/s")):
            object.__setattr__(self, name, not_negative(name, getattr(self, name), unit))
        if 0.0 < self.T_s < self.T_c:
            raise ParameterError("T_s", self.T_s, f"at least T_c = {self.T_c:.9g} N.m, or 0, which is T_c")
        if self.T_s > self.T_c and self.omega_s == 0.0:
            raise ParameterError("omega_s", self.omega_s, "above 0 rad/s, because T_s is above T_c")

    def __bool__(self) -> bool:
        return self.T_c > 0.0 or self.F_c > 0.0 or self.T_s > 0.0


#: FMU names of the parameters of the friction.
FRICTION_NAMES: Final = tuple(f"friction.{field.name}" for field in dataclasses.fields(Friction))

_Record = TypeVar("_Record", bound=RestrainedSpring | ConstantDamping | PowerLawDamping | Friction | Stops)
_BODY = ("J", "m", "h", "g", "a", "b")
_SIDES = ("forward", "backward")
_SPRINGS = {"returnSpring": "return_spring", "balanceSpring": "balance_spring"}


@dataclass(frozen=True, slots=True, kw_only=True)
class JoystickParameters:
    """The joystick of eqs. (1)-(5): Tables 1 and 2, with damping, dry friction and stops.

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
        friction: dry friction, which the paper does not have; none by default
        stops: mechanical stops, which the paper mentions only; none by default

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
    friction: Friction = Friction()
    stops: Stops = dataclasses.field(default_factory=Stops)

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
        """Every parameter (SI units) by its FMU name, such as ``forward.returnSpring.k_s``, ``damping.C``.

        Those of the friction, such as ``friction.T_c``, are among them where there is any: only the FMUs with
        friction have them. Those of the stops are, such as ``stops.theta_stop``, where there are stops.
        """
        names = {name: float(getattr(self, name)) for name in _BODY}
        for side in _SIDES:
            for fmu_name, field in _SPRINGS.items():
                spring = getattr(getattr(self, side), field)
                names |= _prefixed(f"{side}.{fmu_name}", spring)
        names |= _prefixed("damping", self.damping)
        for name in ("friction", "stops"):
            if part := getattr(self, name):
                names |= _prefixed(name, part)
        return names

    def replace(self, changes: Mapping[str, float]) -> JoystickParameters:
        """A copy with some parameters changed, given by FMU name; all are checked together.

        Args:
            changes: value (SI units) by FMU name, as in `to_names`, those of friction and stops always

        Raises:
            UnknownParameterError: no parameter of this joystick with its damping law has that name
            ParameterError: a value is outside its range, or the name is ``damping.beta``, which is 1 - alpha
        """
        optional = _prefixed("friction", self.friction) | _prefixed("stops", self.stops)
        names: dict[str, float] = self.to_names() | optional
        for name in changes:
            if name == "damping.beta" and isinstance(self.damping, PowerLawDamping):
                raise ParameterError(name, changes[name], "left out: it is 1 - damping.alpha")
            if name not in names:
                raise UnknownParameterError(name, names)
        return _from_names(names | dict(changes), type(self.damping))


#: What a part is absent by: a joystick lacks it where all of these are 0.
_ABSENT: Final = {
    "friction": ("friction.T_c", "friction.F_c", "friction.T_s"),
    "stops": ("stops.theta_stop",),
}


def values_for(joystick: JoystickParameters, names: Container[str]) -> dict[str, float]:
    """What makes an FMU this joystick: its `to_names`, and zeros for the parts that only the FMU has.

    Without the zeros an FMU would keep friction or stops of its start values.

    Args:
        joystick: the joystick
        names: of the FMU's variables

    Returns:
        values (SI units) by FMU name
    """
    absent = [name for part, which in _ABSENT.items() if not getattr(joystick, part) for name in which]
    return joystick.to_names() | {name: 0.0 for name in absent if name in names}


def _prefixed(prefix: str, record: RestrainedSpring | Damping | Friction | Stops) -> dict[str, float]:
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
        **{name: names[name] for name in _BODY},
        forward=actuators["forward"],
        backward=actuators["backward"],
        damping=_built(law, "damping", names),
        friction=_built(Friction, "friction", names),
        stops=_built(Stops, "stops", names),
    )


def _built(record: type[_Record], prefix: str, names: Mapping[str, float]) -> _Record:
    try:
        return record(**{field.name: names[f"{prefix}.{field.name}"] for field in dataclasses.fields(record)})
    except ParameterError as error:
        raise error.within(prefix) from None
