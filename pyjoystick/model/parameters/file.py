"""Reading a parameter file: one joystick in TOML, with uncertainties and sources; the paper's own file.

``paper.toml`` beside this module holds the numbers of Tables 1 and 2 and sections 3.3 and 4 for the
whole package. Rogers, Garland, Oliver: Dynamic modelling of mechanical systems with opposing restrained
preloaded stiffnesses, J. Sound Vib. 274 (2004) 73-89. It does not give gravity; the standard value is used.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Final, Literal, TypeVar, get_args

from pyjoystick.model.parameters.joystick import (
    ConstantDamping,
    Damping,
    Friction,
    JoystickParameters,
    PowerLawDamping,
)
from pyjoystick.model.parameters.plausible import ImplausibleError, require_plausible
from pyjoystick.model.parameters.springs import ActuatorAssembly, SegmentTable
from pyjoystick.model.parameters.stops import Stops
from pyjoystick.support import ParameterError, SettingsError, Table, not_negative, positive, read_toml

LawName = Literal["constant", "power-law"]
Side = Literal["forward", "backward"]

LAWS: Final[Mapping[LawName, type[ConstantDamping] | type[PowerLawDamping]]] = {
    "constant": ConstantDamping,
    "power-law": PowerLawDamping,
}
SIDES: Final[tuple[Side, ...]] = get_args(Side)
#: Keys of the tables with single numbers.
PLAIN_TABLES: Final[Mapping[str, tuple[str, ...]]] = {
    "body": ("m", "h", "J"),
    "gravity": ("g",),
    "geometry": ("a", "b", "pivot_to_top"),
}
#: Optional keys: all those of [friction] and [stops], which are optional tables, and some others.
#: What is far more certain than a third of it.
_SIZES: Final = ("m", "h", "g", "J", "a", "b")
_OPTIONAL: Final = (
    *("pivot_to_top", "eps_theta", "eps_omega"),
    *(field.name for part in (Friction, Stops) for field in dataclasses.fields(part)),
)
#: Key that disables the check for implausible numbers.
IMPLAUSIBLE: Final = "implausible"


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterFile:
    """Contents of a parameter file, in SI units.

    Attributes:
        path: the file
        joystick: all parameters, with the damping law chosen in the file
        title: title for reports; may be empty
        laws: the damping laws for which the file has parameters
        curves: the load-deflection curves as written in the file
        pivot_to_top: distance from the pivot to the top of the handle (m), where the accelerometer is; None
            if not given
        uncertainties: standard uncertainties by place: ``body.m``, ``forward.x[0]``, ``damping.constant.C``
        sources: sources of the numbers, by name of the table
    """

    path: Path
    joystick: JoystickParameters
    title: str
    laws: Mapping[LawName, Damping]
    curves: Mapping[Side, SegmentTable]
    pivot_to_top: float | None
    uncertainties: Mapping[str, float]
    sources: Mapping[str, str]

    @property
    def law(self) -> LawName:
        """The damping law chosen in the file."""
        return law_name(self.joystick.damping)

    def with_law(self, law: LawName) -> JoystickParameters:
        """The joystick with one of the damping laws of the file.

        Raises:
            SettingsError: the file has no parameters of that law
        """
        if law not in self.laws:
            hint = f"it has those of the law {' and '.join(self.laws)}"
            raise SettingsError(self.path, f"damping.{law}", "", None, "is missing", hint)
        return dataclasses.replace(self.joystick, damping=self.laws[law])


def law_name(damping: Damping) -> LawName:
    """The name of a damping law in parameter files and on the command line."""
    return next(name for name, law in LAWS.items() if isinstance(damping, law))


def read_parameters(path: str | PathLike[str]) -> JoystickParameters:
    """Read the joystick of a parameter file, with the damping law chosen in the file.

    Raises:
        InputFileError, SettingsError: as `read_parameter_file`
    """
    return read_parameter_file(path).joystick


def read_parameter_file(path: str | PathLike[str] | Table) -> ParameterFile:
    """Read a parameter file; docs/parameters.md describes it.

    Raises:
        InputFileError: the file cannot be read
        SettingsError: it is not TOML, or a table, key or value in it is missing, unknown or not allowed, or a
            number is implausible and the file does not contain ``implausible = true``
    """
    root = read_toml(path)
    found = _Found(root, allow_implausible=root.flag(IMPLAUSIBLE))
    numbers = {
        name: found.numbers(root.table(name, required=True), keys) for name, keys in PLAIN_TABLES.items()
    }
    curves = {side: found.curve(root.table(side, required=True)) for side in SIDES}
    damping = root.table("damping", required=True)
    chosen = _known_law(damping.choice("law", tuple(LAWS)))
    laws = {law: found.part(damping.table(law), LAWS[law]) for law in LAWS if law in damping}
    if chosen not in laws:
        raise SettingsError(root.path, damping.name, "law", chosen, f"needs a table [damping.{chosen}]")
    friction, stops = found.part(root.table("friction"), Friction), found.part(root.table("stops"), Stops)
    title = root.text("title", "")
    root.finish()
    pivot_to_top = numbers["geometry"].pop("pivot_to_top", None)
    try:
        joystick = JoystickParameters(
            **{key: value for table in numbers.values() for key, value in table.items()},
            forward=_assembly(root, "forward", curves["forward"]),
            backward=_assembly(root, "backward", curves["backward"]),
            damping=laws[chosen],
            friction=friction,
            stops=stops,
        )
        if pivot_to_top is not None:
            positive("pivot_to_top", pivot_to_top, "m")
    except ParameterError as error:
        table = next(name for name, keys in PLAIN_TABLES.items() if error.field in keys)
        raise root.table(table).refused(error.field, error) from None
    _require_travels_in_reach(root, curves, joystick.a)
    return ParameterFile(
        path=root.path,
        joystick=joystick,
        title=title,
        laws=laws,
        curves=curves,
        pivot_to_top=pivot_to_top,
        uncertainties=found.uncertainties,
        sources=found.sources,
    )


_Part = TypeVar("_Part", bound=Damping | Friction | Stops)


class _Found:
    """Collects uncertainties of numbers and sources of tables."""

    def __init__(self, root: Table, *, allow_implausible: bool) -> None:
        self.root = root
        self.allow_implausible = allow_implausible
        self.uncertainties: dict[str, float] = {}
        self.sources: dict[str, str] = {}

    def numbers(self, table: Table, keys: Iterable[str]) -> dict[str, float]:
        """Single numbers of a table; missing optional ones are omitted."""
        found = {}
        for key in keys:
            if key in table or key not in _OPTIONAL:
                found[key] = table.number(key)
                self._ask(table, key, key, found[key])
            if f"u_{key}" in table:
                self._ask_for_error(table, key, found.get(key, 0.0))
                self._keep(table, key, f"u_{key}", table.number(f"u_{key}"))
        self._keep_source(table)
        return found

    def curve(self, table: Table) -> SegmentTable:
        """The load-deflection curve of one side."""
        lists = {key: table.entries(key) for key in ("x", "k")}
        for key in lists:
            uncertain = table.optional(f"u_{key}")
            if uncertain is None:
                continue
            if not isinstance(uncertain, list) or len(uncertain) != len(lists[key]):
                raise table.error(f"u_{key}", f"must be a list of {len(lists[key])} numbers, as {key} is")
            for i, value in enumerate(uncertain):
                self._keep(table, f"{key}[{i}]", f"u_{key}[{i}]", value)
        self._keep_source(table)
        for i, value in enumerate(lists["k"]):  # the travels are checked against a
            self._ask(table, "k", f"k[{i}]", value)
        with table.at():
            return SegmentTable(tuple(lists["x"]), tuple(lists["k"]))

    def part(self, table: Table, kind: type[_Part]) -> _Part:
        """The damping law, friction or stops of a table."""
        numbers = self.numbers(table, [field.name for field in dataclasses.fields(kind)])
        with table.at():
            return kind(**numbers)

    def _ask(self, table: Table, name: str, key: str, value: object) -> None:
        """Reject an implausible number."""
        if self.allow_implausible or isinstance(value, bool) or not isinstance(value, int | float):
            return
        insist = f"{IMPLAUSIBLE} = true above the tables accepts it"
        with table.at(key):
            group = table.name.partition(".")[0]
            known = f"{group}.{name}" if group in ("damping", "friction", "stops") else name
            require_plausible(known, value, insist=insist)

    def _ask_for_error(self, table: Table, key: str, value: float) -> None:
        """Reject a standard uncertainty of more than a third of a size, as one in another unit."""
        error, most = table.number(f"u_{key}"), abs(value) / 3.0
        if key in _SIZES and error > most > 0.0 and not self.allow_implausible:
            insist = f"{IMPLAUSIBLE} = true above the tables accepts it"
            with table.at(f"u_{key}"):
                raise ImplausibleError(f"u_{key}", error, f"below a third of {key} = {value:g}", insist)

    def _keep(self, table: Table, place: str, key: str, value: object) -> None:
        with table.at(key):
            self.uncertainties[f"{table.name}.{place}"] = not_negative(key, value)

    def _keep_source(self, table: Table) -> None:
        source = table.text("source", "")
        if source:
            self.sources[table.name] = source


def _known_law(text: str) -> LawName:
    return next(law for law in LAWS if law == text)


def _assembly(root: Table, side: Side, curve: SegmentTable) -> ActuatorAssembly:
    """The two springs with that curve."""
    with root.table(side).at():
        return ActuatorAssembly.from_table(curve.x, curve.k)


def _require_travels_in_reach(root: Table, curves: Mapping[Side, SegmentTable], a: float) -> None:
    """Reject a kink beyond x = a, which the contact reaches only past 45 degrees: most likely it is in mm."""
    for side, curve in curves.items():
        for i, travel in enumerate(curve.x):
            if travel >= a:
                allowed = f"must be below a = {a:.9g} m"
                hint = f"in mm? {travel:g} mm are {travel * 1e-3:g} m"
                raise SettingsError(root.path, side, f"x[{i}]", travel, allowed, hint)


#: The shipped parameter file, which holds the numbers.
PAPER: Final[ParameterFile] = read_parameter_file(Path(__file__).with_name("paper.toml"))
#: Tables 1 and 2 with the constant damping of Fig. 10.
NOMINAL: Final[JoystickParameters] = PAPER.with_law("constant")
#: Tables 1 and 2 with the power law of eq. (11) at the weight of Fig. 10.
NOMINAL_POWER_LAW: Final[JoystickParameters] = PAPER.with_law("power-law")

#: Table 1, forward side (theta > 0): x_i in m, k_i in N/m.
FORWARD_TABLE: Final[SegmentTable] = PAPER.curves["forward"]
#: Table 1, backward side (theta < 0): x_i in m, k_i in N/m.
BACKWARD_TABLE: Final[SegmentTable] = PAPER.curves["backward"]

assert PAPER.pivot_to_top is not None
#: Table 2: pivot to the top of the handle (m), where the accelerometer sits.
PIVOT_TO_TOP: Final[float] = PAPER.pivot_to_top
#: The stops of the joystick are at about plus and minus this angle (rad).
STOP_ANGLE: Final = math.radians(20.0)
